"""What comes from elsewhere is data: archives with SQL of their own, pipes and devices in place of files, control
characters in names and logs. Refused or harmless, and at once.
"""
import json
import os
import pathlib
import re
import sqlite3
import subprocess
import sys
import tempfile
import unittest

from programs import BIN

ENDLESS = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT "
LIFE = (
    "id INTEGER PRIMARY KEY, started_utc TEXT, made_by TEXT, config_hash TEXT, time_mode TEXT, period_s REAL, "
    "robot TEXT, scene TEXT, buses TEXT, layout TEXT, finished INTEGER DEFAULT 0"
)
EVENT = (
    "life INTEGER, sequence INTEGER, tick INTEGER, kind TEXT, number INTEGER, subject TEXT, values_json TEXT, text TEXT"
)
COMMAND = (
    "life INTEGER, sequence INTEGER, tick INTEGER, released INTEGER, code INTEGER, share REAL, name TEXT, text TEXT, "
    "remedy TEXT, margin TEXT"
)
GAP = "life INTEGER, first_tick INTEGER, last_tick INTEGER, what TEXT, count INTEGER, text TEXT"
# Refused or shown, it has no control character that a terminal acts on.
ACTING = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")
EVIL = "a\x1b[2Jb\x9b31mc\u202ed"


class ForeignData(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def liana(self, *words):
        """(code, both outputs); a command that waits for a pipe, or reads on without end, fails here."""
        words = [f"{BIN}/liana", *map(str, words)]
        done = subprocess.run(words, capture_output=True, timeout=60, check=False, cwd=self.folder)
        text = (done.stdout + done.stderr).decode()
        self.assertIsNone(ACTING.search(text), ascii(text))
        return done.returncode, text

    def archive(self, *statements, life=LIFE, event=f"CREATE TABLE event({EVENT})"):
        run = self.folder / "run"
        run.mkdir()
        database = sqlite3.connect(run / "archive.db")
        for sql in (
            f"CREATE TABLE life({life})",
            event,
            f"CREATE TABLE command({COMMAND})",
            f"CREATE TABLE gap({GAP})",
        ):
            database.execute(sql)
        database.execute("CREATE TABLE telemetry_file(life INTEGER, first_tick INTEGER)")
        row = (1, "2026-01-01T00:00:00Z", "liana", "0", "fast", 0.004, '{"name":"x"}', '{"name":"y"}', '{"buses":[]}')
        database.execute(
            "INSERT INTO life(id, started_utc, made_by, config_hash, time_mode, period_s, robot, scene, buses) "
            "VALUES(?,?,?,?,?,?,?,?,?)",
            row,
        )
        for sql in statements:
            database.execute(*sql) if isinstance(sql, tuple) else database.execute(sql)
        database.execute("PRAGMA user_version=1")
        database.commit()
        database.close()
        return run

    def test_an_archive_of_plain_tables_is_shown(self):
        event = ("INSERT INTO event VALUES(1,1,1,'boot',1,?,'{}',?)", (EVIL, EVIL))
        code, text = self.liana("log", "show", self.archive(event))
        self.assertEqual(code, 0, text)

    def test_an_archive_with_sql_of_its_own_is_refused_by_its_name(self):
        view = (
            f"CREATE VIEW event AS {ENDLESS} 1 AS life, i AS sequence, i AS tick, 'boot' AS kind, 1 AS number, "
            "'' AS subject, '{}' AS values_json, '' AS text FROM n"
        )
        trigger = "CREATE TRIGGER late AFTER INSERT ON gap BEGIN DELETE FROM gap; END"
        for named, make in (
            ("view 'event'", lambda: self.archive(event=view)),
            ("trigger 'late'", lambda: self.archive(trigger)),
            ("generated column", lambda: self.archive(life=LIFE + ", big BLOB AS (zeroblob(1000000000))")),
            ("'other", lambda: self.archive("CREATE VIRTUAL TABLE other USING fts5(a)")),
        ):
            run = make()
            for words in (("log", "show"), ("log", "verify"), ("view",)):
                code, text = self.liana(*words, run)
                self.assertNotEqual(code, 0, (named, words))
            code, text = self.liana("log", "show", run)
            self.assertIn(named, text)
            for file in run.iterdir():
                file.unlink()
            run.rmdir()

    def test_pipes_and_devices_are_refused_in_place_of_files(self):
        os.mkfifo(self.folder / "pipe")
        os.mkfifo(self.folder / "pipe.json")
        run = self.archive()
        for name in ("commands.txt", "report.json"):
            os.mkfifo(run / name)
        other = self.folder / "other"
        other.mkdir()
        os.mkfifo(other / "archive.db")
        for words in (
            ("log", "show", other),
            ("log", "verify", other),
            ("commands", run),
            ("commands", "pipe"),
            ("replay", "pipe"),
            ("replay", "/dev/zero"),
            ("check", "slit_crossing", "--faults", "pipe"),
            ("check", "slit_crossing", "--faults", "/dev/zero"),
            ("check", "pipe.json"),
            ("check", "slit_crossing", "--calibration", "pipe"),
            ("reach", "--path", "pipe"),
            ("plan", "--from-deg", "prepare", "--follow", "pipe"),
        ):
            code, text = self.liana(*words)
            self.assertNotEqual(code, 0, words)
            self.assertRegex(text, r"pipe|device|ordinary|no such|directory", words)

    def test_names_from_elsewhere_steer_no_terminal(self):
        for words in (("pose", "--robot", EVIL, "--theta-deg", "0"), ("run", EVIL), (EVIL,), ("log", "show", EVIL)):
            code, text = self.liana(*words)
            self.assertEqual(code, 2, text)
        code, text = self.liana("pose", "--robot", EVIL, "--theta-deg", "0", "--json")
        self.assertEqual(code, 2)
        answer = next(json.loads(line) for line in text.splitlines() if line.startswith("{"))
        self.assertEqual(answer["error"]["exit_code"], 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
