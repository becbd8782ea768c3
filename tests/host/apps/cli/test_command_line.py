"""`liana` as users call it: kinematics, tables and what it says about bad input. A fresh process per call."""
import json
import math
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from programs import BIN, ROOT, json_of_refusal, liana, liana_json, liana_to_full_disk
from message import Messages

sys.path.append(str(ROOT / "host/apps/install"))
import make_pages  # noqa: E402

GOLDEN = json.loads((ROOT / "tests/golden/arm.json").read_text())["cases"]
MICRO = json.loads((ROOT / "tests/golden/micro.json").read_text())["cases"]
ZERO = ",".join(["0"] * 10)
REACHABLE = "3.392167,-0.767048,0.291155,0.9655934,-0.0586164,0.2527781,-0.0172244"


def largest_difference(a, b):
    """Largest |a - b| over two nested lists of the same shape."""
    if isinstance(a, list):
        assert len(a) == len(b), f"{len(a)} entries against {len(b)}"
        return max((largest_difference(x, y) for x, y in zip(a, b)), default=0.0)
    return abs(a - b)


def joined(numbers):
    return ",".join(repr(float(x)) for x in numbers)


def quaternion_of(rotation):
    """Quaternion (w, x, y, z) of a rotation matrix, by the largest of four squares."""
    r = rotation
    squares = [
        1 + r[0][0] + r[1][1] + r[2][2],
        1 + r[0][0] - r[1][1] - r[2][2],
        1 - r[0][0] + r[1][1] - r[2][2],
        1 - r[0][0] - r[1][1] + r[2][2],
    ]
    k = max(range(4), key=squares.__getitem__)
    s = 2 * math.sqrt(squares[k])
    antisymmetric = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]]
    if k == 0:
        return [s / 4] + [a / s for a in antisymmetric]
    q = [antisymmetric[k - 1] / s, 0.0, 0.0, 0.0]
    for j in range(3):
        q[j + 1] = s / 4 if j == k - 1 else (r[k - 1][j] + r[j][k - 1]) / s
    return q


def tip_of(theta_deg):
    pose = liana_json("pose", f"--theta-deg={joined(theta_deg)}")["tip_pose"]
    return [row[3] for row in pose[:3]] + quaternion_of(pose)


class Pose(unittest.TestCase):
    # req:A35 req:A51
    def test_every_golden_case_agrees_to_1e_9(self):
        for case in GOLDEN:
            pose = liana_json("pose", "--robot", "zhu2022", f"--theta-deg={joined(case['theta_deg'])}")
            golden = {"tip_pose", "segment_ends_m", "jacobian", "cable_length_m", "cable_length_change_m"}
            self.assertEqual(set(pose) - golden, {"cable_jacobian_m_rad", "static_load_Nm"})
            for key in golden:
                self.assertLess(largest_difference(pose[key], case[key]), 1e-9, f"{case['name']}: {key}")
            self.assertEqual(pose["static_load_Nm"], [0.0] * 10, "nothing loads this arm")
            for cable, row in enumerate(pose["cable_jacobian_m_rad"]):
                self.assertEqual(row[2 * (cable // 3 + 1) :], [0.0] * (10 - 2 * (cable // 3 + 1)), "beyond its segment")

    def test_a_pose_in_a_scene_says_what_its_slit_wants_planar(self):
        slit = liana_json(
            "pose", "--scene", "panel_slit", "--theta-deg=-2.641,-2.064,-1.81,-4.64,4.777,5.87,0,4.764,0,-0.543"
        )["slit"]
        self.assertEqual((slit["planar_segments"], slit["held_theta"]), (2, [7, 9]))
        self.assertTrue(slit["yaw_range_deg"][0][0] < 4.764 < slit["yaw_range_deg"][0][1])
        self.assertEqual(len(slit["root"]), 7)

    def test_angles_over_the_limit_are_bad_input(self):
        code, out, error = liana("pose", "--theta-deg=20.5" + ",0" * 9)
        self.assertEqual((code, out), (2, ""))
        self.assertIn("20.5", error)
        self.assertEqual(error.count("\n"), 1)


class SerialArm(unittest.TestCase):
    def test_every_golden_pose_of_micro_agrees_to_1e_9(self):
        for case in MICRO:
            pose = liana_json("pose", "--robot", "micro", f"--theta-deg={joined(case['joint_deg'])}")
            self.assertLess(largest_difference(pose["tip_pose"][:3], case["tip_pose"]), 1e-9, case["name"])
            self.assertLess(largest_difference(pose["jacobian"], case["tip_jacobian"]), 1e-9, case["name"])

    def test_ik_of_micro_comes_back_to_the_pose_it_was_asked_for(self):
        for case in MICRO[5:12]:
            tip = [row[3] for row in case["tip_pose"]] + quaternion_of([row[:3] for row in case["tip_pose"]])
            answer = liana_json("ik", "--robot", "micro", "--from-deg=0,60,-30,100,-40,60,0", f"--tip={joined(tip)}")
            self.assertTrue(answer["converged"], case["name"])
            pose = liana_json("pose", "--robot", "micro", f"--theta-deg={joined(answer['theta_deg'])}")
            self.assertLess(largest_difference(pose["tip_pose"][:3], case["tip_pose"]), 1e-5, case["name"])

    def test_what_only_cable_arms_have_is_refused(self):
        for option in ("--hold=1", "--control-point=1:0,0,1"):
            code, out, error = liana(
                "ik", "--robot", "micro", "--from-deg=0,0,0,0,0,0,0", "--tip=1,0,0,1,0,0,0", option
            )
            self.assertEqual((code, out), (2, ""))
            self.assertIn("cable arms only", error)


class InverseKinematics(unittest.TestCase):
    def solve(self, theta_deg, *options):
        """Solves for the tip of theta_deg and checks what was found with `pose`."""
        tip = tip_of(theta_deg)
        answer = liana_json("ik", f"--tip={joined(tip)}", *options, expected=(0, 3))
        if answer["converged"]:
            reached = tip_of(answer["theta_deg"])
            self.assertLess(math.dist(reached[:3], tip[:3]), 1e-6)
            same_sign = math.copysign(1.0, sum(a * b for a, b in zip(reached[3:], tip[3:])))
            self.assertLess(math.dist([same_sign * q for q in reached[3:]], tip[3:]), 0.5e-6)
        return answer

    def test_random_goals_are_found_and_never_claimed_wrongly(self):
        draw = random.Random(7)
        converged = 0
        for _ in range(30):
            goal = [draw.uniform(-15, 15) for _ in range(10)]
            converged += self.solve(goal, f"--from-deg={ZERO}")["converged"]
        self.assertGreaterEqual(converged, 29)

    def test_held_angles_stay_exactly_where_they_were_put(self):
        draw = random.Random(8)
        goal = [draw.uniform(-15, 15) for _ in range(10)]
        goal[6], goal[8] = 0.5, 0.0
        answer = self.solve(goal, f"--from-deg={ZERO}", "--hold=7=0.5,9")
        self.assertTrue(answer["converged"])
        self.assertAlmostEqual(answer["theta_deg"][6], 0.5, delta=1e-12)
        self.assertEqual(answer["theta_deg"][8], 0.0)

    # req:A43
    def test_a_control_point_comes_nearer_while_the_tip_stays(self):
        goal = GOLDEN[1]["theta_deg"]
        start = f"--from-deg={joined(goal)}"
        node = [x + 0.05 for x in GOLDEN[1]["segment_ends_m"][2]]
        answer = self.solve(goal, start, f"--control-point=3:{joined(node)}:1")
        self.assertTrue(answer["converged"])
        self.assertLess(answer["node_distance_m"][0], math.dist(node, GOLDEN[1]["segment_ends_m"][2]))

    def test_an_unreachable_goal_ends_with_3_and_json(self):
        answer = liana_json("ik", f"--from-deg={ZERO}", "--tip=9,0,0,1,0,0,0", expected=(3,))
        self.assertFalse(answer["converged"])
        self.assertGreater(answer["position_error_m"], 1.0)

    def test_bad_input_ends_with_2_and_one_message(self):
        for options, named in [
            ([f"--from-deg={ZERO}", "--tip=nan,0,0,1,0,0,0"], "nan"),
            ([f"--from-deg={ZERO}", "--tip=1,0,0,1,0,0"], "7 numbers"),
            ([f"--from-deg={ZERO}", "--tip=1,0,0,2,0,0,0"], "1e-6"),
            (["--from-deg=0", f"--tip={REACHABLE}"], "10 numbers"),
            (["--from-deg=21" + ",0" * 9, f"--tip={REACHABLE}"], "20 deg"),
            ([f"--from-deg={ZERO}", f"--tip={REACHABLE}", "--hold=11"], "--hold"),
            ([f"--from-deg={ZERO}", f"--tip={REACHABLE}", "--hold=9=30"], "20 deg"),
            ([f"--from-deg={ZERO}", f"--tip={REACHABLE}", "--control-point=6:0,0,0:1"], "--control-point"),
            ([f"--from-deg={ZERO}", f"--tip={REACHABLE}", "--robot=nobody"], "nobody"),
            ([f"--from-deg={ZERO}", f"--tip={REACHABLE}", "--robot=-h"], "-h"),
            ([f"--from-deg={ZERO}", "--tip=1e308,0,0,1,0,0,0"], "within +-1000 m"),
            ([f"--from-deg={ZERO}", f"--tip={REACHABLE}", "--control-point=3:1e308,0,0"], "within +-1000 m"),
            ([f"--from-deg={ZERO}", f"--tip={REACHABLE}", "--control-point=3:1,0,0:1e308"], "up to 1000"),
            ([f"--from-deg={ZERO}", f"--tip={REACHABLE}", "--hold="], "--hold="),
        ]:
            code, out, error = liana("ik", *options)
            self.assertEqual((code, out), (2, ""), options)
            self.assertIn(named, error)
            self.assertEqual(error.count("\n"), 1, error)
            code, out, error = liana("ik", *options, "--json")
            self.assertEqual((code, json.loads(out)), (2, json_of_refusal(2, error)), options)


PREPARE = [-8.5, 0, -12, 0, 8, -2, 13, 0, 12, -2]
PANEL_EDGE = [-6.14, -15.0, -3.29, -8.72, 7.2, 15.0, 5.55, 15.0, 1.0, -2.8]
PRESS_ROD = [-2.641, -2.064, -1.81, -4.64, 4.777, 5.87, 0.0, 4.764, 0.0, -0.543]


def changed(pose, theta, by_deg):
    return [angle + (by_deg if i + 1 == theta else 0) for i, angle in enumerate(pose)]


class Verify(Messages, unittest.TestCase):
    KEYS = {"accepted", "error", "margins", "first", "remedy", "slowly", "inside", "touches_itself"}

    def verdict(self, start, end, duration_s, *more):
        verdict = liana_json(
            "verify", f"--from-deg={joined(start)}", f"--to-deg={joined(end)}", f"--duration={duration_s}", *more
        )
        self.assertEqual(set(verdict), self.KEYS)
        self.assertEqual(set(verdict["margins"]), {"clearance_m", "joint_deg", "rate_deg_s", "tension_N", "time_us"})
        self.assertEqual(verdict["accepted"], verdict["error"] is None and verdict["remedy"] is None)
        return verdict

    def refused(self, code, name, *motion):
        verdict = self.verdict(*motion)
        self.assertIsNotNone(verdict["error"], verdict)
        self.assertEqual((verdict["error"]["code"], verdict["error"]["name"]), (code, name), verdict)
        self.assertTrue(verdict["remedy"])
        return verdict

    def test_a_small_slow_motion_is_accepted_with_margins(self):
        verdict = self.verdict(PREPARE, changed(PREPARE, 9, 0.5), 5)
        self.assertTrue(verdict["accepted"], verdict)
        self.assertTrue(all(margin > 0 for margin in verdict["margins"].values()), verdict)
        self.assertAlmostEqual(verdict["margins"]["joint_deg"], 20 - 13, delta=1e-6)

    def test_a_pose_may_be_named(self):
        named, duration = ("--from-deg=prepare", "--to-deg=prepare"), "--duration=5"
        angles = f"--from-deg={joined(PREPARE)}", f"--to-deg={joined(PREPARE)}"
        self.assertEqual(liana_json("verify", *named, duration), liana_json("verify", *angles, duration))
        code, _, error = liana("verify", "--from-deg=prepared", named[1], duration)
        self.assertEqual(code, 2)
        self.assert_names(error, "--from-deg", "prepared", "10 angles", "robot zhu2022", "prepare")

    def test_where_nothing_is_around_no_clearance_is_told(self):
        motion = f"--from-deg={joined(PREPARE)}", f"--to-deg={joined(PREPARE)}", "--duration=5"
        self.assertIn("left: angle", liana("verify", "--scene=none", *motion)[1])
        self.assertIn("left: clearance", liana("verify", *motion)[1])

    def test_angles_beyond_their_limits_are_a_refusal_and_no_bad_input(self):
        ends = (changed(PREPARE, 1, -11.4), changed(PREPARE, 1, -11.6))
        verdict = self.refused(201, "joint_angle", *ends, 10, "--scene", "none")
        self.assertEqual(verdict["first"]["body"], "theta 1")
        self.assertLess(verdict["margins"]["joint_deg"], 0)

    def test_a_way_through_the_panel_is_refused_with_its_name(self):
        verdict = self.refused(208, "scene_contact", PANEL_EDGE, PRESS_ROD, 120)
        self.assertRegex(verdict["first"]["body"], "panel|wall")
        self.assertLess(verdict["margins"]["clearance_m"], 0)

    def test_an_arm_that_bends_into_itself_is_refused(self):
        self.refused(209, "self_contact", [0] * 10, [19, 0] * 5, 600, "--scene", "none")

    def test_the_same_way_in_too_little_time_is_refused(self):
        self.refused(202, "joint_rate", PREPARE, changed(PREPARE, 10, 5), 2)
        self.refused(203, "tip_speed", PREPARE, changed(PREPARE, 2, 0.4), 0.5)

    def test_bad_input_ends_with_2(self):
        good = [f"--from-deg={ZERO}", f"--to-deg={ZERO}", "--duration=1"]
        for words, named in [
            (good[:2], "--duration"),
            ([good[0], "--to-deg=1,2", good[2]], "--to-deg"),
            ([good[0], "--to-deg=nan" + ",0" * 9, good[2]], "--to-deg"),
            ([*good[:2], "--duration=0"], "--duration"),
            ([*good, "--scene", "nosuch"], "nosuch"),
            ([*good, "--robot", "micro"], "--from-deg"),
        ]:
            code, out, error = liana("verify", *words)
            self.assertEqual((code, out), (2, ""), words)
            self.assertIn(named, error)


class Tables(Messages, unittest.TestCase):
    def test_an_exported_robot_can_be_read_back(self):
        with tempfile.TemporaryDirectory() as directory:
            file = pathlib.Path(directory) / "robot.json"
            self.assertEqual(liana("robot", "export", "zhu2022", "--out", file)[0], 0)
            self.assertEqual(json.loads(file.read_text())["name"], "zhu2022")
            theta = f"--theta-deg={joined(GOLDEN[0]['theta_deg'])}"
            self.assertEqual(liana_json("pose", theta, "--robot", file), liana_json("pose", theta))

    def test_a_run_of_something_that_does_not_exist_ends_with_2(self):
        for arguments, named in [
            (["no_such_mission"], ("no_such_mission",)),
            (["slit_crossing", "--bus", "no_such_bus"], ("no_such_bus",)),
            (["slit_crossing", "--time", "slow"], ("slow",)),
            (["slit_crossing", "--physics", "odd"], ("odd",)),
            (["/tmp"], ("mission", "/tmp", "directory")),
            (["slit_crossing", "--seed", "many"], ("many",)),
            (["slit_crossing", "--bus", "vcan", "--time", "fast"], ("vcan",)),
        ]:
            code, _, error = liana("run", *arguments)
            self.assertEqual(code, 2, error)
            self.assert_names(error, *named)
            self.assertEqual(error.count("\n"), 1, error)

    def test_a_replay_of_nothing_ends_with_2(self):
        with tempfile.TemporaryDirectory() as directory:
            code, _, error = liana("replay", directory)
            self.assertEqual(code, 2)
            self.assertIn("ticks.mcap", error)

    def test_what_is_no_table_of_the_wanted_kind_is_named_with_what_it_is(self):
        with tempfile.TemporaryDirectory() as directory:
            robot, empty = pathlib.Path(directory) / "robot.json", pathlib.Path(directory) / "empty.json"
            liana("robot", "export", "--out", robot)
            empty.write_text('{"format": 1}')
            for options, named in [
                (["--robot", directory], "is a directory"),
                (["--robot", empty], "kind: missing"),
                (["--scene", robot], 'kind: "robot": allowed scene'),
            ]:
                code, out, error = liana("pose", f"--theta-deg={ZERO}", *options)
                self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
                self.assertIn(named, error)
            code, out, error = liana("robot", "export", empty)
            self.assertEqual((code, out), (2, ""), error)
            self.assertIn("kind: missing", error)


class Output(Messages, unittest.TestCase):
    def test_what_standard_output_does_not_take_ends_with_1_and_the_reason(self):
        for words in (
            ["pose", f"--theta-deg={ZERO}"],
            ["pose", f"--theta-deg={ZERO}", "--json"],
            ["ik", f"--from-deg={ZERO}", f"--tip={REACHABLE}"],
            ["robot", "export"],
            ["reach", "--samples=1000", "--json"],
            ["plan", f"--from-deg={ZERO}", f"--to-deg={ZERO}", "--scene=none"],
            ["help"],
        ):
            code, error = liana_to_full_disk(*words)
            self.assertEqual(code, 1, words)
            self.assert_names(error.splitlines()[-1], "standard output")
            self.assertRegex(error.splitlines()[-1], "No space left|disk")

    def test_a_file_that_cannot_be_written_is_refused_before_the_work(self):
        for words in (
            ["robot", "export", "--out"],
            ["reach", "--svg"],
            ["plan", f"--from-deg={ZERO}", f"--to-deg={ZERO}", "--out"],
        ):
            for file, reason in (("/no/such/folder/file", "No such file"), ("/tmp", "Is a directory")):
                code, out, error = liana(*words, file)
                self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
                self.assertIn(f"{words[-1]}: '{file}'", error)
                self.assertIn(reason, error)

    def test_a_file_on_a_full_disk_ends_with_1_and_the_reason(self):
        code, _, error = liana("robot", "export", "--out", "/dev/full")
        self.assertEqual(code, 1)
        self.assert_names(error, "/dev/full", "No space left")


class Dev(unittest.TestCase):
    def test_what_dev_does_not_know_is_refused_before_any_work(self):
        for words, named in [
            (["build", "now"], "not now"),
            (["docs", "x"], "not x"),
            (["help", "x"], "not x"),
            (["test", ""], "is empty"),
            (["test", "hil", "lua"], "hil lua"),
            (["test", "nosuch"], "tests/nosuch"),
            (["numbers", "ik", "nosuch"], "nosuch"),
            (["bench", "--json", "x"], "./dev benchmark --json x"),
            (["benchmark", "--json", "/no/such/file"], "/no/such/file"),
            (["format", "--check", "x"], "x"),
            (["completion", "bash", "x"], "bash x"),
            (["nosuch"], "nosuch"),
            (["test", "--jsn"], "--jsn: no such option"),
            (["numbers", "--jsn"], "--jsn"),
            (["numbers", "fuzz", "golden"], "fuzz golden"),
            (["fuzz", "5"], "--seconds S"),
            (["tsan", "nosuch"], "tests/nosuch"),
            (["mission", "x"], "mission: x"),
            (["mission", "--sed=1"], "--sed: no such option"),
            (["mission", "--seed"], "--seed: its value"),
            (["bits", "--jsn"], "--json FILE"),
            (["accept", "--json", "/no/such/file"], "/no/such/file"),
            (["soak", "--hours", "0"], "'0'"),
        ]:
            done = subprocess.run([str(ROOT / "dev"), *words], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), (words, done.stderr))
            self.assertIn(named, done.stderr)


class Help(Messages, unittest.TestCase):
    def examples(self, *path):
        """The examples of a command and of all below it, by what calls the command."""
        code, out, _ = liana(*path, "--help")
        told = make_pages.Help(out)
        self.assertEqual((code, len(told.examples)), (0, 1), path)
        self.assertTrue(out.endswith(f"Example: {told.examples[0]}\n"), path)
        found = {" ".join(path): told.examples[0]}
        for command in told.commands():
            found |= self.examples(*path, command)
        return found

    def test_help_ends_with_an_example_and_each_works_that_needs_neither_a_system_nor_a_drive(self):
        examples = self.examples()
        self.assertGreater(len(examples), 40)
        runs_long = {"", "campaign", "check", "run", "console", "teleop", "calibrate", "latency", "force", "link"}
        needs_system = {"mission", "ground", "status", "device", "estop", "clear", "recover"}
        with tempfile.TemporaryDirectory() as folder:
            environment = os.environ | {"PATH": f"{BIN}:{os.environ['PATH']}", "XDG_STATE_HOME": folder}
            for command, example in examples.items():
                if command.split(" ")[0] in runs_long | needs_system | {"drive"} or "liana run" in example:
                    continue
                done = subprocess.run(
                    ["sh", "-c", example],
                    cwd=folder,
                    env=environment,
                    capture_output=True,
                    text=True,
                    check=False,
                    timeout=120,
                )
                self.assertEqual(done.returncode, 0, (example, done.stderr))

    def test_the_page_of_the_command_line_has_the_groups_of_help(self):
        """Each command has a heading of its own, under the heading of its group."""
        told = make_pages.Help(liana("help")[1])
        page, group = [], None
        for line in (ROOT / "docs/reference/command-line.md").read_text("utf-8").splitlines():
            if line.startswith("## "):
                group = line.removeprefix("## ")
            elif line.startswith("### liana "):
                page.append((group, line.removeprefix("### liana ")))
        wanted = [(group, name) for group, rows in told.lists.items() for name, _ in rows if name != "help"]
        self.assertEqual(page, wanted)

    def test_an_empty_argument_is_never_taken_for_a_missing_one(self):
        for words in (
            ["estop", "--api", ""],
            ["run", "slit_crossing", "--record", ""],
            ["run", "slit_crossing", "--json", ""],
            ["replay", ""],
        ):
            code, out, error = liana(*words)
            self.assertEqual((code, out), (2, ""), words)
            self.assertIn("an argument is empty", error)

    def test_a_command_that_does_not_exist_is_named_and_those_that_exist_are_listed(self):
        for words, named in [
            (["nosuch"], "'nosuch'"),
            (["help", "nosuch"], "'nosuch'"),
            ([], "no command"),
            (["robot", "dance"], "'robot dance'"),
        ]:
            code, out, error = liana(*words)
            self.assertEqual((code, out), (2, ""), words)
            self.assertIn(named, error)
            known = ("run", "check", "mission", "console", "teleop", "link", "view", "commands", "log")
            self.assert_names(error, *(("export",) if words[:1] == ["robot"] else known))
            self.assertEqual(error.count("\n"), 1, error)

    def test_a_misspelt_command_option_or_name_is_named_as_it_is_spelt(self):
        for words, wrong, meant in [
            (["statsu"], "statsu", "status"),
            (["--lua-dir", "/tmp", "statsu"], "statsu", "status"),
            (["help", "robott"], "robott", "robot"),
            (["robot", "chek"], "chek", "check"),
            (["pose", "--jsn"], "--jsn", "--json"),
            (["pose", "--theta-deq=0"], "--theta-deq", "--theta-deg"),
            (["pose", "--robot", "zhu202", f"--theta-deg={ZERO}"], "zhu202", "zhu2022"),
            (["pose", "--robot=mirco", "--theta-deg=0"], "mirco", "micro"),
            (["pose", "--json", "--scene", "panel_slid", f"--theta-deg={ZERO}"], "panel_slid", "panel_slit"),
            (["robot", "export", "zhu2202"], "zhu2202", "zhu2022"),
            (["run", "slit_crosing"], "slit_crosing", "slit_crossing"),
            (["check", "slit_crossing", "--bus", "embeded"], "embeded", "embedded"),
            (["run", "slit_crossing", "--physics", "wron"], "wron", "worn"),
            (["run", "slit_crossing", "--time=fats"], "fats", "fast"),
            (["run", "slit_crossing", "--operator", "modle"], "modle", "model"),
            (["mission", "paus"], "paus", "pause"),
            (["completion", "bsh"], "bsh", "bash"),
            (["verify", "--from-deg=prepared", "--to-deg=zero", "--duration=5"], "prepared", "prepare"),
            (["sweep", "--from-deg=prepar"], "prepar", "prepare"),
            (["run", "slit_crossing", "--start-pose=prepar"], "prepar", "prepare"),
            (["run", "slit_crossing", "--in-pose=jigg"], "jigg", "jig"),
        ]:
            code, out, error = liana(*words)
            self.assertEqual((code, error.count("\n")), (2, 1), (words, error))
            self.assertRegex(error, rf"did you mean {meant}\?\n$", words)
            self.assert_names(error, wrong)
            if "--json" in words:
                self.assertEqual(json.loads(out), json_of_refusal(2, error))

    def test_nothing_is_suggested_where_no_name_is_near_or_another_thing_is_wrong(self):
        with tempfile.TemporaryDirectory() as folder:
            own = pathlib.Path(folder) / "zhu2023.lua"
            own.write_text("return 1\n", "utf-8")
            for words in (
                ["nosuch"],
                ["pose", "--frob"],
                ["pose", "--robot", "nosuch", f"--theta-deg={ZERO}"],
                ["pose", "--robot", own, f"--theta-deg={ZERO}"],
                ["pose", "--robot", "zhu2022", "--theta-deg=1"],
                ["latency", "--rate", "251"],
                ["run", "slit_crossing", "--gravity", "1.01"],
            ):
                code, _, error = liana(*words)
                self.assertEqual((code, error.count("did you mean")), (2, 0), error)

    def test_an_option_that_a_command_does_not_have_is_named_whatever_else_is_missing(self):
        for words, named in [
            (["pose", "--frob"], ("--frob", "liana pose")),
            (["robot", "export", "--frob=1"], ("--frob", "liana robot export")),
            (["--frob"], ("--frob", "liana")),
        ]:
            code, out, error = liana(*words)
            self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
            self.assert_names(error, *named)

    def test_the_doctor_says_what_to_do_about_everything_that_is_missing(self):
        findings = liana_json("doctor")["findings"]
        self.assertGreaterEqual(len(findings), 8)
        for finding in findings:
            self.assertTrue(finding["found"] and finding["meaning"], finding)
            self.assertEqual(finding["good"], finding["action"] == "", finding)

    def test_bad_input_of_latency_is_named_with_what_is_allowed(self):
        for words, said in [
            (["--rate", "300"], ("300", "250", "embedded", "500", "embedded_500")),
            (["--rate", "fast"], ("--rate", "fast")),
            (["--seconds", "nan"], ("--seconds", "nan")),
            (["--seconds", "0"], ("--seconds", "0", "0.1", "86400 s")),
            (["--buses", "can9"], ("can9", "embedded")),
            (["--rate", "500", "--buses", "embedded"], ("--rate", "500", "embedded", "250 Hz")),
        ]:
            code, out, error = liana("latency", *words)
            self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
            self.assert_names(error, *said)

    def test_bad_input_of_log_view_and_commands_is_named_with_what_is_allowed(self):
        for words, said in [
            (["log", "show", "--from", "nan"], ("--from", "nan", "0", "1e+09")),
            (["log", "show", "--to", "inf"], ("--to", "inf", "0", "1e+09")),
            (["log", "export", "--from", "-1"], ("--from", "-1", "0", "1e+09")),
            (["log", "export", "--from", "soon"], ("--from", "soon", "0", "1e+09")),
            (["commands", "--last", "0"], ("--last", "0", "1", "1000000000", "whole")),
            (["commands", "--last", "all"], ("--last", "all", "1", "1000000000", "whole")),
            (["view", "--out", "/no/such/folder/page.html"], ("--out", "/no/such/folder/page.html")),
            (["log", "show", "--from"], ("--from", "no value", "arm time", "0 to 1e9", "liana log show")),
            (["console", "--listen"], ("--listen", "no value")),
            (["log", "show", "--from", "1", "--from", "2"], ("--from", "2 times", "liana log show")),
            (["help", "pose", "extra"], ("help", "extra", "liana pose")),
            (["robot", "new"], ("name", "required", "liana robot new --help")),
            (["robot", "check", "micro", "--robot", "zhu2022"], ("robot", "--robot", "liana robot check --help")),
            (["log", "verify", "nosuch"], ("log", "nosuch", "folder")),
            (["log", "verify", "/tmp"], ("log", "/tmp", "archive.db")),
            (["commands", __file__], ("stage", "command", "run")),
            (["reach", "--path", "/proc/self/mem"], ("/proc/self/mem", "readable file")),
        ]:
            code, out, error = liana(*words)
            self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
            self.assert_names(error, *said)

    def test_a_refusal_is_json_too_where_an_answer_would_be(self):
        for words in (
            ["pose", "--json"],
            ["pose", "--theta-deg=1", "--nosuch", "--json"],
            ["reach", "--node=99", "--json"],
            ["plan", "--from-deg=0", "--to-deg=0", "--json"],
            ["verify", "--from-deg", "--json"],
            ["run", "nosuch", "--json", "-"],
            ["check", "nosuch", "--json=-"],
            ["status", "--json"],
            ["clear", "--api", "/no/such", "--json"],
            ["log", "show", "/no/such", "--json"],
            ["replay", "/no/such", "--json"],
            ["latency", "--seconds=0", "--json"],
            ["calibrate", "--robot", "nosuch", "--json"],
            ["robot", "check", "nosuch", "--json"],
            ["mission", "fly", "--json"],
            ["nosuch", "--json"],
        ):
            code, out, error = liana(*words)
            self.assertEqual((code, json.loads(out), error.count("\n")), (2, json_of_refusal(2, error), 1), words)
        for words in (["pose"], ["run", "nosuch", "--json", "report.json"]):
            self.assertEqual(liana(*words)[:2], (2, ""), words)

    def file_with(self, text):
        path = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "huge.json"
        path.write_text(text)
        return str(path)

    def test_bad_input_of_every_other_program_ends_with_2_and_one_message_with_its_name(self):
        tables = ["--robot", "/no/such/robot", "--scene", "/no/such/scene", "--buses", "/no/such/buses"]
        huge = self.file_with('{"rate_hz":1e400}')
        for name, words, said in (
            ("lianad", ["--nosuch"], ("--nosuch",)),
            ("lianad", [], ("--robot", "required")),
            ("lianad", [*tables, "--api", "a"], ("/no/such/buses",)),
            ("lianad", [*tables, "--api", "a", "--time", "never"], ("--time", "never", "fast", "paced", "real")),
            ("liana-bus", ["--nosuch"], ("--nosuch",)),
            ("liana-bus", ["--socket", "s", "--buses", "/dev/null"], ("/dev/null", "device")),
            ("liana-bus", ["--socket", "s", "--buses", huge], (huge, "rate_hz", "1e400")),
            ("liana-bus", ["--socket", "s", "--buses", "b", "--log", "/no/such"], ("/no/such",)),
            ("liana-bench", ["--nosuch"], ("--nosuch", "not expected")),
            ("liana-bench", [], ("--robot", "required")),
            ("liana-bench", ["--eds", "/no/such/folder/drive.eds"], ("/no/such/folder/drive.eds",)),
            ("liana-bench", [*tables, "--bus-socket", "s", "--seed", "-1"], ("--seed", "-1", "whole")),
            ("liana-bench", [*tables, "--bus-socket", "s", "--free-step", "5"], ("--free-step",)),
            ("liana-bench", [*tables, "--bus-socket", "s", "--gravity=nan"], ("--gravity", "nan", "0", "1")),
            (
                "liana-bench",
                [*tables, "--bus-socket", "s", "--linkage-error=nan"],
                ("--linkage-error", "nan", "0", "0.5"),
            ),
            ("liana-bench", [*tables, "--bus-socket", "s"], ("/no/such/robot",)),
            ("liana-mission", ["--nosuch"], ("--nosuch",)),
            ("liana-mission", ["eval", "robot", "nosuch"], ("nosuch", "zhu2022")),
            ("liana-operator", ["--nosuch"], ("--nosuch",)),
            ("liana-operator", ["--api", "a", "--recordings", ".", "--seed", "x"], ("--seed", "x", "whole")),
            ("liana-gateway", ["--nosuch"], ("--nosuch",)),
            ("liana-archive", ["--nosuch"], ("--nosuch",)),
        ):
            done = subprocess.run([str(BIN / name), *words], capture_output=True, text=True, check=False, timeout=60)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), (name, done.stderr))
            self.assertTrue(done.stderr.startswith(name + ": "), done.stderr)
            self.assert_names(done.stderr, *said)

    def test_bad_input_of_check_is_named_before_anything_starts(self):
        for words, said in [
            ([], ("mission", "required")),
            (["nosuch"], ("nosuch",)),
            (["slit_crossing", "--bus", "vcan"], ("--bus", "vcan", "dry run")),
            (["slit_crossing", "--seed", "-1"], ("--seed",)),
            (["slit_crossing", "--scene", "nosuch"], ("nosuch",)),
            (["slit_crossing", "--faults", "/no/such/file"], ("--faults",)),
            (["slit_crossing", "--physics", "magic"], ("--physics",)),
            (["slit_crossing", "--gravity=nan"], ("--gravity", "nan", "0", "1")),
            (["slit_crossing", "--gravity=1.1"], ("--gravity", "1.1", "0", "1")),
            (["slit_crossing", "--linkage-error=nan"], ("--linkage-error", "nan", "0", "0.5")),
            (["slit_crossing", "--json", "/no/such/folder/file"], ("--json", "/no/such/folder/file")),
            (["slit_crossing", "--record", "/tmp/x"], ("--record", "liana check")),
            (["slit_crossing", "--time", "real"], ("--time", "liana check")),
            (["slit_crossing", "x"], ("x", "liana check")),
        ]:
            code, out, error = liana("check", *words)
            self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
            self.assert_names(error, *said)

    def test_every_fault_is_told_with_its_detector_and_its_ticks(self):
        plain = liana("faults")[1]
        for fault in json.loads(liana("faults", "--json")[1]):
            told = plain[plain.index(f"{fault['number']} {fault['name']} ") :]
            ticks = "" if fault["within_ticks"] is None else f"     within ticks: {fault['within_ticks']}\n"
            self.assertIn(
                (f"\n     detected by {fault['detected_by']}\n{ticks}    " f" {fault['remedy']}\n"),
                told,
            )

    def test_completion_knows_the_values_too(self):
        for words, wanted in [
            ("liana plan --scene pan", "panel_slit"),
            ("liana plan --scene no", "none"),
            ("liana pose --robot zh", "zhu2022"),
            ("liana run sli", "slit_crossing slit_crossing_servo"),
            ("liana check sli", "slit_crossing slit_crossing_servo"),
            ("liana check --true-physics wo", "worn"),
            ("liana run --bus vc", "vcan vcan_payload"),
            ("liana plan --follow sl", "slit"),
            ("liana cl", "clear"),
            ("liana console --sim", "--simulate"),
            ("liana log ex", "export"),
            ("liana log export --cand", "--candump"),
            ("liana robot export zh", "zhu2022"),
            ("liana --lua", "--lua-dir"),
            ("liana-mission eval sc", "scene"),
            ("liana-mission eval scene pan", "panel_slit"),
        ]:
            program = words.split()[0]
            function = "_liana_mission" if program == "liana-mission" else "_liana"
            script = (
                f"source <({BIN}/liana completion bash); COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1));"
                f" {function}; echo ${{COMPREPLY[@]}}"
            )
            done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=False, cwd="/")
            self.assertEqual((done.stdout.strip(), done.stderr), (wanted, ""), words)

    def test_a_word_too_many_is_named_with_its_command(self):
        for words, command in (
            (["status", "x"], "liana status"),
            (["run", "slit_crossing", "x"], "liana run"),
            (["robot", "export", "a", "x"], "liana robot export"),
        ):
            code, out, error = liana(*words)
            self.assertEqual((code, out, error.count("\n")), (2, "", 1), words)
            self.assert_names(error, "liana", "x", command, f"{command} --help")

    def test_standard_output_is_no_file_to_write_to(self):
        for words in (
            ["plan", "--from-deg=0,0,0,0,0,0,0,0,0,0", "--to-deg=1,0,0,0,0,0,0,0,0,0", "--out", "-"],
            ["robot", "export", "--out=-"],
            ["reach", "--svg=-"],
        ):
            code, out, error = liana(*words)
            self.assertEqual((code, out, error.count("\n")), (2, "", 1), words)
            self.assertIn("'-': allowed: a file", error)

    def test_a_plan_is_written_only_by_a_name_that_run_knows(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "s3.plan"
            code, out, error = liana("plan", f"--from-deg={ZERO}", f"--to-deg={ZERO}", "--out", file)
            self.assertEqual((code, out, error.count("\n"), file.exists()), (2, "", 1, False), error)
            self.assert_names(error, "--out", str(file), ".json")

    def test_a_scene_needs_a_slit_only_where_the_slit_is_used(self):
        self.assertEqual(
            liana("plan", "--scene=none", "--from-deg=0,0,0,0,0,0,0,0,0,0", "--to-deg=1,0,0,0,0,0,0,0,0,0")[0], 0
        )
        self.assertEqual(liana("reach", "--scene=none", "--samples=1000")[0], 0)
        code, out, error = liana("pose", "--scene=none", "--theta-deg=0,0,0,0,0,0,0,0,0,0")
        self.assertEqual((code, out, error.count("\n")), (2, "", 1), error)
        self.assert_names(error, "liana", "--scene", "none", "slit")
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "own.json"
            scene.write_text('{"format":1,"kind":"scene","name":"own","boxes":[],"spheres":[]}', encoding="utf-8")
            code, out, error = liana("run", "slit_crossing", f"--scene={scene}")
            self.assertEqual((code, out, error.count("\n")), (2, "", 1))
            self.assert_names(error, "own.json", "camera")

    def test_status_without_a_running_system_says_so(self):
        code, _, error = liana("status", "--api", "/tmp/liana-no-such-socket")
        self.assertEqual(code, 2)
        self.assertIn("liana-no-such-socket", error)
        self.assertEqual(liana("status", "--api", "/tmp/" + "x" * 300)[0], 2)
        for command in ("status", "estop"):
            code, _, error = liana(command, "--api", "/tmp")
            self.assertEqual(code, 2)
            self.assert_names(error, "--api", "/tmp", "socket")

    def test_a_stop_that_finds_nothing_warns_and_has_a_code_of_its_own(self):
        code, out, error = liana("estop", "--json")
        self.assertEqual((code, json.loads(out), error.count("\n")), (4, json_of_refusal(4, error), 1))
        self.assertIn("NOTHING WAS STOPPED", error)
        self.assertIn("cut its power", error)
        for socket in ("/tmp/liana-no-such-socket", "/tmp", "/tmp/" + "x" * 300):
            code, _, error = liana("estop", "--api", socket)
            self.assertEqual(code, 2)
            self.assertIn("NOTHING WAS STOPPED", error)


class SignalsInVirtualTime(unittest.TestCase):
    """A bus without a bench: virtual time stands still, and nothing but a signal ends lianad."""

    def lianad(self, number, *words):
        """(exit code, standard error) of a lianad that gets the signal while it waits."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for kind, name in (("robot", "zhu2022"), ("scene", "none"), ("buses", "embedded")):
            with open(folder / f"{kind}.json", "wb") as file:
                subprocess.run([BIN / "liana-mission", "eval", kind, name], stdout=file, check=True)
        bus = subprocess.Popen([BIN / "liana-bus", "--socket", folder / "bus", "--buses", folder / "buses.json"])
        self.addCleanup(bus.wait)
        self.addCleanup(bus.kill)
        tables = [word for kind in ("robot", "scene", "buses") for word in (f"--{kind}", folder / f"{kind}.json")]
        sockets = ["--api", folder / "api", "--bus-socket", folder / "bus"]
        lianad = subprocess.Popen([BIN / "lianad", *tables, *sockets, *words], stderr=subprocess.PIPE, text=True)
        self.addCleanup(lianad.kill)
        while not (folder / "api").exists():
            self.assertIsNone(lianad.poll())
            time.sleep(0.02)
        time.sleep(0.5)  # the signal is handled from a moment after that on; before, it ends lianad anyway
        lianad.send_signal(number)
        _, error = lianad.communicate(timeout=60)
        return lianad.returncode, error

    def test_a_signal_ends_a_lianad_whose_bus_answers_no_more(self):
        code, error = self.lianad(signal.SIGTERM)
        self.assertEqual(code, 1)
        self.assertRegex(error, "signal.*time stood still")

    def test_a_signal_ends_a_lianad_that_waits_for_its_clients(self):
        code, error = self.lianad(signal.SIGINT, "--expect", "mission")
        self.assertEqual((code, error), (0, ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
