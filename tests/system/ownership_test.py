"""One owner of motion, and a stop that anybody may send."""
import contextlib
import json
import os
import pathlib
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

from support import MISSIONS, PYTHON, SystemTest, start_run
from liana.client import PATIENCE_S, brief, wait_until
from liana.system import System, program, run


class OwnershipOfMotion(SystemTest):
    def mission_under_way(self):
        system = self.enterContext(System("client,mission"))
        client = system.client()
        system.start_mission(MISSIONS / "short.lua")
        client.until(lambda state: state["owner"] == "mission" and state["step"] and not state["at_rest"], 120)
        return system, client

    def test_a_second_client_cannot_move_the_arm_and_the_mission_goes_on(self):
        system, client = self.mission_under_way()
        self.assert_refused(client.ask("acquire"), "not_owner", "mission")
        requests = {
            "move_jp": {"goal_deg": [0] * 10},
            "move_cp": {"goal": client.state["setpoint_cp"]},
            "servo_cp": {"goal": [2, 0, 0, 1, 0, 0, 0]},
            "hold": {},
            "retract": {},
            "release": {},
            "hold_theta": {"held": []},
            "shape": {"nodes": []},
            "tool": {"command": "x"},
            "use_device": {"device": "none"},
            "state_command": {"command": "disable"},
        }
        for op, fields in requests.items():
            self.assert_refused(client.ask(op, **fields), "not_owner", "mission")
        client.until(lambda state: state["owner"] == "", 60)
        self.assertEqual(system.ended("liana-mission"), 0, system.log("liana-mission"))
        self.assertEqual(system.json("mission.json")["outcome"], "success")
        self.assert_holds(client.state)
        self.assertAlmostEqual(client.state["setpoint_js_deg"][8], 11.0, delta=0.01)

    def test_an_emergency_stop_during_a_mission_brakes_disables_and_ends_the_mission_with_the_reason(self):
        system, client = self.mission_under_way()
        stopper = system.client("stopper", "observer", lockstep=False)
        number = stopper.request("stop", reason="hand on the red button")
        categories = set()
        while client.state["state"] != "DISABLED":
            categories.add(client.state["stop_category"])
            client.step()
            self.assertLess(client.state["tick"], 20000, brief(client.state))
        self.assertIn("stop", categories)
        tick = client.state["tick"]
        while number not in stopper.answers:
            stopper.next_state()
        self.assertEqual(stopper.answers[number]["op"], "ok")
        self.assertTrue(any("hand on the red button" in event["text"] for event in client.state["events"]))
        self.assertTrue(
            all(
                drive["state"] == "switch_on_disabled"
                for drive in client.until(lambda state: state["tick"] > tick + 25)["drives"]
            )
        )
        client.until(lambda state: state["owner"] == "", 60)
        self.assertEqual(system.ended("liana-mission"), 1)
        report = system.json("mission.json")
        self.assertEqual(report["outcome"], "aborted")
        self.assertIn("stop category stop", report["reason"])
        client.go_on(0.5)
        system.shut_down(client)
        self.assert_stopped(system.truth(), tick)

    def test_the_way_back_out_takes_the_device_from_an_operator_who_goes_on_steering(self):
        with System("client,mission,operator") as system:
            client = system.client()
            system.start_operator()
            system.start_mission(MISSIONS / "back_out.lua")
            start = client.until(lambda state: state["step"] and state["at_rest"], 60)["setpoint_js_deg"]
            client.until(lambda state: state["device_engaged"] and not state["at_rest"])
            client.until(lambda state: state["device"] == "none")
            self.assertGreater(
                max(abs(a - b) for a, b in zip(client.state["setpoint_js_deg"], start)),
                0.5,
                "there has to be a way back",
            )
            client.until(lambda state: state["owner"] == "", 60)
            self.assertTrue(client.state["retracted"])
            client.go_on(0.5)
            self.assert_holds(client.state)
            self.assertLess(max(abs(a - b) for a, b in zip(client.state["setpoint_js_deg"], start)), 1e-6)
            self.assertEqual(system.ended("liana-mission"), 1, system.log("liana-mission"))
            report = system.json("mission.json")
            self.assertEqual(report["outcome"], "aborted", report)
            self.assert_names(report["reason"], "retracted", "verified path")

    def test_after_a_stop_another_client_can_enable_again(self):
        with System() as system:
            client = system.client()
            client.enable()
            client.start_moving()
            client.call("stop", reason="test")
            client.until(lambda state: state["state"] == "DISABLED")
            self.assert_refused(client.ask("move_jp", goal_deg=[0] * 10), "not_enabled")
            client.call("release")
            second = system.client("second", lockstep=False)
            second.request("acquire")
            client.until(lambda state: state["owner"] == "second")
            second.request("state_command", command="enable")
            client.until(lambda state: state["state"] == "ENABLED" and state["at_rest"])
            self.assert_holds(client.state)

    def test_the_death_of_an_owner_in_motion_is_a_hold_and_ownership_is_free(self):
        with System() as system:
            watcher = system.client("watcher")
            owner = system.client("owner", lockstep=False)
            owner.request("acquire")
            watcher.until(
                lambda state: state["owner"] == "owner" and state["state"] == "DISABLED" and state["is_homed"]
            )
            owner.request("state_command", command="enable")
            watcher.until(lambda state: state["state"] == "ENABLED" and state["at_rest"])
            goal = list(watcher.state["setpoint_js_deg"])
            goal[8] -= 6.0
            owner.request("move_jp", goal_deg=goal)
            watcher.until(lambda state: state["is_busy"] and abs(state["setpoint_js_deg"][8] - goal[8]) < 5.5)
            owner.close()
            watcher.until(lambda state: state["owner"] == "")
            watcher.until(lambda state: state["at_rest"] and not state["is_busy"])
            self.assert_holds(watcher.state)
            self.assertGreater(abs(watcher.state["setpoint_js_deg"][8] - goal[8]), 1.0, "the move must not go on")
            watcher.call("acquire")

    def test_the_command_line_estop_stops_the_arm(self):
        with System() as system:
            client = system.client()
            client.enable()
            client.start_moving()
            system.start("liana", "estop", "--api", system.api)
            client.until(lambda state: state["state"] == "DISABLED")
            self.assertEqual(system.ended("liana"), 0, system.log("liana"))
            self.assertTrue(any("liana estop" in event["text"] for event in client.state["events"]))


class StopsBeforeTheArmIsEnabled(SystemTest):
    """A stop is final for the mission, whatever the drives are doing when it comes (BOOTING, DISABLED, ENABLING)."""

    def stopped_in(self, wanted):
        system = self.enterContext(System("client,mission"))
        client = system.client()
        system.start_mission(MISSIONS / "short.lua")
        client.until(lambda state: state["state"] == wanted)
        stopper = system.client("red button", "observer", lockstep=False, subscribe=())
        number = stopper.request("stop")
        client.until(lambda state: state["stop"])
        self.assertEqual(stopper.receive(), {"op": "ok", "id": number})
        self.assertEqual((client.state["stop"]["by"], client.state["stop"]["reason"]), ("red button", ""))
        client.until(lambda state: state["state"] == "DISABLED" and state["owner"] == "")
        self.assertEqual(system.ended("liana-mission"), 1)
        report = system.json("mission.json")
        self.assertEqual((report["outcome"], report["steps"]), ("aborted", []))
        self.assert_names(report["reason"], "emergency stop", "red button")
        self.assertEqual(report["reason"].count("red button"), 1, report["reason"])
        client.go_on(0.5)
        self.assertEqual(client.state["state"], "DISABLED", brief(client.state))
        system.shut_down(client)
        return system.truth()

    def test_a_stop_while_the_drives_boot_keeps_them_without_power_and_aborts_the_mission(self):
        self.assertEqual(max(self.stopped_in("BOOTING").column("enabled")), 0)

    def test_a_stop_between_booting_and_enabling_does_the_same(self):
        self.assertEqual(max(self.stopped_in("DISABLED").column("enabled")), 0)

    def test_a_stop_while_the_drives_are_being_enabled_takes_their_power_and_aborts_the_mission(self):
        truth = self.stopped_in("ENABLING")
        self.assert_stopped(truth, len(truth.rows) - 130)

    def test_after_a_stop_motion_has_to_be_acquired_anew_or_cleared_before_anybody_enables(self):
        with System() as system:
            client = system.client()
            client.call("acquire")
            client.call("stop", reason="look first")
            client.until(lambda state: state["state"] == "DISABLED" and state["is_homed"])
            self.assert_refused(
                client.ask("state_command", command="enable"), "refused", "emergency stop by test: look first", "clear"
            )
            client.call("state_command", command="clear")
            client.until(lambda state: state["stop"] is None)
            client.call("stop")
            client.call("acquire")
            self.assertIsNone(client.step()["stop"])
            client.call("state_command", command="enable")
            client.until(lambda state: state["state"] == "ENABLED")


class StopsFromTheCommandLine(SystemTest):
    """Without --api, `liana status` and `estop` deal with every system of the user, `clear` with the only one."""

    def setUp(self):
        self.home = tempfile.mkdtemp(prefix="liana-home-")
        self.addCleanup(shutil.rmtree, self.home)
        self.enterContext(unittest.mock.patch.dict(os.environ, XDG_RUNTIME_DIR=self.home))

    def moving(self, faults=None):
        system = self.enterContext(System(faults=faults))
        client = system.client()
        client.enable()
        client.start_moving()
        return system, client

    def while_running(self, command, clients):
        """`liana COMMAND --json` while time goes on for all clients: exit code and a list of what it printed."""
        process = subprocess.Popen(
            [program("liana"), command, "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        while process.poll() is None:
            for client in clients:
                client.step()
        out, error = process.communicate()
        return process.returncode, [json.loads(line) for line in out.splitlines()], error

    def test_without_api_every_running_system_is_listed_and_stopped_by_name(self):
        first, client = self.moving()
        second, other = self.moving()
        code, states, error = self.while_running("status", [client, other])
        self.assertEqual((code, {state["api"] for state in states}), (0, {str(first.api), str(second.api)}), error)
        self.assertEqual({state["state"] for state in states}, {"ENABLED"})
        code, stops, error = self.while_running("estop", [client, other])
        self.assertEqual(code, 0, error)
        self.assertEqual(
            {(stop["api"], stop["stopped"]) for stop in stops}, {(str(first.api), True), (str(second.api), True)}
        )
        for each in (client, other):
            each.until(lambda state: state["state"] == "DISABLED")
            self.assertEqual(each.state["stop"]["by"], "liana estop")

    def test_the_death_of_the_newest_system_does_not_hide_an_older_one(self):
        first, client = self.moving()
        second, _ = self.moving()
        second.kill("lianad")
        code, stops, error = self.while_running("estop", [client])
        self.assertEqual((code, stops), (0, [{"api": str(first.api), "stopped": True}]), error)
        client.until(lambda state: state["state"] == "DISABLED")
        first.shut_down(client)
        done = run("liana", "status")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assert_names(done.stderr, "no system")

    def test_clear_takes_back_the_stop_and_the_faults_by_name_and_enables_nothing(self):
        _, client = self.moving([{"drive": 4, "kind": "fault", "at_slot": 2500}])
        client.until(lambda state: state["faults"])
        code, _, error = self.while_running("clear", [client])
        self.assertEqual(code, 1)
        self.assertRegex(error, "nothing was cleared|'test'")  # the arm may still be stopping
        client.until(lambda state: state["state"] == "FAULT")
        code, refused, error = self.while_running("clear", [client])
        self.assertEqual((code, refused[0]["cleared"], refused[0]["taken_from"]), (1, False, ""))
        self.assert_names(error, "test", "owns", "press c")
        self.assert_names(refused[0]["said"], "test", "owns")
        self.assertEqual((client.state["owner"], len(client.state["faults"])), ("test", 1))
        self.assertEqual(self.while_running("estop", [client])[0], 0)
        code, cleared, error = self.while_running("clear", [client])
        self.assertEqual((code, error, cleared[0]["taken_from"]), (0, "", "test"))
        self.assertEqual(
            (cleared[0]["cleared"], cleared[0]["stop"]["by"], cleared[0]["faults"][0]["number"]),
            (True, "liana estop", 3003),
        )
        self.assertIn("faults cleared; checked: ", cleared[0]["said"])
        client.until(
            lambda state: state["state"] == "DISABLED"
            and not state["faults"]
            and not state["stop"]
            and not state["owner"]
        )
        client.go_on(1.0)
        self.assertEqual(client.state["state"], "DISABLED")
        self.assertEqual(self.while_running("clear", [client])[1][0]["stop"], None)
        client.enable()

    def test_one_system_that_stands_still_keeps_the_stop_from_no_other_and_is_named_within_a_second(self):
        first, client = self.moving()
        second, other = self.moving()
        process = second.children["lianad"]
        process.send_signal(signal.SIGSTOP)
        self.addCleanup(process.send_signal, signal.SIGCONT)
        strangers = []
        for _ in range(80):  # more than its queue of connections holds
            stranger = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            self.addCleanup(stranger.close)
            stranger.setblocking(False)
            with contextlib.suppress(BlockingIOError):
                stranger.connect(str(second.api))
            strangers.append(stranger)
        start = time.monotonic()
        code, stops, error = self.while_running("estop", [client])
        self.assertLess(time.monotonic() - start, 1.5)
        self.assertEqual(code, 1)
        stopped = {stop["api"]: stop["stopped"] for stop in stops}
        self.assertEqual(stopped, {str(first.api): True, str(second.api): False})
        self.assertIn(str(second.api), error)
        self.assertIn("cut the power", error)
        client.until(lambda state: state["state"] == "DISABLED")
        process.send_signal(signal.SIGCONT)
        for stranger in strangers:
            stranger.close()
        self.assertEqual(self.while_running("estop", [client, other])[0], 0)
        other.until(lambda state: state["state"] == "DISABLED")

    def test_silent_clients_do_not_lock_the_stop_out(self):
        system, client = self.moving()
        for _ in range(40):
            stranger = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            self.addCleanup(stranger.close)
            stranger.connect(str(system.api))
            client.step()
        self.assertEqual(self.while_running("estop", [client])[0], 0)
        client.until(lambda state: state["state"] == "DISABLED")

    def test_a_fault_that_is_still_there_is_not_cleared_and_several_systems_are_not_cleared_at_once(self):
        first, client = self.moving([{"drive": 4, "kind": "silent", "at_slot": 2500}])
        client.until(lambda state: state["state"] == "FAULT")
        client.call("release")
        code, cleared, error = self.while_running("clear", [client])
        self.assertEqual((code, cleared[0]["cleared"], cleared[0]["faults"][0]["number"]), (1, False, 3002))
        self.assert_names(error, "faults", "not met")
        second, other = self.moving()
        code, cleared, error = self.while_running("clear", [client, other])
        self.assertEqual((code, cleared[0]["error"]["exit_code"]), (2, 2))
        for system in (first, second):
            self.assertIn(str(system.api), error)

    def test_a_long_path_or_its_dead_link_keeps_the_stop_from_no_other(self):
        system, client = self.moving()
        far = pathlib.Path(self.home) / ("d" * 120)
        far.mkdir()
        link = pathlib.Path(self.home) / f"liana-{os.getuid()}" / "1"
        link.symlink_to(far / "api.sock")
        code, stops, error = self.while_running("estop", [client])
        self.assertEqual((code, stops), (0, [{"api": str(system.api), "stopped": True}]), error)
        client.until(lambda state: state["state"] == "DISABLED")
        os.rename(system.api, far / "api.sock")
        next(own for own in link.parent.iterdir() if own != link).unlink()
        code, stops, error = self.while_running("estop", [client])
        self.assertEqual((code, stops), (0, [{"api": str(far / "api.sock"), "stopped": True}]), error)
        self.assertEqual(self.while_running("status", [client])[0], 0)

    def test_a_stop_from_another_runtime_folder_finds_a_run(self):
        process = start_run(self, MISSIONS / "short.lua", "--time", "paced", "--json", "report.json")
        with unittest.mock.patch.dict(os.environ, XDG_RUNTIME_DIR=str(process.home)):
            wait_until(lambda: run("liana", "status").stdout.count("ENABLED"), "the arm to be enabled")
        with unittest.mock.patch.dict(os.environ, TMPDIR=str(process.home)):
            done = run("liana", "estop")
        self.assertEqual(done.returncode, 0, done.stderr)
        process.communicate(timeout=PATIENCE_S)
        self.assertEqual(json.loads((process.home / "report.json").read_text())["outcome"], "aborted")

    def test_few_descriptors_of_lianad_do_not_lock_the_stop_out(self):
        system, client = self.moving()
        lianad = system.children["lianad"].pid
        resource.prlimit(lianad, resource.RLIMIT_NOFILE, (len(os.listdir(f"/proc/{lianad}/fd")) + 10,) * 2)
        hello = b'{"op":"hello","name":"s","role":"observer","subscribe":["state"]}'
        for i in range(60):
            stranger = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            self.addCleanup(stranger.close)
            stranger.settimeout(1)
            stranger.connect(str(system.api))
            with contextlib.suppress(OSError):
                stranger.send(hello if i % 2 else b"{")
            client.step()
        self.assertEqual(self.while_running("estop", [client])[0], 0)
        client.until(lambda state: state["state"] == "DISABLED")

    def stuck_owner(self, system, client):
        """A process that owns motion and stands still."""
        client.call("release")
        code = "import sys; from liana.client import Client; c = Client(sys.argv[1], 'stuck'); c.call('acquire')"
        words = [sys.executable, "-c", code + "; print('owns', flush=True); c.receive(); import time; time.sleep(999)"]
        owner = subprocess.Popen(
            [*words, str(system.api)], stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(PYTHON)}
        )
        self.addCleanup(owner.communicate)
        self.addCleanup(owner.kill)
        client.until(lambda state: state["owner"] == "stuck")
        owner.send_signal(signal.SIGSTOP)
        return owner

    def silent_owner(self, system, client):
        """The same, until lianad lets others take motion from it."""
        self.stuck_owner(system, client)
        begin = time.monotonic()
        wait_until(lambda: (client.step(), time.monotonic() > begin + 5.5)[1], "5 s of silence")

    def test_recover_takes_motion_from_an_owner_that_stands_still_though_nothing_is_lost(self):
        system, client = self.moving()
        self.silent_owner(system, client)
        code, said, _ = self.while_running("recover", [client])
        self.assertEqual((code, said[0]["taken_from"], said[0]["recovered"]), (1, "stuck", False))
        client.until(lambda state: not state["owner"])

    def test_clear_takes_motion_from_an_owner_that_stands_still_and_gives_it_back(self):
        system, client = self.moving([{"drive": 4, "kind": "fault", "at_slot": 2500}])
        self.silent_owner(system, client)
        client.until(lambda state: state["state"] == "FAULT")
        code, cleared, error = self.while_running("clear", [client])
        self.assertEqual((code, error, cleared[0]["taken_from"]), (0, "", "stuck"))
        client.until(lambda state: not state["owner"] and state["state"] == "DISABLED")

    def test_an_owner_that_stands_still_loses_motion_after_a_stop_and_is_named_by_process(self):
        system, client = self.moving()
        owner = self.stuck_owner(system, client)
        self.assert_refused(client.ask("hold"), "not_owner", "'stuck' owns motion", f"process {owner.pid}")
        self.assert_refused(client.ask("acquire"), "not_owner", "'stuck' owns motion", f"process {owner.pid}")
        self.assertEqual(self.while_running("estop", [client])[0], 0)
        client.until(lambda state: state["state"] == "DISABLED")
        client.call("acquire", **{"from": "stuck"})
        self.assertEqual(client.state["owner"], "test")
        taken = [event for event in client.events if event["kind"] == "owner" and event["number"] == 5]
        self.assertEqual([event["subject"] for event in taken], ["stuck"])
        self.assertIn(f"process {owner.pid}", taken[0]["text"])
        client.call("state_command", command="enable")
        client.until(lambda state: state["state"] == "ENABLED" and state["at_rest"])

    def test_a_folder_of_somebody_else_is_not_believed(self):
        (pathlib.Path(self.home) / f"liana-{os.getuid()}").symlink_to("/")
        done = run("liana", "estop")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, rf"liana-{os.getuid()} .*\buser\b")

    def test_the_report_of_a_run_says_who_stopped_it(self):
        process = start_run(self, MISSIONS / "short.lua", "--time", "paced", "--json", "report.json")
        with unittest.mock.patch.dict(os.environ, XDG_RUNTIME_DIR=str(process.home)):
            wait_until(lambda: run("liana", "status").stdout.count("ENABLED"), "the arm to be enabled")
            self.assertEqual(run("liana", "estop").returncode, 0)
        process.communicate(timeout=PATIENCE_S)
        report = json.loads((process.home / "report.json").read_text())
        self.assertEqual((process.returncode, report["outcome"]), (1, "aborted"))
        self.assert_names(report["reason"], "emergency stop", "liana estop")


class NobodyToTalkTo(SystemTest):
    def test_status_estop_and_clear_without_lianad_fail_with_one_message(self):
        for command in ("status", "estop", "clear"):
            done = run("liana", command, "--api", "/nonexistent/api")
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("/nonexistent/api", done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
