"""`liana check`: a mission as a dry run, which says what its steps leave of the limits and what is refused, and which
nobody notices who looks after the arm.
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from support import MISSIONS, SystemTest, start_run
from liana.system import program, run, table

FIELDS = {
    *("outcome", "reason", "mission", "robot", "physics", "seed", "steps", "commands", "refused", "refusals"),
    *("faults", "margins", "min_clearance_m", "verify_us", "arm_time_s", "wall_time_s"),
}
STEP_FIELDS = {
    "name",
    "device",
    "held_theta",
    "duration_s",
    "slowed_s",
    "outcome",
    "reason",
    "ended_by",
    "commands",
    "refused",
    "margins",
}
REFUSAL_FIELDS = {"code", "name", "action", "remedy", "count", "step", "time_s", "text"}
MARGINS = {"clearance_m", "joint_deg", "rate_deg_s", "tension_N", "time_us"}
BALL_M = [0.94, -1.72, 0.03]  # where the tip of the short mission would come with theta 9 at 6 deg


class Checks(SystemTest):
    def setUp(self):
        self.home = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="liana-home-")))
        (self.home / "tmp").mkdir()

    def check(self, *words, code=0):
        """What `liana check` answers, in a home of its own, of which it may keep nothing."""
        folders = {"XDG_RUNTIME_DIR": self.home, "XDG_STATE_HOME": self.home, "TMPDIR": self.home / "tmp"}
        done = run("liana", "check", *words, "--json", "-", env={**os.environ, **folders}, cwd=self.home)
        self.assertEqual(done.returncode, code, done.stderr)
        left = [path.name for path in self.home.rglob("*")]
        self.assertEqual(left, ["tmp"], "a dry run leaves nothing behind")
        return json.loads(done.stdout)

    def short(self, **changes):
        text = (MISSIONS / "short.lua").read_text()
        for old, new in changes.values():
            self.assertIn(old, text)
            text = new.join(text.rsplit(old, 1))
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "short.lua").write_text(text)
        return folder / "short.lua"


class DryRuns(Checks):
    def test_a_mission_that_succeeds_is_told_step_by_step_with_least_margins(self):
        told = self.check(MISSIONS / "short.lua", "--seed", 3)
        self.assertEqual(set(told), FIELDS)
        self.assertEqual((told["outcome"], told["reason"], told["seed"]), ("success", None, 3))
        self.assertEqual((told["refused"], told["refusals"], told["faults"]), (0, [], []))
        self.assertEqual([step["name"] for step in told["steps"]], ["prepare", "a small move"])
        for step in told["steps"]:
            self.assertEqual(set(step), STEP_FIELDS)
            self.assertEqual(set(step["margins"]), MARGINS)
            for name, margin in step["margins"].items():
                self.assertGreater(margin, 0, name)
                self.assertGreaterEqual(margin, told["margins"][name])
            seconds_of_commands = 0.02 * step["commands"]
            self.assertAlmostEqual(seconds_of_commands, step["duration_s"], delta=0.1)
        self.assertGreaterEqual(told["commands"], sum(step["commands"] for step in told["steps"]))
        self.assertGreater(told["min_clearance_m"], 0.45)  # of the drive box behind the root
        self.assertEqual(set(told["verify_us"]), {"median", "worst"})
        self.assertLess(0, told["verify_us"]["median"])
        self.assertLessEqual(told["verify_us"]["median"], told["verify_us"]["worst"])
        self.assertAlmostEqual(told["arm_time_s"], sum(step["duration_s"] for step in told["steps"]), delta=0.1)
        self.assertGreater(told["wall_time_s"], 0)

    def test_a_plan_is_checked_like_a_mission(self):
        prepare = json.loads(table("robot", "zhu2022"))["named_poses_deg"]["prepare"]
        goal = [angle - (k == 8) for k, angle in enumerate(prepare)]
        plan = self.short().parent / "plan.json"
        ends = [f"--{word}-deg=" + ",".join(map(str, angles)) for word, angles in (("from", prepare), ("to", goal))]
        planned = run("liana", "plan", *ends, "--waypoints=3", "--out", plan)
        self.assertEqual(planned.returncode, 0, planned.stderr)
        told = self.check(plan)
        self.assertEqual((told["outcome"], told["refused"], told["mission"]), ("success", 0, str(plan)))

    def test_of_a_serial_arm_nobody_looks_at_tension_or_the_time_of_a_tick(self):
        told = self.check(MISSIONS / "short_micro.lua", "--robot", "micro")
        self.assertEqual((told["outcome"], told["robot"], set(told)), ("success", "micro", FIELDS))
        known = {name for name in MARGINS if told["margins"][name] is not None}
        self.assertEqual(known, {"joint_deg", "rate_deg_s"}, "the scene has no bodies")

    def test_it_says_the_same_every_time(self):
        first, second = (self.check(MISSIONS / "short.lua", "--seed", 4) for _ in range(2))
        for told in (first, second):
            del told["verify_us"], told["wall_time_s"]
        self.assertEqual(first, second)

    def test_a_way_into_something_is_refused_with_the_step_and_a_remedy(self):
        scene = json.loads(table("scene", "panel_slit"))
        scene["spheres"].append({"name": "ball", "center_m": BALL_M, "radius_m": 0.1})
        mission = self.short(
            goal=("kGoal_deg = 11.0", "kGoal_deg = 6.0"),
            limit=("time_limit_s = 60", "time_limit_s = 20"),
            # known only once the arm says where it is: else the pose in the ball is refused before anything starts
            late=("local goal_deg = {}", "local goal_deg = { table.unpack(arm.state.setpoint_js_deg) }"),
        )
        (mission.parent / "ball.json").write_text(json.dumps(scene))
        told = self.check(mission, "--scene", mission.parent / "ball.json", code=1)
        self.assertEqual(told["outcome"], "refused", told)
        refusal = told["refusals"][0]
        self.assertEqual(set(refusal), REFUSAL_FIELDS)
        self.assertIsNone(refusal["code"], "the whole way was looked at: no command was made of it")
        self.assertEqual(refusal["step"], "a small move")
        self.assertIn("ball", refusal["text"])
        self.assertIn("retract", refusal["text"])
        self.assertEqual(told["refused"], sum(each["count"] for each in told["refusals"]))
        self.assertEqual([step["refused"] for step in told["steps"]], [0, told["refused"]])
        self.assertGreater(told["min_clearance_m"], 0, "the arm does not move towards it")

    def test_a_fault_of_a_drive_ends_it_and_is_told(self):
        faults = self.short().parent / "faults.json"
        faults.write_text(json.dumps([{"drive": 4, "kind": "fault", "at_slot": 2000}]))
        told = self.check(MISSIONS / "short.lua", "--faults", faults, code=1)
        self.assertEqual(told["outcome"], "failed")
        self.assertIn(3003, [fault["number"] for fault in told["faults"]])


class WithoutPeople(Checks):
    """A dry run waits for nobody: in virtual time an hour of that is cheap, and no mission's own."""

    def mission(self, step):
        file = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "asks.lua"
        file.write_text(
            'local liana = require "liana"\n'
            'return liana.mission "asks" { liana.step "one" { device = "none", run = liana.move_to "prepare", '
            f"exit = {step} }} }}\n"
        )
        return file

    def test_a_step_that_people_confirm_is_carried_out_at_once(self):
        told = self.check(self.mission('liana.at_rest(), confirm = "go?", time_limit_s = 60, on_fail = "hold"'))
        self.assertEqual(told["outcome"], "success")
        self.assertLess(told["arm_time_s"], 120)

    def test_a_failure_that_people_would_be_asked_about_ends_it(self):
        never = 'liana.condition("never", function() return false end), time_limit_s = 2, on_fail = "pause"'
        told = self.check(self.mission(never), code=1)
        self.assertEqual(told["outcome"], "failed")
        self.assertLess(told["arm_time_s"], 120)


class BesideAnArm(Checks):
    def test_nobody_who_asks_for_running_systems_finds_it(self):
        arm = start_run(self, MISSIONS / "short.lua", "--time", "paced")
        folders = {"XDG_RUNTIME_DIR": arm.home, "XDG_STATE_HOME": arm.home, "TMPDIR": arm.home}
        env = {**os.environ, **folders}
        words = [program("liana"), "check", str(MISSIONS / "short.lua"), "--json", "-"]
        check = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=env)
        self.addCleanup(check.communicate)
        self.addCleanup(check.kill)
        seen = 0
        while check.poll() is None:
            done = run("liana", "status", "--json", env=env)
            found = done.stdout.splitlines() if done.returncode == 0 else []
            self.assertLessEqual(len(found), 1, found)
            seen += len(found)
        self.assertGreater(seen, 0, "the arm's own system is there all the time")
        self.assertEqual(check.returncode, 0)
        out, error = arm.communicate(timeout=300)
        self.assertEqual((arm.returncode, "outcome success" in out), (0, True), error)


if __name__ == "__main__":
    unittest.main(verbosity=2)
