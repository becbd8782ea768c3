"""Short lines of the tip in all six directions from where the arm of `liana robot new` begins: for arms drawn by seed, of
3 and 6 segments, 3 or 4 cables each or mixed (`--all`: each of 3 to 8, four minutes). An arm of two segments has four
angles: its tip keeps no attitude, and goes along no line.
"""
import json
import pathlib
import random
import sys
import tempfile
import unittest

from programs import liana, liana_json

LINES = """
local liana = require "liana"
local geometry = require "liana.geometry"
local kNear_m = 0.001

local function beside(arm, axis, way_m)
  local tip = geometry.tip(arm.robot, arm.named_pose "wave")
  local p, q = tip.position, geometry.quaternion(tip.rotation)
  local goal = { p[1], p[2], p[3], q[1], q[2], q[3], q[4] }
  goal[axis] = goal[axis] + way_m
  return goal
end

local function line(name, axis, way_m)
  local there = liana.condition("tip told " .. name, function(arm)
    local goal, told = beside(arm, axis, way_m), arm.state.setpoint_cp
    return geometry.distance({ told[1], told[2], told[3] }, { goal[1], goal[2], goal[3] }) <= kNear_m
  end)
  return liana.step(name) {
    device = "none",
    enter = liana.at_rest(),
    run = function(arm) arm.move_cp { goal = beside(arm, axis, way_m) } end,
    exit = liana.all { there, liana.at_rest() },
    time_limit_s = 90,
    on_fail = "hold",
  }
end

local steps = {}
for _, each in ipairs { { "x", 1 }, { "y", 2 }, { "z", 3 } } do
  for _, way_m in ipairs { WAY, -WAY } do
    steps[#steps + 1] = line(("%s by %g"):format(each[1], way_m), each[2], way_m)
    steps[#steps + 1] = line(("back from %g along "):format(way_m) .. each[1], each[2], 0)
  end
end
return liana.mission "lines" (steps)
"""
SEGMENTS = {401: 3, 402: 4, 403: 5, 404: 6, 405: 7, 406: 8}  # of the arm of each seed
SEEDS = SEGMENTS if "--all" in sys.argv else (401, 404)
LONGEST_LINE_M = 0.05
SHARE_OF_ARM = 0.035  # a line of 50 mm is short for an arm of 1.4 m


class NewArm(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="liana-test-")))

    def new(self, draw, segments):
        """A table as `liana robot new` writes it; the length of the arm. Segments bend by 64 degrees or more in all."""
        modules, length_m = draw.randint(3, 10), round(draw.uniform(0.04, 0.12), 3)
        limit_deg = round(min(45.0, draw.uniform(64.0, 120.0) / modules), 1)
        words = ("--segments", segments, "--modules", modules, "--module-length", length_m, "--theta-limit", limit_deg)
        file = self.folder / "arm.lua"
        code, out, error = liana("robot", "new", "arm", "--out", file, "--cables", draw.choice((3, 4)), *words)
        self.assertEqual(code, 0, out + error)
        return file, segments * modules * length_m

    def mixed(self, file, draw):
        """The same arm with 3 or 4 cables in each of its segments."""
        table = json.loads(liana("robot", "export", file)[1])
        counts = [draw.choice((3, 4)) for _ in table["segments"]]
        turn_deg = 360.0 / (12 * len(counts))
        table["cables"]["phase_deg"] = [
            [360.0 / count * cable + turn_deg * segment for cable in range(count)]
            for segment, count in enumerate(counts)
        ]
        table["drives"]["direction"] = [draw.choice((-1, 1)) for _ in range(sum(counts))]
        table["drives"]["zero_counts"] = [500000] * sum(counts)
        mixed = self.folder / "mixed.json"
        mixed.write_text(json.dumps(table))
        return mixed

    def test_its_tip_goes_along_short_lines_in_all_directions(self):
        for seed in SEEDS:
            draw, segments = random.Random(seed), SEGMENTS[seed]
            file, arm_m = self.new(draw, segments)
            robot = self.mixed(file, draw) if seed % 2 else file
            way_m = min(LONGEST_LINE_M, SHARE_OF_ARM * arm_m)
            mission, report = self.folder / "lines.lua", self.folder / "report.json"
            mission.write_text(LINES.replace("WAY", repr(way_m)))
            with self.subTest(seed=seed, segments=segments, robot=file.read_text().splitlines()[3:5]):
                _, _, error = liana(
                    "run", mission, "--robot", robot, "--scene", "none", "--json", report, timeout_s=900
                )
                said = json.loads(report.read_text())
                done = [step["name"] for step in said["steps"] if step["outcome"] == "success"]
                self.assertEqual((said["outcome"], len(done)), ("success", 12), f"{said.get('reason')}\n{error}")
            file.unlink()

    def test_arms_of_as_many_modules_as_are_served_are_verified(self):
        for segments, modules in ((8, 16), (4, 16), (8, 8)):
            file = self.folder / f"long_{segments}_{modules}.lua"
            words = ("--segments", segments, "--modules", modules, "--module-length", 0.02, "--theta-limit", 6)
            code, out, error = liana("robot", "new", file.stem, "--out", file, "--cables", 3, *words)
            self.assertEqual(code, 0, out + error)
            way = ("--from-deg", ",".join(["0,0"] * segments), "--to-deg", ",".join(["0.4,0.2"] * segments))
            with self.subTest(segments=segments, modules=modules):
                said = liana_json("verify", "--robot", file, "--scene", "lab_box", *way, "--duration=60")
                self.assertTrue(said["accepted"], said)


if __name__ == "__main__":
    unittest.main(argv=["test_new_arm_moves.py"])
