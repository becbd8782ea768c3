"""Programs that die in the middle of motion, by kill -9: the arm stops with a named reason, and the others
go on.
"""
import os
import pathlib
import signal
import subprocess
import sys
import unittest

from support import MISSIONS, PYTHON, SystemTest, start_run
from liana.client import brief, wait_until
from liana.system import System

WATCHER = (
    "import sys; sys.path.insert(0, sys.argv[1]); from liana import Client; c = Client(sys.argv[2], 'watcher',"
    " 'observer')\nwhile True: c.step()"
)


def children_of(pid):
    """Process ids by program name."""
    found = {}
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = stat.read_text()
        except OSError:
            continue
        name, rest = text[text.index("(") + 1 : text.rindex(")")], text[text.rindex(")") + 2 :].split()
        if int(rest[1]) == pid:
            found[name] = int(stat.parent.name)
    return found


class ClientsThatDie(SystemTest):
    def mission_under_way(self, mission="short", operator=False, lockstep=True):
        """A lianad that expects a mission ends with it; one that has to outlive it meets it outside lockstep."""
        system = self.enterContext(
            System("client,mission,operator" if operator else "client,mission" if lockstep else "client")
        )
        client = system.client()
        if operator:
            system.start_operator()
        system.start_mission(MISSIONS / f"{mission}.lua", lockstep)
        return system, client

    def assert_said(self, state, *words):
        self.assertTrue(any(all(word in event["text"] for word in words) for event in state["events"]), brief(state))

    def moving(self, client):
        return client.until(
            lambda state: state["owner"] == "mission" and state["is_busy"] and state["step"] and not state["at_rest"],
            120,
        )

    def test_when_the_mission_runner_dies_the_arm_holds_and_another_client_can_go_back(self):
        system, client = self.mission_under_way(lockstep=False)
        self.moving(client)
        client.go_on(1.0)
        before = list(client.state["setpoint_js_deg"])
        system.kill("liana-mission")
        state = client.until(lambda state: state["owner"] == "")
        self.assert_said(state, "the owner of motion died", "the arm holds")
        client.until(lambda state: state["at_rest"] and not state["is_busy"])
        client.go_on(0.5)
        self.assert_holds(client.state)
        self.assertLess(max(abs(a - b) for a, b in zip(client.state["setpoint_js_deg"], before)), 2.0)
        client.call("acquire")
        client.call("retract", until_tick=0)
        client.until(lambda state: state["is_busy"] and not state["at_rest"])
        client.until(lambda state: state["at_rest"] and not state["is_busy"])
        client.call("hold")
        self.assertEqual(client.state["faults"], [])
        system.shut_down(client)
        self.assert_stopped(system.truth(), len(system.truth().rows) - 130)

    def test_when_the_script_s_own_process_dies_the_runner_reports_it(self):
        system, client = self.mission_under_way(lockstep=False)
        self.moving(client)
        script = children_of(system.children["liana-mission"].pid)
        os.kill(script["liana-mission"], signal.SIGKILL)
        client.until(lambda state: state["owner"] == "")
        client.until(lambda state: state["at_rest"] and not state["is_busy"])
        self.assert_holds(client.state)
        self.assertEqual(system.ended("liana-mission"), 1)
        self.assertIn("killed by signal 9", system.log("liana-mission"))
        self.assertIn("the arm holds", system.log("liana-mission"))
        self.assertEqual(system.json("mission.json")["outcome"], "failed")

    # req:A12
    def test_when_the_operator_dies_the_arm_holds_and_the_mission_fails_in_its_own_time(self):
        system, client = self.mission_under_way("steered", operator=True)
        client.until(lambda state: state["device_engaged"] and not state["at_rest"], 60)
        client.go_on(1.5)
        self.assertTrue(
            client.state["device_engaged"] and not client.state["at_rest"], "the operator has to be steering"
        )
        tick = client.state["tick"]
        system.kill("liana-operator")
        state = client.until(lambda state: not state["device_engaged"])
        self.assertLess(state["tick"] - tick, 100)
        self.assertNotEqual(state["device_reason"], "")
        self.assert_said(state, "operator", "is gone")
        client.until(lambda state: state["at_rest"] and not state["is_busy"], 5)
        self.assert_holds(client.state)
        self.assertEqual(client.state["owner"], "mission")
        client.until(lambda state: state["owner"] == "")
        self.assert_holds(client.state)
        self.assertEqual(system.ended("liana-mission"), 1)
        self.assertIn("time limit", system.json("mission.json")["reason"])

    def test_observers_that_die_or_stop_reading_disturb_nobody(self):
        system, client = self.mission_under_way()
        watchers = []
        for _ in range(2):
            call = [sys.executable, "-c", WATCHER, str(PYTHON), str(system.api)]
            watchers.append(subprocess.Popen(call, stderr=subprocess.DEVNULL))
            self.addCleanup(watchers[-1].wait)
            self.addCleanup(watchers[-1].kill)
        self.moving(client)
        watchers[0].kill()
        watchers[1].send_signal(signal.SIGSTOP)
        client.until(lambda state: state["owner"] == "", 60)
        self.assertEqual(system.ended("liana-mission"), 0, system.log("liana-mission"))
        self.assert_holds(client.state)
        self.assertEqual(client.state["faults"], [])


class BusSidesThatDie(SystemTest):
    def moving(self):
        system = self.enterContext(System())
        client = system.client()
        client.enable()
        client.start_moving()
        return system, client

    def test_when_lianad_dies_the_drives_stop_the_arm_by_themselves(self):
        system, client = self.moving()
        system.kill("lianad")
        self.assertEqual((system.ended("liana-bus"), system.ended("liana-bench")), (0, 0))
        self.assertIn("left", system.log("liana-bus"))
        truth = system.truth()
        enabled = truth.column("enabled")
        last_slot = max(i for i, count in enumerate(enabled) if count == 15)
        self.assertGreater(truth.travel_deg(last_slot - 50, last_slot), 0.015, "lianad has to die while the arm moves")
        self.assertEqual(len(truth.rows) - 125, system.json("bench_summary.json")["slots"] - 125)
        self.assertGreaterEqual(last_slot, client.state["tick"])
        self.assertLessEqual(last_slot, len(truth.rows) - 125 + 6, "three periods without a target are allowed")
        self.assertGreater(truth.travel_deg(len(truth.rows) - 126, len(truth.rows)), 0.0)
        for drive in system.json("bench_summary.json")["drives"]:
            self.assertEqual(
                (drive["quick_stops"], drive["emergencies"], drive["statusword"] & 0x6F), (1, 2, 0x40), drive
            )
        self.assertEqual(enabled[-1], 0)
        self.assertLess(truth.travel_deg(last_slot, None), 1.0)
        self.assert_still(truth, len(truth.rows) - 50)

    def test_when_the_bench_dies_lianad_ends_and_says_why(self):
        system, client = self.moving()
        system.kill("liana-bench")
        with self.assertRaises((ConnectionError, OSError)):
            client.go_on(60)
        self.assertEqual(system.ended("lianad"), 1)
        self.assertIn("the bus has ended", system.log("lianad"))
        self.assertEqual(system.ended("liana-bus"), 0)
        self.assertIn("liana-bench left", system.log("liana-bus"))

    def test_when_the_bus_dies_both_sides_end_and_say_why(self):
        system, client = self.moving()
        system.kill("liana-bus")
        with self.assertRaises((ConnectionError, OSError)):
            client.go_on(60)
        self.assertEqual(system.ended("lianad"), 1)
        self.assertIn("the bus has ended", system.log("lianad"))
        self.assertEqual(system.ended("liana-bench"), 0)
        self.assertEqual(system.truth().column("enabled")[-1], 0)


class ARunThatLosesAProgram(SystemTest):
    def killed(self, program):
        """`liana run` of which one program is killed once the arm moves: exit code, standard error."""
        process = start_run(self, MISSIONS / "short.lua")
        wait_until(lambda: program in children_of(process.pid), f"{program} to start")
        for line in process.stderr:
            if "prepare" in line:
                break
        os.kill(children_of(process.pid)[program], signal.SIGKILL)
        _, error = process.communicate(timeout=120)
        return process.returncode, error

    def test_a_run_names_the_program_that_was_killed_and_fails(self):
        for program in ("liana-bench", "lianad"):
            with self.subTest(program):
                code, error = self.killed(program)
                self.assertEqual(code, 1)
                self.assertIn(f"{program} was killed by signal 9", error)


if __name__ == "__main__":
    unittest.main(verbosity=2)
