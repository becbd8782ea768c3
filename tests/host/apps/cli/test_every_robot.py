"""Every command for every robot: the shipped arms, and arms that the test makes up by seed (2 to 8 segments, 3 or 4 cables
each), with nothing but a robot table.
"""
import json
import pathlib
import random
import sys
import tempfile
import unittest

from made_up_arms import TOUR, angles_of, loaded, table_of, tip_of
from programs import liana, liana_json
from message import Messages

SHIPPED = {
    "three_segment_lab": ("lab_tour", "lab_box", "-6,3,5,-5,8,4"),
    "tdcr_benchmark": ("tdcr_tour", "none", "2,5,-1,4"),
    "lab_1g": ("lab_tour", "none", "-6,3,5,-5,8,4"),
}
MADE_UP = 2
CARRY = """
local liana = require "liana"
local function pose(name)
  return liana.step(name) {
    device = "none", run = liana.move_to(name), exit = liana.all { liana.at_pose(name, 0.5), liana.at_rest() },
    time_limit_s = 60, on_fail = "hold",
  }
end
local waited = liana.condition("the weight hangs", function(arm) return arm.elapsed_s(arm.begin_tick) > 6 end)
return liana.mission "carry" {
  robot = "lab_1g", scene = "none",
  pose "park",
  liana.step "carry" {
    device = "none", enter = liana.at_rest(), run = liana.payload { mass_kg = %g }, exit = waited, time_limit_s = 30, on_fail = "hold",
  },
  pose "look", pose "park",
}
"""


def joined(numbers):
    return ",".join(repr(float(x)) for x in numbers)


class EveryRobot(Messages, unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="liana-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def crosses(self, robot, mission, scene):
        """The mission succeeds on the simulated arm, and its recording is played again without a difference."""
        record = self.folder / f"record_{pathlib.Path(robot).stem}"
        code, _, error = liana(
            "run",
            mission,
            "--robot",
            robot,
            "--scene",
            scene,
            "--record",
            record,
            "--json",
            self.folder / "report.json",
        )
        report = json.loads((self.folder / "report.json").read_text()) if code in (0, 1) else {}
        self.assertEqual((code, report.get("outcome")), (0, "success"), error)
        self.assertEqual(liana_json("replay", record)["differing_ticks"], 0)

    def is_served(self, robot, goal_deg):
        """What needs no motion works, with nothing but the robot's table."""
        angles = goal_deg.count(",") + 1
        zero = ",".join(["0"] * angles)
        half = joined(0.5 * float(angle) for angle in goal_deg.split(","))
        self.assertIn("tip_pose", liana_json("pose", "--robot", robot, f"--theta-deg={goal_deg}"))
        self.assertTrue(liana_json("reach", "--robot", robot)["boundary"])
        self.assertTrue(liana_json("faults", "--robot", robot))
        verdict = liana_json(
            "verify", "--robot", robot, "--scene", "none", f"--from-deg={half}", f"--to-deg={half}", "--duration=0.02"
        )
        self.assertTrue(verdict["accepted"], verdict)
        plan = self.folder / "plan.json"
        planned = ("--robot", robot, "--scene", "none", f"--from-deg={zero}", f"--to-deg={half}", "--waypoints", 3)
        self.assertEqual(liana("plan", *planned, "--out", plan)[0], 0)
        self.assertEqual(liana("robot", "export", robot)[0], 0)
        checked = liana_json("robot", "check", robot, "--svg", self.folder / "routing.svg")
        self.assertEqual(checked["problems"], [])
        self.assertIn("Cable routing", (self.folder / "routing.svg").read_text())

    def test_the_shipped_arms_are_served_and_do_their_tours(self):
        for robot, (mission, scene, goal_deg) in SHIPPED.items():
            with self.subTest(robot):
                self.is_served(robot, goal_deg)
                self.crosses(robot, mission, scene)

    def test_the_shipped_arms_are_calibrated_in_the_fixtures_of_their_tables(self):
        for robot in SHIPPED:
            with self.subTest(robot):
                code, out, error = liana("calibrate", "--robot", robot, "--json")
                self.assertEqual(code, 0, out + error)

    def test_an_arm_whose_drives_have_a_gear_does_its_tour(self):
        for gear in (5, 0.2):
            with self.subTest(gear):
                table = json.loads(liana("robot", "export", "lab_1g")[1])
                table["drives"].update(gear=gear, counts_per_turn=round(16384 / gear))
                file = self.folder / f"gear_{gear}.json"
                file.write_text(json.dumps(table))
                mission, scene, _ = SHIPPED["lab_1g"]
                self.crosses(file, mission, scene)

    def test_what_does_not_fit_is_named(self):
        table = json.loads(liana("robot", "export", "three_segment_lab")[1])
        table["cables"]["phase_deg"][1] = table["cables"]["phase_deg"][0]
        table["tension"]["ceiling_free_N"] = 31
        table["jig_poses"] = ["zero", "park"]
        file = self.folder / "robot.json"
        file.write_text(json.dumps(table))
        checked = liana_json("robot", "check", file, expected=(1,))
        text = "\n".join(checked["problems"])
        for named in (
            ("cable 1 (segment 1) and cable 4 (segment 2)", "holes", "0 mm"),
            ("pose look", "tensions"),
            ("jig_poses",),
        ):
            self.assert_names(text, *named)
        code, out, _ = liana("robot", "check", file)
        self.assertEqual((code, out.splitlines()[-1]), (1, "does NOT fit as it is"))

    def test_readings_that_are_too_coarse_for_the_cable_are_named_with_what_is_allowed(self):
        for field, value, fits, kind in (
            ("counts_per_turn", 256, False, "problems"),
            ("rated_torque_Nm", 400, False, "problems"),
            ("rated_torque_Nm", None, True, "notes"),
        ):
            with self.subTest(field, value=value):
                table = json.loads(liana("robot", "export", "lab_1g")[1])
                half = 4500 * table["drives"]["drum_radius_m"]  # 4.5 N a permille, of 7 that are a jump
                table["drives"][field] = value or half
                file = self.folder / "coarse.json"
                file.write_text(json.dumps(table))
                checked = liana_json("robot", "check", file, expected=(0 if fits else 1,))
                self.assert_names("\n".join(checked[kind]), "cables.monitor.jump_N", "5005", f"drives.{field}")
                self.assertGreater(checked["N_per_count"] + checked["N_per_permille"], 3.5 if fits else 7)

    def test_what_an_arm_can_carry_is_the_same_for_check_and_reach_and_its_picture_is_drawn(self):
        picture = self.folder / "carry.svg"
        reach = liana_json("reach", "--robot", "lab_1g", "--carry", "--samples=2000", "--svg", picture)["carries"]
        self.assertEqual(reach, liana_json("robot", "check", "lab_1g")["carries"])
        self.assertEqual(len(reach), 7)
        hanging = reach[1]["payload_named_poses"]
        self.assertGreater(hanging["mass_kg"], reach[0]["payload_named_poses"]["mass_kg"])
        self.assertIn(hanging["cable"], range(1, 10))
        self.assertIn(reach[6]["mounting"], picture.read_text())
        code, _, error = liana("reach", "--robot", "lab_1g", "--carry", "--node=1")
        self.assertEqual(code, 2)
        self.assertIn("--carry", error)

    def test_a_run_of_an_arm_whose_cables_cannot_hold_a_named_pose_is_refused_at_once_with_pose_and_cable(self):
        table = json.loads(liana("robot", "export", "zhu2022")[1])
        table["gravity_m_s2"] = [0, 0, -0.05 * 9.80665]
        file = self.folder / "rig.json"
        file.write_text(json.dumps(table))
        code, _, error = liana("run", "slit_crossing", "--robot", file)
        self.assertEqual(code, 2, error)
        self.assert_names(error, "--robot", "pose", "cable", "150 N")

    def test_a_pose_that_the_cables_cannot_hold_is_refused_by_ik_with_its_cable_and_by_plan(self):
        table = json.loads(liana("robot", "export", "lab_1g")[1])
        table["tool"]["mass_kg"] = 3.0
        file = self.folder / "heavy.json"
        file.write_text(json.dumps(table))
        straight = joined([0] * 6)
        answer = liana_json("ik", "--robot", file, f"--from-deg={straight}", "--tip=0.9,0,0,1,0,0,0", expected=(1,))
        self.assertTrue(answer["converged"])
        self.assert_names(answer["refused"], "cable", "segment 1", "200.0")
        self.assertGreater(answer["max_tension_N"], 200)
        code, out, error = liana(
            "plan", "--robot", file, "--scene", "none", f"--from-deg={straight}", f"--to-deg={joined([1] * 6)}"
        )
        self.assertNotEqual(code, 0)
        self.assert_names(out + error, "cable", "200")

    def test_a_payload_that_a_mission_tells_of_is_held_and_one_that_is_too_heavy_is_refused_with_its_cable(self):
        mission = self.folder / "carry.lua"
        hanging = self.folder / "hanging.json"
        for mass_kg, expected in ((0.5, "success"), (3.0, "refused")):
            with self.subTest(mass_kg):
                mission.write_text(CARRY % mass_kg)
                weight = {"kind": "external_force", "link": 0, "z_N": -9.80665 * mass_kg, "slots": 250, "at_slot": 2500}
                hanging.write_text(json.dumps([weight] if expected == "success" else []))
                words = ("run", mission, "--faults", hanging, "--seed", 7, "--record", self.folder / str(mass_kg))
                liana(*words, "--json", self.folder / "report.json")
                report = json.loads((self.folder / "report.json").read_text())
                self.assertEqual((report["outcome"], report["faults"]), (expected, []), report)
                self.assertEqual(liana_json("replay", self.folder / str(mass_kg))["differing_ticks"], 0)
        self.assert_names(report["steps"][-1]["reason"], "payload", "cable", "200.0 N")

    def new(self, name, *answers):
        """A table that `liana robot new` writes."""
        file = self.folder / f"{name}.lua"
        self.assertEqual(liana("robot", "new", name, "--out", file, *answers)[0], 0)
        return file

    def test_a_new_table_fits_whatever_was_answered(self):
        for segments, cables, modules, length_m, radius_m, limit_deg in (
            (1, 3, 16, 0.02, 0.01, 5),
            (2, 4, 4, 0.01, 0.008, 9),
            (4, 3, 10, 0.1, 0.05, 20),
            (8, 3, 2, 0.3, 0.1, 30),
            (8, 4, 8, 0.05, 0.02, 8),
            (3, 5, 5, 0.06, 0.035, 15),
        ):
            words = ("--segments", segments, "--cables", cables, "--modules", modules, "--module-length", length_m)
            file = self.new(f"new_{segments}_{cables}", *words, "--radius", radius_m, "--theta-limit", limit_deg)
            with self.subTest(segments=segments, cables=cables):
                checked = liana_json("robot", "check", file)
                self.assertEqual((checked["problems"], checked["cables"]), ([], segments * cables))

    def test_a_new_small_arm_is_small_in_all_and_carries_out_a_mission(self):
        file = self.new("small", "--segments", 2, "--modules", 3, "--module-length", 0.02)
        table = json.loads(liana("robot", "export", file)[1])
        self.assertEqual(table["module"]["radius_m"], 0.0063)
        checked = liana_json("robot", "check", file)
        self.assertEqual((checked["problems"], checked["notes"]), ([], []))
        code, out, error = liana("calibrate", "--robot", file, "--poses", "zero,bent,back", "--json")
        self.assertEqual(code, 0, out + error)
        mission = self.folder / "tour.lua"
        mission.write_text(TOUR.replace('"first"', '"bent"').replace('"second"', '"back"'))
        self.crosses(file, mission, "none")

    def test_an_arm_whose_cables_move_too_little_to_be_calibrated_says_so(self):
        file = self.new("stiff", "--modules", 1, "--theta-limit", 5)
        notes = liana_json("robot", "check", file)["notes"]
        self.assert_names(notes[0], "segment 1", "liana calibrate")

    def test_a_new_arm_of_four_cables_a_segment_can_be_calibrated(self):
        file = self.new("four", "--segments", 2, "--cables", 4)
        code, out, error = liana("calibrate", "--robot", file, "--poses", "zero,bent,back", "--json")
        self.assertEqual(code, 0, out + error)

    def test_four_cables_in_opposite_pairs_are_named_as_what_no_pose_tells_apart(self):
        file = self.new("pairs", "--segments", 2, "--cables", 4)
        file.write_text(file.read_text().replace("{ 0, 75, 150, 270 }", "{ 0, 90, 180, 270 }"))
        code, out, error = liana("calibrate", "--robot", file, "--poses", "zero,bent,back")
        self.assertEqual((code, out), (2, ""), error)
        self.assert_names(error, "cable 1 (segment 1) and cable 3 (segment 1)", "opposite")

    def test_what_no_arm_can_have_is_refused_before_a_file_is_written(self):
        for words, named in (
            (("Desk", "--out"), ("small letters",)),
            (("desk", "--segments", 9, "--out"), ("--segments", "9", "1", "8", "whole")),
            (("desk", "--cables", "many", "--out"), ("--cables",)),
            (("desk", "--radius", "nan", "--out"), ("--radius",)),
        ):
            file = self.folder / "refused.lua"
            code, out, error = liana("robot", "new", *words, file)
            self.assertEqual((code, out, file.exists()), (2, "", False), words)
            self.assert_names(error, *named)
        file = self.new("desk")
        self.assertIn("exists already", liana("robot", "new", "desk", "--out", file)[2])

    def test_a_robot_with_a_serial_arm_is_checked_for_its_buses(self):
        self.assertEqual(liana_json("robot", "check", "micro")["joints"], 7)
        self.assertEqual(liana("robot", "check", "micro", "--svg", self.folder / "none.svg")[0], 2)
        for robot in ("micro", "macro", "macro_micro"):
            self.assertEqual(liana_json("robot", "check", robot)["problems"], [], robot)

    def test_how_the_locked_base_of_a_serial_arm_swings_is_told(self):
        swings = {}
        for robot in ("macro_micro", "macro_micro_stiff"):
            words = ("robot", "check", robot, "--scene", "payload_adapter", "--bus", "embedded_payload")
            swings[robot] = liana_json(*words)["swings"]["install"]
        soft, stiff = swings.values()
        for expected_s, told_s in ((26.7, soft["alone_s"][0]), (5.6, soft["alone_s"][1])):
            self.assertAlmostEqual(told_s, expected_s, delta=0.05 * expected_s)  # as the bench was measured
        for which in ("alone_s", "with_payload_s"):
            self.assertAlmostEqual(soft[which][0] / stiff[which][0], 20**0.5, delta=0.3)
        self.assertIsNone(liana_json("robot", "check", "macro_micro")["swings"]["install"]["with_payload_s"])
        self.assertEqual(liana_json("robot", "check", "micro")["swings"], {})
        code, _, error = liana("robot", "check", "zhu2022", "--scene", "none")
        self.assertEqual((code, "carries no payload" in error), (2, True), error)

    def test_a_named_pose_in_which_a_serial_arm_touches_itself_is_a_problem(self):
        robot = self.folder / "folded.lua"
        robot.write_text(
            "local t = require 'robots.micro'\nt.name = 'folded'\nt.named_poses_deg.folded = { 0, 0, 0, 180, 0, 0, 0 }\n"
            "return t\n"
        )
        code, out, error = liana("robot", "check", robot)
        self.assertEqual(code, 1, out + error)
        self.assert_names(out, "problem", "named_poses_deg.folded", "link 4", "300.0 mm", "link 3")

    def test_a_plan_is_carried_out_with_its_own_robot_and_scene_from_where_it_begins(self):
        plan = self.folder / "plan.json"
        words = (
            "--robot",
            "three_segment_lab",
            "--scene",
            "lab_box",
            "--from-deg=2,1,-3,4,0,-2",
            "--to-deg=-6,3,5,-5,8,4",
        )
        self.assertEqual(liana("plan", *words, "--waypoints", 5, "--out", plan)[0], 0)
        report = self.folder / "report.json"
        code, _, error = liana("run", plan, "--json", report)
        self.assertEqual(code, 0, error)
        self.assertEqual(json.loads(report.read_text())["robot"], "three_segment_lab")

    def test_arms_made_up_by_seed_agree_with_their_kinematics_written_once_more(self):
        for seed in range(100):
            table = table_of(seed)
            file = self.folder / "robot.json"
            file.write_text(json.dumps(table))
            draw = random.Random(f"angles {seed}")
            theta_deg = angles_of(table, draw)
            told = liana_json("pose", "--robot", file, f"--theta-deg={joined(theta_deg)}")["tip_pose"]
            expected = tip_of(table, theta_deg)
            worst = max(abs(told[i][j] - expected[i][j]) for i in range(4) for j in range(4))
            self.assertLess(worst, 1e-9, f"seed {seed}")

    def test_arms_made_up_by_seed_are_served_and_do_a_mission(self):
        mission = self.folder / "tour.lua"
        mission.write_text(TOUR)
        for seed in range(MADE_UP):
            table = table_of(seed)
            file = self.folder / f"robot_{seed}.json"
            file.write_text(json.dumps(table))
            with self.subTest(seed=seed, segments=len(table["segments"]), drives=len(table["drives"]["direction"])):
                self.is_served(file, joined(table["named_poses_deg"]["second"]))
                self.crosses(file, mission, "none")

    def test_an_arm_with_weight_made_up_by_seed_does_a_mission(self):
        seed = 7022  # it stands, and weighs 8 kg: weight beside its direction is no contact
        mission, file = self.folder / "tour.lua", self.folder / "robot.json"
        mission.write_text(TOUR)

        def fits(table):
            file.write_text(json.dumps(table))
            return not liana_json("robot", "check", file, expected=(0, 1))["problems"]

        file.write_text(json.dumps(loaded(table_of(seed), seed, fits)))
        self.crosses(file, mission, "none")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
