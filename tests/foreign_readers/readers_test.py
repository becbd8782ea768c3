"""Readers of others (here @mcap/core, which Foxglove uses) list and decode what a run has recorded (req:A25)."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
MISSION = HERE.parent / "system" / "missions" / "short.lua"


def done(words, **options):
    result = subprocess.run(words, capture_output=True, text=True, timeout=300, check=False, **options)
    assert result.returncode == 0, f"{words}: {result.stdout}\n{result.stderr}"
    return result.stdout


def installed_reader(folder):
    """The reader's packages as package-lock.json names them, in a folder of the build."""
    folder.mkdir(parents=True, exist_ok=True)
    lock = folder / "package-lock.json"
    is_there = (folder / "node_modules").exists() and lock.read_text() == (HERE / lock.name).read_text()
    for name in ("package.json", lock.name, "readable.mjs", "list_channels.mjs", "check_schemas.mjs"):
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


if __name__ == "__main__":
    sys.exit(unittest.main())
