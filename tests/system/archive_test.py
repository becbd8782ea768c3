"""The flight recorder of every run: what it leaves without being asked, and that its death does not harm the run
(req:A25).
"""
import csv
import json
import math
import os
import shutil
import signal
import sqlite3
import time
import unittest

from killed_test import children_of
from support import MISSIONS, SOURCE, SystemTest, start_run
from liana.recordings import Recording, Truth
from liana.system import run

MISSION = MISSIONS / "short.lua"
LASTING = {
    "archive.db",
    "robot.json",
    "scene.json",
    "buses.json",
    "events.txt",
    "commands.txt",
    "report.json",
    "mission_files",
}


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
        page = {"page.html"} if (SOURCE / "build/page/view.html").exists() else set()
        ring = {name for name in names if name.startswith("ring-")}
        self.assertEqual(names - ring, LASTING | {"lock", "truth.bin", "telemetry-1-000000000000.db"} | page)
        self.assertEqual({name.rsplit("-", 1)[0] for name in ring}, {"ring-inputs-1", "ring-outputs-1"})
        self.assertEqual(list(self.home.glob("liana-run-*")), [])

    def test_every_event_of_the_file_is_in_the_archive(self):
        lines = [line for line in (self.folder / "events.txt").read_text().splitlines() if not line.startswith("#")]
        archived = rows(self.folder, "SELECT sequence, tick, text FROM event ORDER BY sequence")
        self.assertEqual(len(archived), len(lines))
        for (_, tick, text), line in zip(archived, lines):
            columns = [column.strip() for column in line.split("\t")]
            self.assertIn(str(tick), columns)
            self.assertIn(text, columns)

    # req:A20
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
        self.assertEqual([line["number"] for line in shown if line["kind"] == "step"], [1, 2, 0])
        later = self.log("show", self.folder.name, "--from", "2").stdout
        self.assertIn("step 1: prepare", later)
        self.assertNotIn("all drives are booted", later)

    def test_an_exported_table_has_a_line_for_every_record(self):
        file = self.home / "run.csv"
        self.assertEqual(self.log("export", "--csv", str(file), "--from", "1", "--to", "3").returncode, 0)
        with file.open() as text:
            lines = list(csv.DictReader(text))
        self.assertEqual([int(line["tick"]) for line in lines], list(range(250, 751, 5)))
        for line in lines:
            self.assertAlmostEqual(float(line["time_s"]), int(line["tick"]) * 0.004)
            self.assertIn(line["state"], ("DISABLED", "ENABLING"))
            self.assertTrue(math.isfinite(float(line["measured_js_deg_10"])))

    def test_bus_traffic_that_was_not_kept_is_refused_by_reason(self):
        done = self.log("export", "--candump", str(self.home / "bus.log"))
        self.assertEqual(done.returncode, 1)
        self.assert_names(done.stderr, "bus traffic", "--record")
        self.assertFalse((self.home / "bus.log").exists())

    def test_every_tick_is_in_the_ring_though_nobody_asked_for_a_recording(self):
        (life,) = json.loads(self.log("verify", "--json").stdout)["lives"]
        ring = life["ring"]
        self.assertEqual((ring["missing"], ring["cut_short"]), (0, 0))
        self.assertEqual(ring["full_ticks"], ring["ticks"])
        self.assertEqual(ring["ticks"], round((ring["to_s"] - ring["from_s"]) / 0.004) + 1)
        self.assertGreater(ring["to_s"], json.loads((self.folder / "report.json").read_text())["duration_s"])
        (listed,) = json.loads(self.log("list", "--json").stdout)
        self.assertEqual([listed["ring"][end] for end in ("from_s", "to_s")], [ring["from_s"], ring["to_s"]])

    def test_two_seconds_that_are_cut_out_of_the_ring_replay_bit_by_bit(self):
        cut = self.home / "cut"
        done = self.log("export", "--ticks", str(cut), "--from", "3", "--to", "5", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        (written,) = json.loads(done.stdout)
        self.assertEqual((written["count"], written["left_out"], written["differing"]), (501, 0, 0))
        replayed = json.loads(run("liana", "replay", cut, "--json").stdout)
        self.assertEqual([replayed[key] for key in ("ticks", "differing_ticks", "missing_ticks")], [501, 0, 0])
        self.assertEqual([tick.tick for tick in Recording(cut / "ticks.mcap").ticks], list(range(750, 1251)))

    def test_an_export_without_a_file_is_refused(self):
        done = self.log("export")
        self.assertEqual(done.returncode, 2)
        self.assert_names(done.stderr, "--csv", "--mcap", "--candump", "--ticks")

    def test_a_damaged_archive_is_said_to_be_so(self):
        copy = self.home / "copy"
        shutil.copytree(self.folder, copy)
        telemetry = copy / "telemetry-1-000000000000.db"
        whole = telemetry.read_bytes()
        telemetry.write_bytes(whole[: len(whole) // 2])
        done = self.log("verify", str(copy))
        self.assertEqual(done.returncode, 1)
        self.assertIn("NOT whole", done.stdout)

    def test_telemetry_that_is_missing_is_named(self):
        copy = self.home / "without_telemetry"
        copy.mkdir()
        (copy / "archive.db").write_bytes((self.folder / "archive.db").read_bytes())
        done = self.log("verify", str(copy))
        self.assertEqual(done.returncode, 1)
        self.assertIn("telemetry-1-000000000000.db: is missing", done.stdout)

    def test_what_a_full_disk_refuses_is_said_to_be_so(self):
        for option in ("--csv", "--mcap"):
            done = self.log("export", option, "/dev/full")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assert_names(done.stderr, "/dev/full", "No space left")
        done = self.log("export", "--csv", "/no/such/folder/file")
        self.assertEqual(done.returncode, 2)
        self.assert_names(done.stderr, "--csv", "/no/such/folder/file", "No such file")

    def test_the_name_of_a_run_is_taken_everywhere(self):
        home = {**os.environ, "XDG_STATE_HOME": str(self.home)}
        by_name = run("liana", "commands", self.folder.name, "--json", env=home)
        by_folder = run("liana", "commands", self.folder, "--json", env=home)
        self.assertEqual((by_name.returncode, by_name.stdout), (0, by_folder.stdout))
        self.assertGreater(by_name.stdout.count("\n"), 10)
        replayed = run("liana", "replay", self.folder.name, env=home)
        self.assertEqual(replayed.returncode, 2)
        self.assertIn(f"{self.folder}': holds no ticks.mcap", replayed.stderr)
        for command in ("commands", "replay", "view"):
            refused = run("liana", command, "liana-run-nosuch", env=home)
            self.assertEqual(refused.returncode, 2)
            self.assert_names(refused.stderr, "liana-run-nosuch", "folder")


class RunsWithRecord(SystemTest):
    def test_bus_traffic_of_all_buses_is_exported_in_the_order_of_its_times(self):
        process = start_run(self, MISSION, "--seed", 3, "--record", "record")
        _, error = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, error)
        self.assertFalse((process.home / "liana").exists(), "all of it is in the user's folder")
        record, exported = process.home / "record", process.home / "bus.log"
        done = run("liana", "log", "export", record, "--candump", exported)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = exported.read_text().splitlines()
        buses = [(record / f"{name}.log").read_text().splitlines() for name in ("can0", "can1")]
        self.assertEqual(sorted(lines), sorted(buses[0] + buses[1]))
        times = [float(line[1 : line.index(")")]) for line in lines]
        self.assertEqual(times, sorted(times))


class RecordersThatDie(SystemTest):
    def test_a_run_goes_on_and_a_new_recorder_takes_over_where_the_old_one_left_off(self):
        process = start_run(self, MISSION, "--seed", 3)
        for line in process.stderr:
            if "prepare" in line:
                break
        time.sleep(0.3)
        os.kill(children_of(process.pid)["liana-archive"], signal.SIGKILL)
        _, error = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, error)
        self.assert_names(error, "liana-archive", "signal 9")
        self.assertIn("it is started again", error)
        folder = folder_of(process)
        self.assertGreater(len(Truth(folder / "truth.bin").rows), 1000)
        done = run("liana", "log", "verify", folder, "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        (life,) = json.loads(done.stdout)["lives"]
        self.assertTrue(life["finished"], life)
        (gap,) = life["gaps"]
        self.assertEqual(gap["what"], "states")
        self.assert_names(gap["text"], "recorder")
        lines = [line for line in (folder / "events.txt").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(life["events"], len(lines))


if __name__ == "__main__":
    unittest.main(verbosity=2)
