"""Readers of others (here @mcap/core, which Foxglove uses) list and decode what a run has recorded (req:A25)."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree

HERE = pathlib.Path(__file__).resolve().parent
MISSION = HERE.parent / "system" / "missions" / "short.lua"


def done(words, **options):
    result = subprocess.run(words, capture_output=True, text=True, timeout=300, check=False, **options)
    assert result.returncode == 0, f"{words}: {result.stdout}\n{result.stderr}"
    return result.stdout


def moved(transform, point):
    """A point by a translation and a unit quaternion."""
    w, u = transform["rotation"]["w"], [transform["rotation"][axis] for axis in "xyz"]
    t = [2 * x for x in cross(u, point)]
    turned = [p + w * x + y for p, x, y in zip(point, t, cross(u, t))]
    return [x + transform["translation"][axis] for x, axis in zip(turned, "xyz")]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def installed_reader(folder):
    """The reader's packages as package-lock.json names them, in a folder of the build."""
    folder.mkdir(parents=True, exist_ok=True)
    lock = folder / "package-lock.json"
    is_there = (folder / "node_modules").exists() and lock.read_text() == (HERE / lock.name).read_text()
    for name in (
        "package.json",
        lock.name,
        "readable.mjs",
        "list_channels.mjs",
        "check_schemas.mjs",
        "decode_ros2.mjs",
    ):
        shutil.copy(HERE / name, folder)
    if not is_there:
        done(["npm", "ci", "--no-audit", "--no-fund"], cwd=folder)
    return folder


class ForeignReaders(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        home = tempfile.TemporaryDirectory(prefix="liana-readers-")
        cls.addClassCleanup(home.cleanup)
        folder = pathlib.Path(home.name) / "record"
        liana = pathlib.Path(os.environ["LIANA_BIN"]) / "liana"
        done([liana, "run", MISSION, "--record", folder], env={**os.environ, "XDG_RUNTIME_DIR": home.name})
        reader = installed_reader(pathlib.Path(os.environ["LIANA_READER"]))
        files = [folder / name for name in ("ticks.mcap", "snapshots.mcap", "state.mcap")]
        cls.found = json.loads(done(["node", reader / "list_channels.mjs", *files]))
        exported = pathlib.Path(home.name) / "export.mcap"
        done([liana, "log", "export", folder, "--mcap", exported])
        cls.shown = json.loads(done(["node", reader / "check_schemas.mjs", exported]))
        bags = [pathlib.Path(home.name) / name for name in ("ros2.mcap", "ros2_utc.mcap")]
        done([liana, "log", "export", folder, "--ros2", bags[0]])
        done([liana, "log", "export", folder, "--ros2", bags[1], "--wall-time"])
        cls.bag, cls.bag_in_utc = [json.loads(done(["node", reader / "decode_ros2.mjs", bag])) for bag in bags]

    def test_every_file_of_a_recording_is_indexed(self):
        self.assertEqual(set(self.found), {"ticks.mcap", "snapshots.mcap", "state.mcap"})
        for name, file in self.found.items():
            self.assertTrue(file["indexed"], name)

    def test_every_json_channel_decodes_and_keeps_its_schema(self):
        channels = self.found["state.mcap"]["channels"]
        self.assertEqual(set(channels), {"state", "event", "verdict"})
        for topic, channel in channels.items():
            self.assertEqual((channel["encoding"], channel["schema"]), ("json", "jsonschema"), topic)
            self.assertGreater(channel["messages"], 0, topic)

    def test_the_exact_channels_are_listed_with_a_message_for_every_tick(self):
        channels = self.found["ticks.mcap"]["channels"]
        self.assertEqual(set(channels), {"start", "inputs", "outputs"})
        self.assertEqual(channels["inputs"]["messages"], channels["outputs"]["messages"])
        self.assertGreater(channels["inputs"]["messages"], 1000)

    def test_an_exported_archive_keeps_the_schemas_that_foxglove_publishes(self):
        schemas = {topic: found["schema"] for topic, found in self.shown.items()}
        wanted = {
            "/scene": "foxglove.SceneUpdate",
            "/tf": "foxglove.FrameTransforms",
            "/joint_states": "foxglove.JointStates",
            "/log": "foxglove.Log",
            "/state": "liana.State",
        }
        self.assertEqual(schemas, wanted)

    def test_an_exported_archive_shows_every_link_in_a_frame_that_moves(self):
        links = [f"link_{i}" for i in range(1, 41)]
        self.assertEqual(self.shown["/scene"]["frames"], ["base", *links])
        self.assertEqual(self.shown["/tf"]["frames"], links)
        self.assertEqual(self.shown["/scene"]["messages"], 1)
        self.assertGreater(self.shown["/tf"]["messages"], 200)

    def test_a_bag_for_ros2_has_the_types_and_encodings_that_its_player_needs(self):
        self.assertEqual(self.bag["profile"], "ros2")
        self.assertEqual(self.bag["metadata"], ["rosbag2"])
        wanted = {
            "/robot_description": "std_msgs/msg/String",
            "/tf_static": "tf2_msgs/msg/TFMessage",
            "/tf": "tf2_msgs/msg/TFMessage",
            "/joint_states": "sensor_msgs/msg/JointState",
            "/measured_js": "sensor_msgs/msg/JointState",
            "/setpoint_js": "sensor_msgs/msg/JointState",
            "/measured_cp": "geometry_msgs/msg/PoseStamped",
            "/setpoint_cp": "geometry_msgs/msg/PoseStamped",
            "/goal_cp": "geometry_msgs/msg/PoseStamped",
            "/measured_cf": "geometry_msgs/msg/WrenchStamped",
            "/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
        }
        self.assertEqual({topic: each["type"] for topic, each in self.bag["topics"].items()}, wanted)
        for topic, each in self.bag["topics"].items():
            self.assertEqual((each["encoding"], each["schema"]), ("cdr", "ros2msg"), topic)
            is_latched = topic in ("/robot_description", "/tf_static")
            self.assertIn(f"durability: {1 if is_latched else 2}\n", each["qos"], topic)
            self.assertEqual(each["messages"] == 1, is_latched, topic)

    def test_the_frames_of_a_bag_lead_from_the_base_to_where_its_pose_has_the_tip(self):
        topics = self.bag["topics"]
        frames = {
            each["child_frame_id"]: each
            for topic in ("/tf", "/tf_static")
            for each in topics[topic]["last"]["value"]["transforms"]
        }
        model = xml.etree.ElementTree.fromstring(topics["/robot_description"]["first"]["value"]["data"])
        self.assertEqual(set(frames), {link.get("name") for link in model.iter("link")} - {"base"})
        point, frame = (0.0, 0.0, 0.0), "tip"
        while frame != "base":
            transform = frames[frame]["transform"]
            point = moved(transform, point)
            frame = frames[frame]["header"]["frame_id"]
        measured = topics["/measured_cp"]["last"]["value"]
        self.assertEqual(measured["header"]["frame_id"], "base")
        for axis, value in zip("xyz", point):
            self.assertAlmostEqual(value, measured["pose"]["position"][axis], delta=2e-6)  # telemetry has 32 bits

    def test_the_joints_of_a_bag_are_those_of_its_model(self):
        topics = self.bag["topics"]
        model = xml.etree.ElementTree.fromstring(topics["/robot_description"]["first"]["value"]["data"])
        leads = [
            each.get("name")
            for each in model.iter("joint")
            if each.get("type") != "fixed" and each.find("mimic") is None
        ]
        joints = topics["/joint_states"]["last"]["value"]
        self.assertEqual(joints["name"], leads)
        self.assertEqual(len(joints["position"]), len(leads))

    def test_wall_time_adds_the_begin_of_the_run_to_every_stamp(self):
        begins = set()
        for topic, each in self.bag["topics"].items():
            later = self.bag_in_utc["topics"][topic]
            for which in ("first", "last"):
                begins.add(int(later[which]["time_ns"]) - int(each[which]["time_ns"]))
            if "header" in each["last"]["value"]:
                stamp = later["last"]["value"]["header"]["stamp"]
                self.assertEqual(stamp["sec"] * 10**9 + stamp["nanosec"], int(later["last"]["time_ns"]), topic)
        self.assertEqual(len(begins), 1, begins)
        begin_s = begins.pop() / 1e9
        self.assertEqual(begin_s, int(begin_s))
        self.assertLess(abs(time.time() - begin_s), 24 * 3600)


if __name__ == "__main__":
    sys.exit(unittest.main())
