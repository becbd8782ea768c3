"""What a run leaves behind: repeatable, replayable, readable by others."""
import collections
import itertools
import json
import random
import re
import shutil
import sqlite3
import subprocess
import unittest

from support import MISSIONS, SystemTest, start_run
from liana.recordings import Mcap, Recording, Truth
from liana.system import run

MISSION = MISSIONS / "short.lua"
FILES = ("ticks.mcap", "truth.bin", "can0.log", "can1.log")  # of which each is different with another seed
END = "shutdown asked for"  # `liana run` asks in wall-clock time: from here on states may come a slot later


def rows_of_archive(path):
    """What does not depend on when the run was, nor on the moment of its end."""
    database = sqlite3.connect(path)
    if path.name == "archive.db":
        events = database.execute("SELECT * FROM event ORDER BY sequence").fetchall()
        life = "config_hash, time_mode, period_s, robot, scene, buses, layout, finished"
        return [
            database.execute(f"SELECT {life} FROM life").fetchall(),
            list(itertools.takewhile(lambda event: END not in event[-1], events)),
            database.execute("SELECT * FROM command ORDER BY sequence").fetchall(),
            database.execute("SELECT * FROM gap").fetchall(),
        ]
    seconds = database.execute("SELECT * FROM telemetry ORDER BY first_tick").fetchall()[:-2]
    until = seconds[-1][1]
    return seconds, database.execute("SELECT * FROM facts WHERE tick <= ? ORDER BY tick", [until]).fetchall()


def messages(folder):
    """Topic and text of each message of a run's states, events and verdicts, to the last."""
    return [(message.channel.topic, bytes(message.data).decode()) for message in Mcap(folder / "state.mcap").messages()]


def content(folder, name):
    """What two runs with one seed must have in common of a file: all of it, but for what a clock or a path put in."""
    if name == "bench_summary.json":
        return [line for line in (folder / name).read_text().splitlines() if "physics_us_per_slot" not in line]
    if name == "liana-archive.log":
        text = (folder / name).read_text().replace(str(folder.parent), "HOME")
        return re.sub("[0-9]+ states, [0-9]+ events", "states, events", text)
    if name.endswith(".db"):
        return rows_of_archive(folder / name)
    if name == "state.mcap":
        return list(itertools.takewhile(lambda message: END not in message[1], messages(folder)))
    if name == "events.txt":
        return list(itertools.takewhile(lambda line: END not in line, (folder / name).read_text().splitlines()))
    return (folder / name).read_bytes()


def record(test, seed):
    process = start_run(test, MISSION, "--time", "fast", "--seed", seed, "--record", "record", "--json", "report.json")
    _, error = process.communicate(timeout=300)
    assert process.returncode == 0, error
    return process.home / "record"


def decoded(log):
    """tshark's lines for a candump log."""
    done = subprocess.run(
        ["tshark", "-r", str(log), "-d", "can.subdissector,canopen"],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    return done.stdout.splitlines()


class Recordings(SystemTest):
    """Three runs, two with one seed; their directories live as long as the class."""

    @classmethod
    def setUpClass(cls):
        keeper = cls()
        cls.addClassCleanup(keeper.doCleanups)
        cls.first, cls.second, cls.other = (record(keeper, seed) for seed in (3, 3, 4))

    def runTest(self):
        """Lets setUpClass make an instance whose clean-ups outlive single tests."""

    def test_two_runs_with_one_seed_are_identical_file_by_file(self):
        names, others = (
            sorted(str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file())
            for folder in (self.first, self.second)
        )
        self.assertEqual(names, others)
        self.assertLessEqual({*FILES, "snapshots.mcap", "state.mcap", "events.txt"}, set(names))
        # Which states and events the recorder still gets at the end is the machine's, and the page shows them all.
        ends_alike = len({tuple(messages(folder)) for folder in (self.first, self.second)}) == 1
        for name in names:
            if name == "page.html" and not ends_alike:
                continue
            first, second = (content(folder, name) for folder in (self.first, self.second))
            if name == "state.mcap":
                first, second = (found[: min(len(first), len(second))] for found in (first, second))
                self.assertGreater(len(first), 500)
            self.assertTrue(first == second, f"{name} differs")
        for name in FILES:
            self.assertGreater((self.first / name).stat().st_size, 10000, name)

    def test_a_tick_costs_at_most_a_third_of_the_3178_bytes_it_cost_without_chunks(self):
        ticks = len(Recording(self.first / "ticks.mcap").ticks)
        size = sum((self.first / name).stat().st_size for name in ("ticks.mcap", "snapshots.mcap", "state.mcap"))
        self.assertLess(size / ticks, 3178 / 3)

    # req:A25
    def test_states_events_and_verdicts_are_json_with_a_schema(self):
        states = Mcap(self.first / "state.mcap")
        self.assertEqual(set(states.channels), {"state", "event", "verdict"})
        for topic, channel in states.channels.items():
            self.assertEqual((channel.message_encoding, channel.schema_encoding), ("json", "jsonschema"))
            self.assertEqual(json.loads(channel.schema)["title"], topic)
            fields = json.loads(channel.schema)["required"]
            for message in states.messages(topic):
                self.assertLessEqual(set(fields), set(message.json()))
        self.assertIn("all drives are booted", [event.json()["text"] for event in states.messages("event")])

    def test_another_seed_gives_another_run(self):
        for name in FILES:
            self.assertFalse(
                (self.first / name).read_bytes() == (self.other / name).read_bytes(),
                f"{name} does not depend on the seed",
            )

    def test_replay_finds_no_differing_tick(self):
        done = run("liana", "replay", self.first, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads(done.stdout)
        self.assertEqual((result["differing_ticks"], result["missing_ticks"], result["complete"]), (0, 0, True))
        self.assertGreater(result["ticks"], 1000)

    def test_a_flipped_byte_anywhere_in_the_recording_is_noticed(self):
        whole = (self.first / "ticks.mcap").read_bytes()
        copy = self.second.parent / "flipped"
        copy.mkdir()
        draw = random.Random(4)
        ends = [*range(10), *range(len(whole) - 50, len(whole), 7)]
        for at in ends + [draw.randrange(len(whole)) for _ in range(15)]:
            (copy / "ticks.mcap").write_bytes(
                whole[:at] + bytes([whole[at] ^ (1 << draw.randrange(8))]) + whole[at + 1 :]
            )
            done = run("liana", "replay", copy)
            self.assertEqual(done.returncode, 1, f"byte {at} of {len(whole)}: {done.stdout}{done.stderr}")
            self.assertRegex(done.stderr, "damaged|cut short|MCAP")

    def test_a_recording_cut_short_is_said_to_be_so(self):
        copy = self.second.parent / "short"
        copy.mkdir()
        whole = (self.first / "ticks.mcap").read_bytes()
        (copy / "ticks.mcap").write_bytes(whole[: len(whole) // 2])
        done = run("liana", "replay", copy, "--json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("cut short", done.stderr)
        result = json.loads(done.stdout)
        self.assertEqual((result["complete"], result["differing_ticks"]), (False, 0))
        self.assertGreater(result["ticks"], 100)

    def test_replay_says_what_it_compared_and_that_the_same_build_recorded(self):
        said = run("liana", "replay", self.first).stdout
        self.assertIn("compared: ticks.mcap", said)
        self.assert_names(said, "checked", "snapshots.mcap", "checksums")
        self.assert_names(said, "recorded", "this build")

    def test_replay_notices_images_that_are_damaged_cut_short_or_missing(self):
        copy = self.second.parent / "images"
        shutil.copytree(self.first, copy)
        whole = (copy / "snapshots.mcap").read_bytes()
        at = len(whole) // 2
        for content, state in (
            (whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :], "damaged"),
            (whole[:at], "cut short"),
            (b"other", "damaged"),
        ):
            (copy / "snapshots.mcap").write_bytes(content)
            done = run("liana", "replay", copy, "--json")
            self.assertEqual((done.returncode, json.loads(done.stdout)["images"]["state"]), (1, state))
            self.assertIn(f"snapshots.mcap: {state}", done.stderr)
        (copy / "snapshots.mcap").unlink()
        self.assertEqual(run("liana", "replay", copy).returncode, 0)

    def test_replay_of_nothing_is_bad_input(self):
        done = run("liana", "replay", self.first.parent)
        self.assertEqual(done.returncode, 2)
        self.assertIn("ticks.mcap", done.stderr)

    def test_tshark_reads_every_frame_as_canopen_and_none_is_malformed(self):
        self.assertIsNotNone(shutil.which("tshark"), "tshark is missing: apt-get install tshark")
        for name, drives in (("can0.log", 8), ("can1.log", 7)):
            lines, frames = decoded(self.first / name), (self.first / name).read_text().splitlines()
            self.assertEqual(len(lines), len(frames))
            self.assertEqual([line for line in lines if "CANopen" not in line], [])
            self.assertEqual([line for line in lines if "alformed" in line], [])
            kinds = collections.Counter(frame.split()[2].split("#")[0] for frame in frames)
            self.assertGreater(kinds["080"], 1000)
            feedback = [kinds[f"{0x180 + node:03X}"] for node in range(1, 16) if kinds[f"{0x180 + node:03X}"] > 1000]
            self.assertEqual(len(feedback), drives)

    def test_the_truth_of_a_short_mission_is_in_order(self):
        truth = Truth(self.first / "truth.bin")
        report = json.loads((self.first / "report.json").read_text())
        self.assertEqual((report["outcome"], report["faults"]), ("success", []))
        self.assertEqual([int(slot) for slot in truth.column("slot")], list(range(len(truth.rows))))
        self.assert_stopped(truth, len(truth.rows) - 130)
        self.assertAlmostEqual(report["final_theta_deg"][8], 11.0, delta=1.0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
