"""`liana plan` as users call it: answers, exit codes, cancelling, the kept file. Usage: test_plan_command.py BIN."""
import json
import math
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[3] / folder) for folder in ("numbers", "host/apps/cli")]
import planning_plans  # noqa: E402 (found through the line above)
from programs import interrupt  # noqa: E402
from message import Messages  # noqa: E402

BIN = pathlib.Path(sys.argv.pop(1))

PREPARE = "-8.5,0,-12,0,8,-2,13,0,12,-2"
PANEL_EDGE = "-6.14,-15,-3.29,-8.72,7.2,15,5.55,15,1,-2.8"
TILTED = (  # the press rod pose, with the last segment bent out of the slit
    "-2.641,-2.064,-1.81,-4.64,4.777,5.87,0,4.764,8,-0.543"
)


def words(*options):
    return [str(BIN / "liana"), "plan", *options, "--json"]


def call(*options):
    return subprocess.run(words(*options), capture_output=True, text=True, check=False)


class PlanCommand(Messages, unittest.TestCase):
    def test_a_plan_ends_with_0_and_has_everything_that_callers_read(self):
        done = call(f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}", "--waypoints=15")
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        self.assertEqual(answer["outcome"], "solved")
        self.assertEqual(len(answer["waypoints_deg"]), 15)
        for waypoint, wanted in ((answer["waypoints_deg"][0], PREPARE), (answer["waypoints_deg"][-1], PANEL_EDGE)):
            for angle, number in zip(waypoint, wanted.split(",")):
                self.assertAlmostEqual(angle, float(number), 9)
        for key in ("objective", "iterations", "time_s", "hash", "settled"):
            self.assertIn(key, answer)
        self.assertGreaterEqual(answer["checked"]["min_clearance_m"], 0.005)
        self.assertLessEqual(answer["checked"]["max_joint_deg"], 20.0)
        self.assertLess(answer["checked"]["max_step_deg"], 80 / 14)
        self.assertLess(answer["checked"]["tip_error_m"], 1e-6)

    def test_a_way_nearer_than_the_prediction_is_sure_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "near.lua"
            scene.write_text("local s = require 'scenes.panel_slit'\ns.margins = { prediction_m = 1 }\nreturn s\n")
            ends = (f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}")
            self.assertIn("margins.prediction_m of scene panel_slit", call(*ends, f"--scene={scene}").stderr)
            self.assertNotIn("prediction", call(*ends).stderr)

    def test_progress_goes_to_standard_error(self):
        done = call(f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}")
        self.assertIn("plan: round 1", done.stderr)

    def test_the_same_request_has_the_same_hash_and_another_margin_another(self):
        ends = (f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}")
        hashes = [json.loads(call(*ends, *more).stdout)["hash"] for more in ((), (), ("--margin=0.004",))]
        self.assertEqual(hashes[0], hashes[1])
        self.assertNotEqual(hashes[0], hashes[2])

    def test_an_end_inside_a_body_ends_with_3_and_says_which_and_how_deep(self):
        done = call(f"--from-deg={PREPARE}", f"--to-deg={TILTED}")
        self.assertEqual(done.returncode, 3)
        answer = json.loads(done.stdout)
        self.assertEqual((answer["outcome"], answer["constraint"]), ("infeasible", "goal"))
        self.assertRegex(answer["reason"], r"link \d+ is [\d.]+ mm inside '(panel|wall)'")
        self.assertEqual(answer["waypoints_deg"], [])

    def test_without_a_scene_the_same_way_is_free(self):
        self.assertEqual(call(f"--from-deg={PREPARE}", f"--to-deg={TILTED}", "--scene=none").returncode, 0)

    def test_bad_input_ends_with_2_and_one_message(self):
        ends = [f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}"]
        for bad in (
            ends[:1],
            [*ends, "--tip=1,0,0,1,0,0,0"],
            [*ends, "--waypoints=1"],
            [*ends, "--waypoints=101"],
            [*ends, "--margin=-1"],
            [*ends, "--max-step-deg=0"],
            [*ends, "--max-step-deg=1e-300"],
            [*ends, "--margin=1e308"],
            [*ends, "--waypoints=1e3"],
            [*ends, "--iterations=0"],
            [*ends, "--hold=9"],
            [*ends, "--planar=6@0.5"],
            [*ends, "--planar=,"],
            [*ends, "--hold=9=1", "--planar=5@0.5"],
            [*ends, "--scene=nowhere"],
            [*ends, "--out=-"],
            [*ends, "--control-point=9:0,0,0"],
        ):
            done = call(*bad)
            self.assertEqual(done.returncode, 2, bad)
            self.assertEqual((json.loads(done.stdout)["error"]["exit_code"], done.stderr.count("\n")), (2, 1), bad)

    def test_following_a_file_s_curve_tells_how_well_the_body_followed(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "curve.json"
            path.write_text(
                json.dumps(
                    {
                        "points_m": [
                            planning_plans.tip_of(planning_plans.PANEL_EDGE)[:3],
                            [0.6, -0.15, 0.4],
                            [1.0, -0.05, 0.35],
                        ]
                    }
                ),
                encoding="utf-8",
            )
            done = call(f"--from-deg={PANEL_EDGE}", f"--follow={path}")
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        self.assertLess(answer["follow"]["tip_off_m"], 0.002001)
        self.assertLess(answer["follow"]["mean_body_off_m"], answer["follow"]["body_off_m"])
        self.assertGreaterEqual(answer["checked"]["min_clearance_m"], 0.005)

    def test_an_arm_that_is_fed_keeps_its_body_on_the_curve(self):
        bend = [[0.475 + 0.25 * math.sin(a), 0.25 - 0.25 * math.cos(a), 0] for a in (0.1 * i for i in range(11))]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "curve.json"
            path.write_text(json.dumps({"points_m": [[0.375, 0, 0], *bend]}), encoding="utf-8")
            options = ("--robot=feeder", "--scene=none", "--from-deg=back", f"--follow={path}")
            done = call(*options)
            script = pathlib.Path(folder) / "curve.lua"
            points = ", ".join(f"{{ {x!r}, {y!r}, {z!r} }}" for x, y, z in ([0.375, 0, 0], *bend))
            script.write_text(f"return {{ points_m = {{ {points} }} }}", encoding="utf-8")
            by_script = json.loads(call(*options[:-1], f"--follow={script}").stdout)
            said = subprocess.run(words(*options)[:-1], capture_output=True, text=True, check=False).stdout
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        self.assertEqual(answer["waypoints_deg"][0][:2], [-85, 0])
        self.assertEqual(answer["hash"], by_script["hash"])
        self.assertLess(answer["follow"]["curve_off_m"], 0.015)
        self.assertIn(answer["follow"]["curve_off_segment"], (2, 3, 4, 5))
        self.assertIn(f"segment {answer['follow']['curve_off_segment']}", said)

    def test_a_curve_that_is_none_ends_with_2_and_one_message(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "curve.json"
            for text in (
                "",
                "[]",
                "{}",
                '{"points_m": 3}',
                '{"points_m": [[0, 0, 0]]}',
                '{"points_m": [[0, 0, 0], [1, 0]]}',
                '{"points_m": [[0, 0, 0], [1, 0, "a"]]}',
                '{"points_m": [[0, 0, 0], [1, 0, 1e9]]}',
                '{"points_m": [[0, 0, 0], [0, 0, 0]]}',
                '{"points_m": [[0, 0, 0], [1, 0, 0]], "poins": 1}',
                '{"points_m": [[0, 0, 0], [1, 0, 0]], "points_m": [[0, 0, 0], [2, 0, 0]]}',
            ):
                path.write_text(text, encoding="utf-8")
                done = call(f"--from-deg={PANEL_EDGE}", f"--follow={path}")
                self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), text)
                self.assertIn(str(path), done.stderr)
        for bad in (
            ["--follow=/nowhere"],
            ["--follow=/dev/zero"],
            ["--follow=slit"],
            ["--follow=slit", f"--to-deg={PREPARE}", "--scene=none"],
            ["--follow=slit", f"--to-deg={PREPARE}", "--waypoints=20"],
            ["--follow=slit", f"--to-deg={PREPARE}", "--hold=9=1"],
            ["--follow=slit", f"--to-deg={PREPARE}", "--iterations=5"],
        ):
            done = call(f"--from-deg={PANEL_EDGE}", *bad)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), bad)

    def test_interrupting_ends_with_130_and_the_outcome_cancelled(self):
        running = subprocess.Popen(
            words(
                f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}", "--waypoints=100", "--control-point=3:1.5,-0.5,0.8:1"
            ),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        for line in running.stderr:
            if "iteration" in line:
                break
        running.send_signal(signal.SIGINT)
        out, _ = running.communicate()
        self.assertEqual(running.returncode, 130)
        self.assertEqual(json.loads(out)["outcome"], "cancelled")

    def test_an_interrupt_right_after_the_start_is_no_death_by_signal(self):
        running = subprocess.Popen(
            words(f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}", "--waypoints=100"),
            stdout=subprocess.PIPE,
            text=True,
        )
        interrupt(running)
        out, _ = running.communicate()
        self.assertEqual(running.returncode, 130)
        self.assertIn(
            out and json.loads(out)["outcome"], ("", "cancelled")
        )  # before the command began there is nothing to tell

    def test_a_way_of_no_length_is_settled_at_once(self):
        done = call(f"--from-deg={PREPARE}", f"--to-deg={PREPARE}", "--scene=none")
        answer = json.loads(done.stdout)
        self.assertEqual(
            (answer["outcome"], answer["objective"], answer["settled"], answer["rounds"]), ("solved", 0.0, True, 1)
        )
        self.assertIn("nothing in the scene", done.stderr)

    def test_the_kept_file_has_the_plan_and_its_inputs(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "plan.json"
            answer = json.loads(call(f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}", f"--out={path}").stdout)
            kept = json.loads(path.read_text(encoding="utf-8"))
        self.assertEqual(kept["hash"], answer["hash"])
        self.assertEqual(kept["inputs"]["from_deg"], PREPARE)
        self.assertEqual(kept["inputs"]["scene"]["name"], "panel_slit")
        self.assertEqual(kept["inputs"]["robot"]["name"], "zhu2022")

    def test_an_edited_plan_is_not_carried_out(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "plan.json"
            self.assertEqual(
                call(f"--from-deg={PREPARE}", f"--to-deg={PANEL_EDGE}", "--waypoints=3", f"--out={path}").returncode, 0
            )
            written = json.loads(path.read_text(encoding="utf-8"))

            def edit(change, without_digest=True):
                """What a plan is refused with; without its digest, as one from elsewhere, it is held to what it says."""
                plan = json.loads(json.dumps(written))
                change(plan)
                if without_digest:
                    plan.pop("digest")
                path.write_text(json.dumps(plan), encoding="utf-8")
                done = subprocess.run(
                    [BIN / "liana", "run", path], capture_output=True, text=True, check=False, timeout=60
                )
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                return done.stderr

            into_the_panel = [-2.641, -2.064, -1.81, -4.64, 4.777, 5.87, 4.0, 4.764, 5.0, -0.543]
            self.assertIn("digest: ", edit(lambda plan: plan["waypoints_deg"][1].__setitem__(0, -8.4), False))
            self.assert_names(
                edit(lambda plan: plan["waypoints_deg"].__setitem__(1, into_the_panel)), "waypoints_deg", "link"
            )
            self.assert_names(
                edit(lambda plan: plan["inputs"].__setitem__("max_step_deg", 1.0)), "waypoints_deg", "theta"
            )
            self.assertIn("inputs.margin_m", edit(lambda plan: plan["inputs"].pop("margin_m")))
            path.write_text(json.dumps(written)[:500], encoding="utf-8")
            cut = subprocess.run([BIN / "liana", "run", path], capture_output=True, text=True, check=False, timeout=60)
            self.assertEqual((cut.returncode, cut.stdout), (2, ""), cut.stderr)
            self.assertIn("not JSON", cut.stderr)
            self.assert_names(cut.stderr, "liana plan --out")

    def test_a_failed_plan_leaves_the_kept_file_as_it_was_and_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "plan.json"
            path.write_text("an earlier plan", encoding="utf-8")
            done = call(f"--from-deg={PREPARE}", f"--to-deg={TILTED}", f"--out={path}")
            self.assertEqual(done.returncode, 3)
            self.assert_names(done.stderr, "nothing", str(path), "infeasible")
            self.assertEqual(path.read_text(encoding="utf-8"), "an earlier plan")

    def test_the_study_at_reduced_size_solves_both_legs_and_nearly_all_random_scenes(self):
        found = planning_plans.study(BIN, 6)
        self.assertEqual([leg[1] for leg in found["legs"]], ["solved"] * 3)
        self.assertGreaterEqual(found["random"]["solved"], 5, found["random"]["failures"])
        self.assertEqual(found["wrong"], 0)
        for row in found["published"]:  # given the nodes' places, the published angles come out
            self.assertLess(float(row[-1].split()[0]), 0.02, row)


if __name__ == "__main__":
    unittest.main()
