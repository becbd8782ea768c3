"""Debian's check_urdf loads every shipped robot as URDF, and a walk along its XML finds the tip where `liana pose` has it."""
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROBOTS = sorted(path.stem for path in (ROOT / "lua" / "robots").glob("*.lua"))
EQUAL = 1e-9


def liana(*words, expected=0):
    program = pathlib.Path(os.environ["LIANA_BIN"]) / "liana"
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == expected, f"{words}: {done.returncode} {done.stdout[-500:]}\n{done.stderr}"
    return done.stdout if expected == 0 else done.stderr


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def moved(xyz):
    return [[1, 0, 0, xyz[0]], [0, 1, 0, xyz[1]], [0, 0, 1, xyz[2]], [0, 0, 0, 1]]


def turned(axis, angle_rad):
    """Rodrigues' formula."""
    x, y, z = axis
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    v = 1 - c
    return [
        [c + x * x * v, x * y * v - z * s, x * z * v + y * s, 0],
        [y * x * v + z * s, c + y * y * v, y * z * v - x * s, 0],
        [z * x * v - y * s, z * y * v + x * s, c + z * z * v, 0],
        [0, 0, 0, 1],
    ]


def numbers(element, name):
    return [float(word) for word in element.get(name).split()]


def origin_of(element):
    origin = element.find("origin")
    roll, pitch, yaw = numbers(origin, "rpy")
    frame = times(moved(numbers(origin, "xyz")), turned((0, 0, 1), yaw))
    return times(times(frame, turned((0, 1, 0), pitch)), turned((1, 0, 0), roll))


def pose_of(robot, link, values):
    """Pose of a link in that of the root: `values` of the joints that lead, by name."""
    by_child = {joint.find("child").get("link"): joint for joint in robot.iter("joint")}
    frame = moved((0, 0, 0))
    while link in by_child:
        joint = by_child[link]
        step = origin_of(joint)
        if joint.get("type") != "fixed":
            mimic = joint.find("mimic")
            value = values[joint.get("name") if mimic is None else mimic.get("joint")]
            axis = numbers(joint.find("axis"), "xyz")
            is_slide = joint.get("type") == "prismatic"
            step = times(step, moved([value * x for x in axis]) if is_slide else turned(axis, value))
        frame = times(step, frame)
        link = joint.find("parent").get("link")
    return frame


def poses_deg(table):
    """Three: the two named ones that come first, and one by chance."""
    named = sorted(table["named_poses_deg"].items())[:2]
    if table["kind"] == "serial":
        limits = [(joint["low_deg"], joint["high_deg"]) for joint in table["joints"]]
    else:
        each = [segment["theta_limit_deg"] for segment in table["segments"] for _ in range(2)]
        feed = [table["base"]["limit_deg"]] * 2 if "base" in table else []
        limits = [(-x, x) for x in feed + each]
    draws = random.Random(table["name"])
    return [pose for _, pose in named] + [[draws.uniform(low, high) for low, high in limits]]


class Models(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="liana-models-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def check_urdf(self, *words):
        """The model as `check_urdf` accepts it."""
        file = self.folder / "model.urdf"
        liana("robot", "export", *words, "--urdf", "--out", file)
        done = subprocess.run(["check_urdf", file], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 0, f"{words}: {done.stdout}{done.stderr}")
        self.assertIn("root Link: base", done.stdout)
        return xml.etree.ElementTree.parse(file).getroot()

    def test_every_shipped_robot_has_its_tip_where_liana_pose_has_it(self):
        self.assertGreater(len(ROBOTS), 5)
        for name in ROBOTS:
            with self.subTest(robot=name):
                robot = self.check_urdf(name)
                table = json.loads(liana("robot", "export", name))
                for pose_deg in poses_deg(table):
                    values = {f"theta_{i}": math.radians(x) for i, x in enumerate(pose_deg, 1)}
                    if "base" in table and table["kind"] == "robot":
                        values["theta_1"] = pose_deg[0] * table["base"]["slide_m_per_deg"]
                    wanted = json.loads(
                        liana("pose", "--robot", name, f"--theta-deg={','.join(map(repr, pose_deg))}", "--json")
                    )
                    tip = pose_of(robot, "tip", values)
                    worst = max(abs(tip[i][k] - wanted["tip_pose"][i][k]) for i in range(4) for k in range(4))
                    self.assertLess(worst, EQUAL, pose_deg)

    def test_joints_that_lead_have_the_limits_of_the_table(self):
        table = json.loads(liana("robot", "export", "feeder"))
        leads = {
            joint.get("name"): joint.find("limit")
            for joint in self.check_urdf("feeder").iter("joint")
            if joint.get("type") != "fixed" and joint.find("mimic") is None
        }
        self.assertEqual(list(leads), [f"theta_{i}" for i in range(1, 11)])
        slide_m = table["base"]["limit_deg"] * table["base"]["slide_m_per_deg"]
        self.assertAlmostEqual(float(leads["theta_1"].get("upper")), slide_m, 12)
        self.assertAlmostEqual(float(leads["theta_4"].get("lower")), -math.radians(18), 12)
        rate_rad_s = math.radians(table["limits"]["theta_rate_deg_s"])
        self.assertAlmostEqual(float(leads["theta_4"].get("velocity")), rate_rad_s, 12)

    def test_masses_add_up_to_what_the_table_says(self):
        robot = self.check_urdf("lab_1g")
        masses = [float(mass.get("value")) for mass in robot.iter("mass")]
        crosses = [kg for kg in masses if kg == 1e-6]
        self.assertEqual(len(crosses), 15)
        self.assertAlmostEqual(sum(masses) - sum(crosses), 15 * 0.06 + 0.1, 12)

    def test_the_bodies_of_a_scene_stand_around_the_arm(self):
        robot = self.check_urdf("zhu2022", "--scene", "panel_slit")
        scene = next(link for link in robot.iter("link") if link.get("name") == "scene")
        table = json.loads(liana("robot", "export", "zhu2022"))
        self.assertEqual(table["name"], robot.get("name"))
        self.assertEqual(len(list(scene.iter("collision"))), len(list(scene.iter("visual"))))
        self.assertIn("rod", [visual.get("name") for visual in scene.iter("visual")])

    def test_options_that_do_not_go_together_are_refused(self):
        for words in (
            ["--urdf", "--mjcf"],
            ["--urdf", "--json"],
            ["--scene", "panel_slit"],
            ["--mjcf", "--scene", "no_such"],
        ):
            self.assertTrue(liana("robot", "export", "zhu2022", *words, expected=2), words)


if __name__ == "__main__":
    sys.exit(unittest.main())
