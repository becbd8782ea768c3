"""A mission of the serial arm as users run it: repeatable, replayable, readable; and what a serial arm refuses."""
import json
import pathlib
import tempfile
import unittest

from recordings_test import content
from support import MISSIONS, SystemTest, start_run
from liana.client import RequestRefused
from liana.recordings import Mcap, Recording, Truth
from liana.system import System, run

SHORT = MISSIONS / "short_micro.lua"
FILES = ("ticks.mcap", "snapshots.mcap", "state.mcap", "truth.bin", "can0.log", "can1.log")
PATIENCE_S = 300


class SerialRuns(SystemTest):
    def runTest(self):
        """Lets setUpClass make an instance whose clean-ups outlive single tests."""

    def record(self, mission, seed):
        words = ("--robot", "micro", "--time", "fast", "--seed", seed, "--record", "record", "--json", "report.json")
        process = start_run(self, mission, *words)
        _, error = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 0, error)
        return process.home / "record"

    def assert_replays(self, folder, ticks):
        done = run("liana", "replay", folder, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads(done.stdout)
        self.assertEqual((result["differing_ticks"], result["missing_ticks"], result["complete"]), (0, 0, True))
        self.assertEqual((result["same_build"], result["images"]["state"]), (True, "whole"))
        self.assertGreater(result["ticks"], ticks)


class AShortMission(SerialRuns):
    """Three runs, two with one seed; their directories live as long as the class."""

    @classmethod
    def setUpClass(cls):
        keeper = cls()
        cls.addClassCleanup(keeper.doCleanups)
        cls.first, cls.second, cls.other = (keeper.record(SHORT, seed) for seed in (3, 3, 4))

    def test_two_runs_with_one_seed_are_identical_file_by_file(self):
        names, others = (
            sorted(str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file())
            for folder in (self.first, self.second)
        )
        self.assertEqual(names, others)
        self.assertLessEqual(set(FILES), set(names))
        for name in names:
            first, second = (content(folder, name) for folder in (self.first, self.second))
            if name == "state.mcap":
                first, second = (found[: min(len(first), len(second))] for found in (first, second))
                self.assertGreater(len(first), 500)
            self.assertTrue(first == second, f"{name} differs")

    def test_another_seed_gives_another_arm(self):
        for name in ("ticks.mcap", "truth.bin", "can0.log", "can1.log"):
            self.assertFalse((self.first / name).read_bytes() == (self.other / name).read_bytes(), name)

    def test_it_replays_bit_for_bit(self):
        self.assert_replays(self.first, 2500)

    def test_a_flipped_bit_in_the_recording_is_noticed(self):
        whole = bytearray((self.first / "ticks.mcap").read_bytes())
        whole[len(whole) // 2] ^= 1
        copy = self.second.parent / "flipped"
        copy.mkdir()
        (copy / "ticks.mcap").write_bytes(whole)
        self.assertEqual(run("liana", "replay", copy).returncode, 1)

    def test_the_recording_has_seven_drives_and_seven_joints(self):
        ticks = Recording(self.first / "ticks.mcap").ticks
        enabled = [tick for tick in ticks if tick.state == "ENABLED"]
        self.assertGreater(len(enabled), 2000)
        self.assertEqual({(len(tick.position), len(tick.target), len(tick.theta_rate)) for tick in ticks}, {(7, 7, 7)})
        self.assertGreater(max(abs(rate) for tick in enabled for rate in tick.theta_rate), 0.01)
        self.assertTrue(all(not tick.faults for tick in ticks))
        states = [message.json() for message in Mcap(self.first / "state.mcap").messages("state")]
        self.assertEqual({len(state["setpoint_js_deg"]) for state in states}, {7})

    def test_the_report_says_what_ran_and_that_the_arm_stands_safe(self):
        report = json.loads((self.first / "report.json").read_text())
        self.assertEqual([report[key] for key in ("robot", "outcome", "faults", "seed")], ["micro", "success", [], 3])
        truth = Truth(self.first / "truth.bin")
        self.assertEqual(max(truth.column("enabled")), 7)
        self.assert_stopped(truth, len(truth.rows) - 130)
        self.assertGreater(truth.travel_deg(0, None), 2.0)


class TheWholeMission(SerialRuns):
    def test_micro_reach_succeeds_and_replays(self):
        folder = self.record("micro_reach", 1)
        report = json.loads((folder / "report.json").read_text())
        self.assertEqual((report["outcome"], report["faults"], len(report["steps"])), ("success", [], 4))
        self.assertLess(report["open_loop_tip_error_m"], 0.02)
        self.assertLess(report["max_joint_torque_Nm"], 150.0)
        self.assert_replays(folder, 10000)


class TorqueDrivesAreEnabledAgain(SystemTest):
    def moves(self, client):
        """Joint 1 by 2 degrees, truly."""
        start_deg = client.state["measured_js_deg"]
        goal_deg = [start_deg[0] + 2.0, *start_deg[1:]]
        client.call("move_jp", goal_deg=goal_deg)
        client.go_on(1.0)
        state = client.until(lambda s: s["at_rest"] and not s["is_busy"], limit_s=120.0)
        self.assertEqual(state["faults"], [], state)
        self.assertAlmostEqual(state["measured_js_deg"][0], goal_deg[0], delta=0.5)  # dry friction holds it so far off

    def test_after_a_disable_and_after_an_emergency_stop_the_arm_moves_as_before(self):
        with System(robot="macro_micro", scene="none", bus="embedded_macro_micro") as system:
            client = self.enterContext(system.client())
            client.enable()
            self.moves(client)
            client.call("state_command", command="disable")
            client.until(lambda s: s["state"] == "DISABLED")
            client.enable()
            self.moves(client)
            client.call("stop")
            client.until(lambda s: s["state"] == "DISABLED", limit_s=20.0)
            client.call("state_command", command="clear")
            client.enable()
            self.moves(client)


def with_ball(center_m):
    """The empty scene with a ball of 0.1 m in it."""
    place = ", ".join(map(str, center_m))
    ball = f"{{ name = 'ball', center_m = {{ {place} }}, radius_m = 0.1 }}"
    return f"local t = require 'scenes.none'\nt.spheres = {{ {ball} }}\nreturn t\n"


def tip_of(robot, angles_deg):
    words = ("pose", "--robot", robot, "--theta-deg=" + ",".join(map(str, angles_deg)), "--json")
    return [row[3] for row in json.loads(run("liana", *words).stdout)["tip_pose"]][:3]


class BodiesInTheWayOfASerialArm(SystemTest):
    """Both ends of verification, for motion that leads into the scene or into the arm itself."""

    PREPARE_DEG = [0, 60, -30, 100, -40, 60, 0]

    def scene_file(self, scene):
        file = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "scene.lua"
        file.write_text(scene)
        return file

    def beyond(self, turn_deg):
        """Where the tip comes with joint 1 turned from `prepare`."""
        return tip_of("micro", [turn_deg, *self.PREPARE_DEG[1:]])

    def held_by(self, client, op, **goal):
        """The refusal that ends the way to this goal, and the state in which the arm stands then."""
        before = client.state["refusals"]
        client.call(op, **goal)
        state = client.until(lambda s: s["refusals"] > before and s["at_rest"], limit_s=120.0)
        return state["verdict"], state

    def refused_at_the_start(self, client, goal_deg):
        """The refusal of a whole way; the arm stays where it is."""
        before_deg = client.state["setpoint_js_deg"]
        verdict, state = self.held_by(client, "move_jp", goal_deg=goal_deg)
        self.assertEqual((verdict["name"], state["state"]), ("path", "ENABLED"), verdict)
        self.assertEqual(state["setpoint_js_deg"], before_deg)
        return verdict["text"]

    # req:C8
    def test_a_motion_into_a_ball_is_held_before_it_and_leads_back(self):
        ball_m = self.beyond(12.0)
        scene = str(self.scene_file(with_ball(ball_m)))
        with System(robot="micro", scene=scene, bus="embedded_micro", bench=("--start-pose", "prepare")) as system:
            client = self.enterContext(system.client())
            client.enable()
            start_deg = list(client.go_on(0.1)["setpoint_js_deg"])
            self.assert_names(self.refused_at_the_start(client, [24.0, *start_deg[1:]]), "%", "ball (link 7)")
            goal = [*self.beyond(24.0), *client.state["setpoint_cp"][3:7]]
            verdict, state = self.held_by(client, "move_cp", goal=goal)
            self.assertEqual((verdict["name"], state["state"]), ("scene_contact", "ENABLED"), verdict)
            self.assertIn("ball (link 7)", verdict["text"])
            off_m = sum((a - b) ** 2 for a, b in zip(state["measured_cp"], ball_m)) ** 0.5 - 0.1 - 0.15
            self.assertGreater(off_m, 0.008, "what is claimed has to be true")
            self.assertLess(off_m, 0.05, "and no motion is refused long before the ball")
            client.call("retract")
            client.until(lambda s: s["retract"]["phase"] in ("done", "ended"), 300)
            self.assertEqual(client.state["retract"]["phase"], "done", client.state["retract"])
            self.assertAlmostEqual(client.state["setpoint_js_deg"][0], start_deg[0], places=3)

    def test_a_motion_that_folds_the_arm_into_itself_is_refused_at_the_start(self):
        with System(robot="micro", scene="none", bus="embedded_micro", bench=("--start-pose", "zero")) as system:
            client = self.enterContext(system.client())
            client.enable()
            self.assert_names(self.refused_at_the_start(client, [0, 0, 0, 180, 0, 0, 0]), "%", "itself", "link 4")

    def test_the_start_pose_and_the_pose_that_a_step_goes_to_are_looked_at_before_anything_starts(self):
        start = tip_of("micro", [0, 0, 0, 0, 0, 0, 0])
        for words, center_m, says in (
            (("--start-pose", "zero"), start, ["at the start pose zero", "inside body ball"]),
            (("--start-pose", "zero"), self.beyond(0.0), ['step 1 "prepare"', "at pose prepare", "inside body ball"]),
        ):
            process = start_run(
                self, SHORT, "--robot", "micro", "--scene", self.scene_file(with_ball(center_m)), *words
            )
            out, error = process.communicate(timeout=PATIENCE_S)
            self.assertEqual((process.returncode, out), (2, ""), error)
            for word in says:
                self.assertIn(word, error)

    def test_verify_says_what_a_motion_would_meet_and_what_it_leaves(self):
        scene = self.scene_file(with_ball(self.beyond(12.0)))
        for turn_deg, code, body in ((2.0, None, "ball (link 7)"), (12.0, 208, "ball (link 7)")):
            ends = [
                f"--{word}-deg=" + ",".join(map(str, [angle_deg, *self.PREPARE_DEG[1:]]))
                for word, angle_deg in (("from", 0.0), ("to", turn_deg))
            ]
            done = run("liana", "verify", "--robot", "micro", "--scene", scene, *ends, "--duration", "20", "--json")
            verdict = json.loads(done.stdout)
            self.assertEqual((verdict["error"] or {}).get("code"), code, verdict)
            self.assertEqual(verdict["first"]["body"], body)
            self.assertEqual((verdict["margins"]["tension_N"], verdict["margins"]["time_us"]), (None, None))

    def test_the_arm_below_is_no_way_through(self):
        ends = [f"--{word}-deg=-137,{angle},-97,139,125,107,46" for word, angle in (("from", -57), ("to", -117))]
        words = ("verify", "--robot", "macro_micro", *ends, "--duration", "60", "--json")
        verdict = json.loads(run("liana", *words).stdout)
        self.assertEqual(verdict["error"]["code"], 209, verdict)
        self.assertIn("link 4 of macro (link 4)", verdict["error"]["text"])


class WhatASerialArmRefuses(SystemTest):
    def test_a_push_where_the_bus_table_has_no_wrist_sensor(self):
        bus = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "own.lua"
        bus.write_text("local t = require 'buses.embedded_payload'\nt.buses[2].wrist_sensor = nil\nreturn t\n")
        with System(robot="macro_micro", scene="none", bus=str(bus)) as system:
            client = self.enterContext(system.client())
            client.enable()
            with self.assertRaisesRegex(RequestRefused, "bus table.*wrist_sensor"):
                client.call("insert", force_N=20)

    def refused(self, *words, says):
        process = start_run(self, *words)
        out, error = process.communicate(timeout=PATIENCE_S)
        self.assertEqual((process.returncode, out), (2, ""), error)
        self.assert_names(error, *says)
        self.assertEqual(list(process.home.iterdir()), [], "nothing may be left behind")

    def test_options_that_are_about_cables(self):
        with tempfile.NamedTemporaryFile(suffix=".json") as file:
            for option, value in (("--calibration", file.name), ("--in-pose", "prepare"), ("--cross-wired", "1,2")):
                with self.subTest(option):
                    self.refused(SHORT, "--robot", "micro", option, value, says=[option, "micro", "serial"])

    def test_options_that_would_change_nothing(self):
        for option, value in (("--true-physics", "worn"), ("--operator", "model")):
            with self.subTest(option):
                self.refused(SHORT, "--robot", "micro", option, value, says=[option, "micro", "serial"])

    def test_the_payload_mission_in_a_scene_without_a_payload(self):
        self.refused("payload_install", "--scene", "none", says=["payload", "scene none"])

    def test_a_push_that_the_tables_do_not_have_before_the_start_by_run_and_check(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        mission = folder / "pushes.lua"
        tables = ("--robot", "macro_micro", "--bus", "embedded_payload", "--scene")
        for action, words, says in (
            ("insert { force_N = 20 }", ("--robot", "micro"), ("insert", "drives", "positions")),
            ("insert { force_N = 80 }", (*tables, "none"), ("force_N", "80", "0", "60")),
            ("adapter 'lock'", (*tables, "none"), ("scene none",)),
        ):
            mission.write_text(
                "local liana = require 'liana'\nreturn liana.mission 'pushes' {\nliana.step 'push' { device = 'none',"
                f" run = liana.{action}, exit = liana.at_rest(), time_limit_s = 9, on_fail = 'hold' }} }}\n"
            )
            where = ("pushes.lua:3", "mission pushes", "step 1", "push", "run")
            with self.subTest(action):
                self.refused(mission, *words, says=(*where, *says))
                done = run("liana", "check", mission, *words, cwd=folder)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assert_names(done.stderr, *where, *says)

    def test_a_plan_for_a_cable_arm(self):
        with tempfile.TemporaryDirectory() as folder:
            plan = pathlib.Path(folder) / "plan.json"
            plan.write_text(json.dumps({"format": 1, "kind": "plan", "outcome": "solved", "waypoints_deg": [[0] * 10]}))
            self.refused(plan, "--robot", "micro", says=["plans", "robot micro"])

    def test_a_mission_of_the_cable_arm(self):
        self.refused(MISSIONS / "steered.lua", "--robot", "micro", says=["steered.lua"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
