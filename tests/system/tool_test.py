"""The command at the end of a mission is over when the tool says so: done, failed, silent, or nowhere near the rod
(req:A7 req:A53).
"""
import json
import pathlib
import shutil
import tempfile
import unittest

from support import SystemTest, start_run

PATIENCE_S = 300
MISSION = """
local liana = require "liana"
return liana.mission "tool" {
  liana.step "prepare" { device = "none", run = liana.move_to "prepare", exit = liana.all { liana.at_pose "prepare", liana.at_rest() },
    time_limit_s = 60, on_fail = "hold" },
  finish = liana.tool "repair",
}
"""
SCENE = """
local geometry = require "liana.geometry"
local robot = require "robots.zhu2022"
local rod = geometry.tip(robot, robot.named_poses_deg.prepare)
return {{
  format = 1, kind = "scene", name = "rod", boxes = {{}}, spheres = {{}},
  rod = {{
    position_m = geometry.add(rod.position, {{ {beside_m}, 0, 0 }}), quaternion_wxyz = geometry.quaternion(rod.rotation),
    radius_m = 0.010, stiffness_N_per_m = 1,
  }},
  camera = {{ rate_hz = 25, latency_s = 0.1, noise_m = 0.0003, noise_deg = 0.05, range_m = 3.0 }},
  contact = {{ stiffness_N_per_m = 20000, damping_Ns_per_m = 50, friction = 0.2 }},
}}
"""


class ToolAtTheTip(SystemTest):
    def run_it(self, fault=None, beside_m=0.0):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-tool-"))
        self.addCleanup(shutil.rmtree, folder)
        (folder / "tool.lua").write_text(MISSION)
        (folder / "rod.lua").write_text(SCENE.format(beside_m=beside_m))
        words = [str(folder / "tool.lua"), "--scene", str(folder / "rod.lua"), "--record", str(folder / "run")]
        if fault:
            (folder / "faults.json").write_text(json.dumps([{"kind": fault, "at_slot": 0}]))
            words += ["--faults", str(folder / "faults.json")]
        process = start_run(self, *words, "--json", str(folder / "report.json"))
        process.communicate(timeout=PATIENCE_S)
        report = json.loads((folder / "report.json").read_text())
        tool = json.loads((folder / "run/bench_summary.json").read_text())["tool"]
        return report, tool, (folder / "run/events.txt").read_text()

    def test_a_repair_that_is_done_ends_the_mission_and_the_rod_is_out(self):
        report, tool, events = self.run_it()
        self.assertEqual((report["outcome"], tool["has_rod"]), ("success", True), report)
        self.assertIn("tool: repair done", events)

    def test_a_jammed_tool_fails_the_mission_with_its_own_words(self):
        report, tool, _ = self.run_it("tool_jams")
        self.assertEqual((report["outcome"], tool["has_rod"]), ("failed", False), report)
        self.assert_names(report["reason"], "tool", "repair", "jammed")

    def test_a_silent_tool_fails_the_mission_in_the_stated_time(self):
        report, _, _ = self.run_it("tool_silent")
        self.assertEqual(report["outcome"], "failed")
        self.assert_names(report["reason"], "30 s")

    def test_a_rod_out_of_reach_is_named_with_its_distance(self):
        report, _, _ = self.run_it(beside_m=0.1)
        self.assertEqual(report["outcome"], "failed")
        self.assertRegex(report["reason"], "rod is [0-9]+ mm")
        self.assert_names(report["reason"], "rod", "tip", "15 mm")


if __name__ == "__main__":
    unittest.main()
