"""Missions that branch, loop, follow plans and are made of several files, on the simulated arm of three_segment_lab."""
import json
import pathlib
import shutil
import sys
import tempfile
import unittest

from programs import ROOT, liana, liana_json
from message import Messages

LUA = ROOT / "lua"

SCENE_WITH_BODY = """
local t = require "scenes.lab_box"
t.boxes[#t.boxes + 1] = { name = "crate", center_m = { %s }, half_extent_m = { 0.05, 0.05, 0.05 },
  rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }
return t
"""


class MissionSteps(Messages, unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="liana-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_mission(self, mission, *options):
        report = self.folder / "report.json"
        code, out, error = liana("run", mission, "--robot", "three_segment_lab", *options, "--json", report)
        return code, json.loads(report.read_text()) if report.exists() else {}, error

    def copy_of_example(self):
        shutil.copytree(LUA / "missions" / "lab_search", self.folder / "lab_search")
        shutil.copy(LUA / "missions" / "lab_search.lua", self.folder / "lab_search.lua")
        return self.folder / "lab_search.lua"

    def test_the_example_follows_its_plan_looks_three_times_and_goes_home(self):
        record = self.folder / "record"
        code, report, error = self.run_mission("lab_search", "--scene", "lab_box", "--record", record)
        self.assertEqual((code, report.get("outcome")), (0, "success"), error)
        names = [step["name"] for step in report["steps"]]
        self.assertEqual(names[1:5], ["along the plan"] + 3 * ["look around"])
        self.assertIn(names[5:], (["home"], ["home gently"]))
        self.assert_names(report["steps"][1]["ended_by"], "waypoint", "path", "arm at rest")
        files = [file["file"] for file in report["mission_files"]]
        self.assertEqual(files, ["lab_search.lua", "lab_search/parts.lua", "lab_search/way.json"])
        for file in files:
            kept, own = record / "mission_files" / file, LUA / "missions" / file
            self.assertEqual(kept.read_bytes(), own.read_bytes())

    def test_a_mission_runs_with_its_own_tables_and_with_those_that_are_named_instead(self):
        report = self.folder / "check.json"
        code, _, error = liana("check", "lab_tour", "--json", report)
        self.assertEqual(code, 0, error)
        self.assertEqual(json.loads(report.read_text())["robot"], "three_segment_lab")
        code, _, error = liana("check", "lab_tour", "--robot", "tdcr_benchmark")
        self.assertEqual(code, 2, error)
        self.assertIn("robot tdcr_benchmark", error)
        code, _, error = liana("check", "lab_search", "--scene", "none")
        self.assertEqual(code, 2, error)
        self.assert_names(error, "scene", "lab_box")

    def test_a_look_that_is_given_up_goes_home_gently(self):
        mission = self.copy_of_example()
        mission.write_text(mission.read_text().replace("kMaxTension_N = 100", "kMaxTension_N = 5"))
        code, report, error = self.run_mission(mission, "--scene", "lab_box")
        self.assertEqual((code, report.get("outcome")), (0, "success"), error)
        self.assertEqual([step["name"] for step in report["steps"]][2:], ["look around", "home gently"])
        self.assertEqual(report["steps"][2]["outcome"], "failed")
        self.assertEqual(report["steps"][2]["ended_by"], "a cable over 5 N")

    def test_a_pose_inside_a_body_is_refused_by_step_body_and_link(self):
        tip = liana_json("pose", "--robot", "three_segment_lab", "--theta-deg=-6,3,5,-5,8,4")["tip_pose"]
        pose = [row[3] for row in tip[:3]]
        scene = self.folder / "crate.lua"
        scene.write_text(SCENE_WITH_BODY % ", ".join(str(x) for x in pose))
        code, _, error = self.run_mission("lab_tour", "--scene", scene)
        self.assertEqual(code, 2, error)
        self.assertIn("missions/lab_tour.lua:", error)
        self.assert_names(error, "step 2", "pose look", "link 18", "body crate")
        self.assertIn("inside body crate", error)

    # req:A28
    def test_a_fixture_that_the_scene_has_not_is_refused_by_step_before_anything_starts(self):
        text = (LUA / "missions" / "slit_crossing.lua").read_text()
        self.assertIn('device = "hand",', text)
        mission = self.folder / "slit_crossing.lua"
        bare = self.folder / "bare.lua"
        bare.write_text('local t = require "scenes.panel_slit"\nt.name = "bare"\nt.fixtures = {}\nreturn t\n')
        for scene, names, said in (
            (
                "panel_slit",
                '"slit_plan"',
                ("slit_plan", "panel_slit", "slit_plane", "slit_walls", "slit_approach"),
            ),
            ("panel_slit", '"slit_plane", "Slit_Walls"', ("Slit_Walls", "panel_slit", "slit_plane")),
            (bare, '"slit_plane"', ("slit_plane", "scene bare")),
        ):
            mission.write_text(text.replace('device = "hand",', 'device = "hand", fixtures = { %s },' % names, 1))
            code, out, error = liana("run", mission, "--scene", scene)
            self.assertEqual((code, out), (2, ""), error)
            self.assertRegex(error, r"slit_crossing.lua:\d+: .*\bstep \d")
            self.assert_names(error, "mission slit_crossing", "fixtures", *said)

    def test_a_plan_of_another_scene_and_one_that_begins_elsewhere_are_refused_by_their_step(self):
        code, _, error = self.run_mission("lab_search", "--scene", "none")
        self.assertEqual(code, 2, error)
        self.assert_names(error, "step 2", "along the plan", "plan")
        self.assert_names(error, "scene", "lab_box")
        mission = self.copy_of_example()
        text = mission.read_text()
        begin, end = text.index('  liana.step "to where'), text.index('  liana.step "along')
        mission.write_text(text[:begin] + text[end:])
        code, _, error = self.run_mission(mission, "--scene", "lab_box", "--start-pose", "look")
        self.assertEqual(code, 2, error)
        self.assert_names(error, "step 1", "along the plan", "theta 1", "5 deg")
        self.assertIn("--start-pose=5.0,-4.0,3.0,6.0,-4.0,2.0", error)

    def test_a_plan_that_was_edited_or_begins_elsewhere_is_refused_before_anything_starts(self):
        plan = self.folder / "plan.json"
        motion = ("--from-deg=5,-4,3,6,-4,2", "--to-deg=6,-4,3,6,-4,2", "--waypoints", 3)
        planned = liana("plan", "--robot", "three_segment_lab", "--scene", "none", *motion, "--out", plan)
        self.assertEqual(planned[0], 0, planned)
        code, _, error = liana("run", plan, "--start-pose", "zero")
        self.assertEqual(code, 2, error)
        self.assert_names(error, "plan", "theta 1", "5 deg", "pose zero", "0.0")
        code, _, error = liana("run", plan, "--robot", "zhu2022")
        self.assertEqual(code, 2, error)
        self.assertIn("made for robot three_segment_lab, not for zhu2022", error)
        written = json.loads(plan.read_text())
        content = json.loads(plan.read_text())
        content["waypoints_deg"][1][0] += 0.01
        plan.write_text(json.dumps(content))
        code, _, error = liana("run", plan)
        self.assertEqual(code, 2, error)
        self.assert_names(error, "digest", "liana plan")
        for key, value, said in (("hash", "0" * 64, "digest: "), ("comment", "mine", "comment: ")):
            content = {**written, key: value}
            plan.write_text(json.dumps(content))
            code, _, error = liana("run", plan)
            self.assertEqual(code, 2, error)
            self.assertIn(said, error)

    def test_robot_check_names_what_no_winch_and_no_rope_can_do(self):
        table = (LUA / "robots" / "three_segment_lab.lua").read_text()
        for old, new, problem in (
            ("mass_kg = 0.2", "mass_kg = 60", ("module.mass_kg", "60", "cable")),
            ("EA_N = 150000", "EA_N = 5e6", ("cables.EA_N", "5e+06", "0.78 m", "64.1 N")),
            ("zero = { 0, 0, 0,", "zero = { 0, 2, 0,", ("named_poses_deg.zero", "angle 2", "2 deg", "0")),
        ):
            robot = self.folder / "robot.lua"
            robot.write_text(table.replace(old, new))
            code, out, error = liana("robot", "check", robot)
            self.assertEqual(code, 1, out + error)
            self.assert_names(out + error, *problem)

    def test_what_the_bench_would_refuse_is_refused_by_check_too(self):
        table = (LUA / "robots" / "three_segment_lab.lua").read_text()
        for old, new, problem in (
            ("drum_radius_m = 0.012", "drum_radius_m = 1e-9", ("drives.drum_radius_m", "1e-09", "0.001", "0.5")),
            ("gear = 1", "gear = 1e-9", ("drives.gear", "1e-09", "0.01", "1000")),
            ("mass_kg = 0.2", "mass_kg = 1e-300", ("module.mass_kg", "1e-300", "1e-06", "100")),
            (
                "theta_accel_deg_s2 = 6",
                "theta_accel_deg_s2 = 1e-12",
                ("limits.theta_accel_deg_s2", "1e-12", "0.001", "1000"),
            ),
        ):
            robot = self.folder / "robot.lua"
            robot.write_text(table.replace(old, new))
            code, out, error = liana("robot", "check", robot)
            self.assertEqual((code, out), (2, ""), error)
            self.assert_names(error, *problem)

    def test_verification_says_that_the_arm_is_inside_a_body(self):
        tip = liana_json("pose", "--robot", "three_segment_lab", "--theta-deg=-6,3,5,-5,8,4")["tip_pose"]
        pose = [row[3] for row in tip[:3]]
        scene = self.folder / "crate.lua"
        scene.write_text(SCENE_WITH_BODY % ", ".join(str(x) for x in pose))
        motion = ("--from-deg=-6,3,5,-5,8,4", "--to-deg=-6,3,5,-5,8,4", "--duration=1")
        verdict = liana_json("verify", "--robot", "three_segment_lab", "--scene", scene, *motion)
        self.assertTrue(verdict["inside"])
        self.assertIn("slowly", verdict)
        free = liana_json("verify", "--robot", "three_segment_lab", "--scene", "none", *motion)
        self.assertEqual((free["inside"], free["margins"]["clearance_m"]), (False, None))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
