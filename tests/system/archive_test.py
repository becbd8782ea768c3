"""The flight recorder of every run: what it leaves without being asked, and that its death does not harm the run (A36,
A30).
"""
import json
import os
import signal
import sqlite3
import time
import unittest

from killed_test import children_of
from support import MISSIONS, SystemTest, start_run
from liana.recordings import Truth
from liana.system import run

MISSION = MISSIONS / "short.lua"
LASTING = {"archive.db", "robot.json", "scene.json", "buses.json", "events.txt", "commands.txt", "report.json"}


def folder_of(process):
    (folder,) = (process.home / "liana" / "runs").iterdir()
    return folder


def rows(folder, sql):
    return sqlite3.connect(folder / "archive.db").execute(sql).fetchall()


class RunsWithoutRecord(SystemTest):
    """One run; its folder lives as long as the class."""

    @classmethod
    def setUpClass(cls):
        keeper = cls()
        cls.addClassCleanup(keeper.doCleanups)
        process = start_run(keeper, MISSION, "--seed", 3)
        _, error = process.communicate(timeout=300)
        assert process.returncode == 0, error
        cls.home, cls.folder = process.home, folder_of(process)

    def runTest(self):
        """Lets setUpClass make an instance whose clean-ups outlive single tests."""

    def log(self, *words):
        return run("liana", "log", *words, env={**os.environ, "XDG_STATE_HOME": str(self.home)})

    def test_leave_what_lasts_and_nothing_else_anywhere(self):
        names = {file.name for file in self.folder.iterdir()}
        self.assertEqual(names, LASTING | {"truth.bin", "telemetry-1-000000000000.db"})
        self.assertEqual(list(self.home.glob("liana-run-*")), [])

    def test_every_event_of_the_file_is_in_the_archive(self):
        lines = [line for line in (self.folder / "events.txt").read_text().splitlines() if not line.startswith("#")]
        archived = rows(self.folder, "SELECT sequence, tick, text FROM event ORDER BY sequence")
        self.assertEqual(len(archived), len(lines))
        for (_, tick, text), line in zip(archived, lines):
            columns = [column.strip() for column in line.split("\t")]
            self.assertIn(str(tick), columns)
            self.assertIn(text, columns)

    def test_every_verified_command_is_in_the_archive(self):
        lines = (self.folder / "commands.txt").read_text().splitlines()
        released = {int(line.split("\t")[2]) for line in lines if line.split("\t")[1] == "release"}
        archived = {sequence for (sequence,) in rows(self.folder, "SELECT sequence FROM command WHERE released")}
        self.assertGreater(len(released), 100)
        self.assertEqual(archived, released)

    def test_a_record_stands_for_every_command_interval(self):
        report = json.loads((self.folder / "report.json").read_text())
        checked = json.loads(self.log("verify", "--json").stdout)
        (life,) = checked["lives"]
        self.assertTrue(checked["whole"] and life["finished"], checked)
        self.assertEqual(life["gaps"], [])
        self.assertEqual(life["records"], round((life["to_s"] - life["from_s"]) / 0.02) + 1)
        self.assertGreater(life["to_s"], report["duration_s"])

    def test_liana_log_lists_it_and_shows_its_steps(self):
        (listed,) = json.loads(self.log("list", "--json").stdout)
        self.assertEqual((listed["name"], listed["outcome"]), (self.folder.name, "success"))
        shown = [json.loads(line) for line in self.log("show", "--json").stdout.splitlines()]
        self.assertEqual([line["number"] for line in shown if line["kind"] == "step"], [1, 2])
        later = self.log("show", self.folder.name, "--from", "2").stdout
        self.assertIn("step 1: prepare", later)
        self.assertNotIn("all drives are booted", later)

    def test_a_damaged_archive_is_said_to_be_so(self):
        copy = self.home / "copy"
        copy.mkdir()
        for file in self.folder.iterdir():
            (copy / file.name).write_bytes(file.read_bytes())
        telemetry = copy / "telemetry-1-000000000000.db"
        whole = telemetry.read_bytes()
        telemetry.write_bytes(whole[: len(whole) // 2])
        done = self.log("verify", str(copy))
        self.assertEqual(done.returncode, 1)
        self.assertIn("NOT whole", done.stdout)


class RecordersThatDie(SystemTest):
    def test_a_run_goes_on_without_its_recorder_and_says_so(self):
        process = start_run(self, MISSION, "--seed", 3)
        for line in process.stderr:
            if "prepare" in line:
                break
        time.sleep(0.3)
        os.kill(children_of(process.pid)["liana-archive"], signal.SIGKILL)
        _, error = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, error)
        self.assertIn("the archive of this run is not whole: liana-archive was killed by signal 9", error)
        folder = folder_of(process)
        self.assertGreater(len(Truth(folder / "truth.bin").rows), 1000)
        done = run("liana", "log", "verify", folder, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        checked = json.loads(done.stdout)
        self.assertTrue(checked["whole"], checked)
        self.assertFalse(checked["lives"][0]["finished"])
        texts = [text for (text,) in rows(folder, "SELECT text FROM event")]
        self.assertIn("all drives are booted", texts)


if __name__ == "__main__":
    unittest.main(verbosity=2)
