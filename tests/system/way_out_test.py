"""A way out at every moment: what has been commanded leads back after a stop, beside a latched fault and after the death
of lianad; a retract ends, and says what it has done. And what a refusal says can be done, works.
"""
import json
import pathlib
import shutil
import tempfile
import unittest

from support import SystemTest
from liana.client import LianaError, brief
from liana.system import System, run, table

NEAR_DEG = 0.02  # from the pose in which the arm was enabled: what the controller is told is not what it measures


def beside(tip, along, by_m):
    """The pose of the tip, so far along a direction."""
    return [*(at + by_m * towards for at, towards in zip(tip, along)), *tip[3:]]


def apart_deg(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


class AtAPose(System):
    """The arm lies exactly at these angles before it is enabled: where another lianad has left it."""

    def __init__(self, pose_deg, **words):
        super().__init__(bench=("--start-pose", "prepare", "--jig"), **words)
        self.pose_deg = pose_deg

    def write_tables(self):
        super().write_tables()
        path = self.directory / "robot.json"
        robot = json.loads(path.read_text())
        robot["named_poses_deg"]["prepare"] = self.pose_deg
        path.write_text(json.dumps(robot))


class TheWayOut(SystemTest):
    def enabled(self, system):
        client = self.enterContext(system).client()
        client.enable()
        return client, list(client.go_on(0.1)["setpoint_js_deg"])

    def booted(self, system):
        client = self.enterContext(system).client()
        client.until(lambda state: state["is_homed"] and state["tick"] > 300)
        client.call("acquire")
        return client

    def moved(self, client, by_deg=3.0):
        """The arm at rest, this far from where it was."""
        goal = list(client.state["setpoint_js_deg"])
        goal[8] -= by_deg
        client.call("move_jp", goal_deg=goal)
        client.until(lambda state: state["is_busy"])
        client.until(lambda state: not state["is_busy"] and apart_deg(state["setpoint_js_deg"], goal) < 1e-6)

    def stopped_and_enabled(self, client, after_s):
        """Stopped, cleared so much later, enabled again and at rest."""
        client.call("stop")
        client.until(lambda state: state["state"] == "DISABLED")
        client.go_on(after_s)
        client.call("state_command", command="clear")
        client.until(lambda state: not state["stop"])
        client.call("state_command", command="enable")
        client.until(lambda state: state["state"] == "ENABLED" and state["at_rest"])
        client.go_on(0.1)

    def gone_back(self, client, **fields):
        """After a retract: the state in which it is over; its phases on the way."""
        client.call("retract", **fields)
        phases = []
        client.step()
        while client.state["retract"]["phase"] not in ("done", "ended"):
            if client.state["retract"]["phase"] not in phases:
                phases.append(client.state["retract"]["phase"])
            self.assertLessEqual(client.state["retract"]["points_left"], client.state["retract"]["points"])
            client.step()
            self.assertLess(len(client.state["faults"]), 3, brief(client.state))
        return client.state, phases

    def way_events(self, system):
        return [event.number for event in system.events() if event.kind == "retract"]

    def test_a_stop_and_a_clear_leave_the_way_back_as_it_was(self):
        system = System()
        client, start = self.enabled(system)
        self.moved(client)
        self.stopped_and_enabled(client, 0.5)
        self.assertGreater(apart_deg(client.state["setpoint_js_deg"], start), 2.0)
        state, phases = self.gone_back(client)
        self.assertEqual((state["retract"]["phase"], state["retracted"]), ("done", True), state["retract"])
        self.assertEqual(phases, ["stopping", "joining", "back"])
        self.assertLess(apart_deg(state["setpoint_js_deg"], start), 1e-4)
        self.assertTrue(state["at_rest"] and not state["is_busy"])
        self.moved(client, 1.0)
        self.assertFalse(client.state["retracted"], "it has moved on")
        system.shut_down(client)
        self.assertEqual(self.way_events(system), [4, 1, 2], "kept, begun, arrived")

    def test_an_arm_that_has_not_moved_is_told_that_there_is_no_way_and_not_that_it_is_back(self):
        client, _ = self.enabled(System())
        self.assert_refused(client.ask("retract"), "refused", "no stored path")
        self.assertFalse(client.step()["retracted"])

    def test_a_fault_that_holds_the_arm_leaves_the_way_back_open(self):
        system = System(faults=[{"drive": 14, "kind": "cable_slip", "length_m": 0.0005, "at_slot": 9000}])
        client, start = self.enabled(system)
        self.moved(client)
        self.assertLess(client.state["tick"], 9000, "the cable has to slip where there is a way back")
        client.until(lambda state: state["faults"], 60)
        client.until(lambda state: state["at_rest"])
        self.assert_refused(client.ask("move_jp", goal_deg=start), "fault")
        state, _ = self.gone_back(client)
        self.assertEqual(state["retract"]["phase"], "done", state["retract"])
        self.assertNotEqual(state["faults"], [], "nothing was cleared on the way")
        self.assertLess(apart_deg(state["setpoint_js_deg"], start), 1e-4)

    def test_after_the_death_of_lianad_another_one_leads_the_arm_back(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-way-"))
        self.addCleanup(shutil.rmtree, folder)
        first = System(retract_path=folder / "way.bin")
        client, start = self.enabled(first)
        self.moved(client)
        there = list(client.state["setpoint_js_deg"])
        client.go_on(0.2)
        first.kill("lianad")
        second = AtAPose(there, retract_path=folder / "way.bin")
        client, begin = self.enabled(second)
        self.assertLess(apart_deg(begin, there), 0.5)
        state, phases = self.gone_back(client)
        self.assertEqual((state["retract"]["phase"], "joining" in phases), ("done", True), state["retract"])
        self.assertLess(apart_deg(state["setpoint_js_deg"], start), 1e-4)

    def test_a_cable_that_was_lost_before_the_death_of_lianad_is_not_forgotten(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-way-"))
        self.addCleanup(shutil.rmtree, folder)
        kept = {"retract_path": folder / "way.bin"}
        broken = {"drive": 5, "kind": "cable_break"}
        first = System(faults=[{**broken, "when": {"moving": True, "for_slots": 50}}], **kept)
        client, _ = self.enabled(first)
        goal = list(client.state["setpoint_js_deg"])
        goal[8] -= 3.0
        client.call("move_jp", goal_deg=goal)
        client.until(lambda state: [fault["number"] for fault in state["faults"]][:1] == [5006])
        client.go_on(0.2)
        first.kill("lianad")

        second = System(faults=[{**broken, "at_slot": 200}], **kept)
        client = self.booted(second)
        for command, words in (("enable", {}), ("clear", {}), ("clear", {"whole": 4}), ("recover", {})):
            with self.assertRaisesRegex(LianaError, "cable 5 .*lost before.*--whole 5"):
                client.call("state_command", command=command, **words)
        client.call("state_command", command="clear", whole=5)
        client.go_on(0.5)
        client.call("state_command", command="clear")  # which makes no cable whole that was only called so
        client.go_on(0.5)
        client.call("state_command", command="enable")  # it takes no tension all the same
        client.until(lambda state: state["state"] == "ENABLING")
        begin = client.state["tick"]
        client.until(lambda state: state["state"] == "DISABLED")
        self.assertLess(client.state["tick"] - begin, 250 * 5)
        client.go_on(0.5)
        with self.assertRaisesRegex(LianaError, "cable 5"):
            client.call("state_command", command="enable")
        second.kill("lianad")

        claimed = System(**kept)
        client = self.booted(claimed)
        client.call("state_command", command="clear", whole=5)
        client.go_on(0.5)
        claimed.kill("lianad")  # before anything has shown that it is

        third = System(**kept)
        client = self.booted(third)
        with self.assertRaisesRegex(LianaError, "cable 5 .*lost before"):
            client.call("state_command", command="enable")
        client.call("state_command", command="clear", whole=5)  # repaired
        client.go_on(0.5)
        client.enable()
        client.go_on(0.1)
        third.kill("lianad")
        fourth = System(**kept)
        self.booted(fourth).enable()

    def test_out_of_the_slit_it_leads_after_a_stop_beside_a_body_nearer_than_commands_may_come(self):
        rod = json.loads(table("robot", "zhu2022"))["named_poses_deg"]["press_rod"]
        system = AtAPose(rod, seed=2)
        client, start = self.enabled(system)
        across = json.loads(table("scene", "panel_slit"))["slit"]["normal"]
        client.call("move_cp", goal=beside(client.state["setpoint_cp"], across, -0.015))
        client.until(lambda state: state["refusals"] and state["at_rest"], 60)
        self.assertEqual(client.state["verdict"]["name"], "scene_contact")
        self.stopped_and_enabled(client, 0.1)
        enabled_tick = client.state["tick"]
        state, _ = self.gone_back(client)
        self.assertEqual(state["retract"]["phase"], "done", state["retract"])
        self.assertLess(apart_deg(state["setpoint_js_deg"], start), 1e-4)
        system.shut_down(client)
        contact_N = system.truth().column("contact_force_N")
        self.assertEqual(max(contact_N[enabled_tick:]), 0.0)

    def test_a_way_that_does_not_lead_from_here_is_not_used(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-way-"))
        self.addCleanup(shutil.rmtree, folder)
        first = System(retract_path=folder / "way.bin")
        client, start = self.enabled(first)
        self.moved(client)
        first.kill("lianad")
        elsewhere = start[:8] + [start[8] - 7.0, start[9]]
        second = AtAPose(elsewhere, retract_path=folder / "way.bin")
        client, _ = self.enabled(second)
        self.assert_refused(client.ask("retract"), "refused", "given up", "allowed 50 mm")
        self.assertFalse(client.step()["retracted"])
        second.shut_down(client)
        self.assertEqual(self.way_events(second), [5])


class RemediesOfRefusals(SystemTest):
    """What is done here is what the remedy says."""

    def enabled(self):
        system = self.enterContext(System())
        client = system.client()
        client.enable()
        client.until(lambda state: state["at_rest"])
        return system, client

    def test_a_way_into_the_panel_ends_in_a_hold_and_leads_back(self):
        system, client = self.enabled()
        start = list(client.state["setpoint_js_deg"])
        beyond = [2.5, -0.4, 0.0]  # the wall of the slit
        client.call("move_cp", goal=[*beyond, *client.state["setpoint_cp"][3:]])
        state = client.until(lambda state: state["refusals"] and state["at_rest"], 120)
        self.assertEqual((state["verdict"]["name"], state["state"]), ("scene_contact", "ENABLED"), state["verdict"])
        self.assertIn("retract", state["verdict"]["remedy"].lower())
        client.call("retract")
        client.until(lambda state: state["retract"]["phase"] in ("done", "ended"), 300)
        self.assertEqual(client.state["retract"]["phase"], "done", client.state["retract"])
        self.assertLess(apart_deg(client.state["setpoint_js_deg"], start), 1e-4)
        self.assert_commands_tell_of(system, client, 208)

    def assert_commands_tell_of(self, system, client, code):
        """The file of commands has every stage, and the one that was refused with its reason."""
        system.shut_down(client)
        done = run("liana", "commands", system.commands, "--json", "--last", 100000)
        lives = [json.loads(line) for line in done.stdout.splitlines()]
        commands = [life for life in lives if life["command"]]
        self.assertEqual([life["command"] for life in commands], list(range(1, len(commands) + 1)))
        refused = [life for life in commands if life["refusal"]]
        self.assertIn(code, [life["refusal"]["code"] for life in refused])
        for life in commands:
            self.assertEqual(life["owner"], "test")
            self.assertEqual(
                life["simulation"]["margins"].keys(), {"clearance_m", "joint_deg", "rate_deg_s", "tension_N", "time_us"}
            )
            self.assertEqual(life["refusal"] is None, life["in_force_from"] is not None, life)
        self.assertGreater(
            sum(life["completed"] is not None for life in commands), 0.9 * (len(commands) - len(refused))
        )
        only = run("liana", "commands", system.commands, "--refused", "--json", "--last", 100000)
        self.assertEqual(
            [json.loads(line) for line in only.stdout.splitlines()], [life for life in lives if life["refusal"]]
        )
        margins = json.loads(run("liana", "commands", system.commands, "--margins", "--json").stdout)
        self.assertEqual(
            margins["joint_deg"]["least"], min(life["simulation"]["margins"]["joint_deg"] for life in commands)
        )

    def test_a_path_that_is_refused_as_a_whole_can_be_replaced_by_one_that_keeps_clear(self):
        _, client = self.enabled()
        here = list(client.state["setpoint_js_deg"])
        client.call("move_path", points_deg=[here, [0] * 10])
        client.until(lambda state: state["verdict"]["name"] == "path")
        self.assertFalse(client.until(lambda state: not state["is_busy"])["stop"])
        goal = here[:8] + [here[8] - 2.0, here[9]]
        client.call("move_path", points_deg=[here, goal])
        client.until(lambda state: not state["is_busy"] and apart_deg(state["setpoint_js_deg"], goal) < 1e-4, 60)

    def test_setpoints_out_of_order_are_refused_by_name_and_logged(self):
        system, client = self.enabled()
        goal = client.state["setpoint_cp"]
        client.call("servo_cp", goal=goal, sequence=5)
        for sequence in (5, 4):
            self.assert_refused(client.ask("servo_cp", goal=goal, sequence=sequence), "refused", "sequence")
        stranger = system.client("stranger", lockstep=False)
        stranger.request("servo_cp", goal=goal)
        client.go_on(0.2)
        system.shut_down(client)
        done = run("liana", "commands", system.commands, "--refused", "--json")
        said = [(life["owner"], life["refusal"]["text"]) for life in map(json.loads, done.stdout.splitlines())]
        self.assertEqual([owner for owner, _ in said], ["test", "test", "stranger"], said)
        self.assertIn("'test' owns motion", said[2][1])


if __name__ == "__main__":
    unittest.main(verbosity=2)
