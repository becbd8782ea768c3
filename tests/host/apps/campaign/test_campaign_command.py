"""`liana campaign` as users call it: the same rows on any number of workers and after any kill, and a cluster."""
import contextlib
import json
import os
import pathlib
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from programs import BIN, ROOT, liana, liana_json, start_liana  # noqa: E402

FAKES = pathlib.Path(__file__).resolve().parent / "slurm"
# The arm stands where the step wants it: a run takes the time of its start and its end.
MISSION = """local liana = require "liana"
return liana.mission "still" {
  liana.step "stay" { device = "none", run = liana.move_to "park",
    exit = liana.at_rest(), time_limit_s = %s, on_fail = "hold" },
}
"""
TABLE = """return { format = 1, kind = "campaign", name = "trial", mission = "still.lua", robot = "three_segment_lab",
  scene = "lab_box", seeds = { first = 3, count = %d }, %s }
"""
DRAWN = """sweep = { ["robot.tension.plan_N"] = { 30, 31 } },
  draw = { linkage_error = { uniform = { 0, 0.01 } } }"""
PATIENCE_S = 300


class Campaign(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.write(1, DRAWN)

    def write(self, count, fields, time_limit_s=60):
        self.table = self.folder / "trial.lua"
        self.table.write_text(TABLE % (count, fields))
        (self.folder / "still.lua").write_text(MISSION % time_limit_s)

    def campaign(self, name, *words, expected=(0,)):
        out = self.folder / name
        answer = liana_json("campaign", self.table, "--out", out, *words, expected=expected, timeout_s=PATIENCE_S)
        return out, answer

    def rows(self, database):
        """All columns but the processor time."""
        with contextlib.closing(sqlite3.connect(database)) as connection:
            connection.row_factory = sqlite3.Row
            rows = [dict(row) for row in connection.execute('SELECT * FROM rows ORDER BY "row"')]
        for row in rows:
            self.assertGreater(row.pop("cpu_s"), 0.0)
        return rows


class SameRows(Campaign):
    def test_two_workers_a_kill_and_a_cluster_that_loses_a_task_give_the_same_rows(self):
        first, answer = self.campaign("first.db", "--jobs", 2)
        self.assertEqual((answer["done"], answer["outcomes"]), (2, {"success": 2}))
        rows = self.rows(first)
        self.assertEqual([row["seed"] for row in rows], [3, 3])
        self.assertEqual(len({row["report_hash"] for row in rows}), 2)
        drawn = [json.loads(row["drawn"]) for row in rows]
        self.assertEqual([each["robot.tension.plan_N"] for each in drawn], [30, 31])
        self.assertEqual(drawn[0]["linkage_error"], drawn[1]["linkage_error"])

        killed = self.folder / "killed.db"
        process = start_liana("campaign", self.table, "--out", killed, "--jobs", 1)
        while process.poll() is None and not self.has_rows(killed):
            time.sleep(0.05)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        self.assertEqual(len(self.rows(killed)), 1, "the kill has to come before the last row")
        self.campaign("killed.db", "--jobs", 1)
        self.assertEqual(self.rows(killed), rows)

        with_fakes = {"PATH": f"{FAKES}:{os.environ['PATH']}", "FAKE_SLURM": str(self.folder / "fake")}
        (self.folder / "fake").mkdir()
        cluster = self.folder / "cluster.db"
        done = subprocess.run(
            [BIN / "liana", "campaign", self.table, "--out", cluster, "--engine", "slurm"],
            env={**os.environ, **with_fakes},
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.rows(cluster), rows)
        submitted = [json.loads(line) for line in (self.folder / "fake" / "submitted").read_text().splitlines()]
        self.assertEqual(len(submitted), 2, "the task that was lost is asked for again")
        self.assertTrue(all("--no-requeue" in words for words in submitted))

        self.shown(first, killed)

    def has_rows(self, database):
        try:
            with contextlib.closing(sqlite3.connect(f"file:{database}?mode=ro", uri=True)) as connection:
                return connection.execute("SELECT count(*) FROM rows").fetchone()[0] > 0
        except sqlite3.OperationalError:
            return False

    def shown(self, first, second):
        shown = liana_json("campaign", "show", first)
        self.assertEqual(shown["outcomes"]["success"]["count"], 2)
        self.assertAlmostEqual(shown["outcomes"]["success"]["low"], 0.025**0.5, places=9)
        self.assertEqual(len(shown["worst"]), 2)
        self.assertEqual(len(shown["sweep"]), 2)
        self.assertEqual(shown["figures"]["duration_s"]["count"], 2)
        self.assertTrue(all(row["command"].startswith("liana campaign ") for row in shown["worst"]))
        compared = liana_json("campaign", "compare", first, second)
        self.assertEqual((compared["same_configuration"], compared["same_report"]), (2, 2))
        self.assertEqual(compared["other_outcome"], [])
        picture = self.folder / "picture.svg"
        liana_json("campaign", "plot", first, second, "--svg", picture, "--figure", "duration_s")
        words = [each.text for each in xml.etree.ElementTree.parse(picture).getroot().iter() if each.text]
        self.assertIn("duration_s", words)
        for words in (["show", first], ["compare", first, second]):
            code, text, error = liana("campaign", *words)
            self.assertEqual(code, 0, error)
            self.assertIn("duration_s", text)
        code, _, error = liana("campaign", "show", first, "--by", "duration")
        self.assertEqual(code, 2)
        self.assertIn("duration_s", error)


class Failures(Campaign):
    def test_a_row_that_failed_is_kept_in_full_and_a_lean_one_leaves_nothing(self):
        self.write(1, "keep_failed = 1", time_limit_s=0.02)
        out, answer = self.campaign("failed.db", "--jobs", 1)
        self.assertEqual(answer["outcomes"], {"failed": 1})
        kept = pathlib.Path(f"{out}.failed") / "row-000000"
        for name in ("ticks.mcap", "truth.bin", "report.json", "archive.db"):
            self.assertTrue((kept / name).exists(), name)
        shown = liana_json("campaign", "show", out)
        self.assertEqual(shown["worst"][0]["kept"], str(kept))
        self.assertTrue(shown["worst"][0]["command"].startswith("liana run "))
        self.assertEqual([path.name for path in pathlib.Path(tempfile.tempdir).glob("liana-run-*")], [])


class BadInput(Campaign):
    def refused(self, *words, says):
        code, _, error = liana("campaign", *words)
        self.assertEqual(code, 2, error)
        self.assertEqual(len(error.strip().splitlines()), 1, error)
        for each in says:
            self.assertIn(each, error)

    def test_is_refused_before_any_row_runs(self):
        out = self.folder / "bad.db"
        for fields, says in (
            ("options = { gravitty = 0.1 }", ["gravitty", "gravity"]),
            ("options = { gravity = 2 }", ["--gravity", "0 to 1"]),
            ("options = { seed = 2 }", ["seed"]),
            ("options = { record = 'here' }", ["record"]),
            ("options = { faults = 'none.json' }", ["none.json"]),
            ("sweep = { ['robot.tension.plan'] = { 1 } }", ["plan", "plan_N"]),
            ("sweep = { ['robot.tensoin.plan_N'] = { 1 } }", ["tensoin"]),
            ("sweep = { ['robot.segments.4.modules'] = { 1 } }", ["segments", "3"]),
            ("draw = { gravity = { unifrom = { 0, 1 } } }", ["unifrom", "uniform"]),
            ("bus = 'vcan'", ["bus", "embedded"]),
        ):
            with self.subTest(fields):
                self.write(2, fields)
                self.refused(self.table, "--out", out, says=says)
                self.assertFalse(out.exists())

    def test_words_that_do_not_fit_together(self):
        self.refused(says=["lua/campaigns"])
        self.refused("crosings", says=["crossings"])
        self.refused("shwo", says=["show"])
        self.refused(self.table, "--rows", "1", says=["--full"])
        self.refused(self.table, "--full", self.folder / "full", says=["--rows"])
        self.refused(self.table, "--rows", "2", "--full", self.folder / "full", says=["--rows", "0 to 1"])
        self.refused(self.table, "--rows", "1-0", "--full", self.folder / "full", says=["1-0"])
        database = self.folder / "refused.db"
        self.refused(self.table, "--jobs", "0", "--out", database, says=["--jobs"])
        self.assertFalse(database.exists())
        self.refused("show", self.folder / "none.db", says=["none.db"])
        self.refused("show", self.table, says=["no database"])
        self.refused("plot", says=["database"])

    def test_a_cluster_that_is_not_there_is_named(self):
        done = subprocess.run(
            [BIN / "liana", "campaign", self.table, "--out", self.folder / "x.db", "--engine", "slurm"],
            env={**os.environ, "PATH": str(self.folder)},
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(done.returncode, 1)
        self.assertIn("sbatch", done.stderr)

    def test_the_campaign_that_is_shipped_is_one_of_a_thousand_rows(self):
        answer = json.loads(
            subprocess.run(
                [BIN / "liana-mission", "eval", "campaign", "crossings"], capture_output=True, text=True, check=True
            ).stdout
        )
        self.assertEqual(answer["seeds"], {"first": 1, "count": 1000})
        self.assertEqual(pathlib.Path(answer["folder"]), ROOT / "lua" / "campaigns")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
