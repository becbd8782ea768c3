"""A tracker's poses of a run correct the arm's table: run, exported, fitted and used as an operator does it."""
import json
import pathlib
import tempfile
import unittest

import support  # noqa: F401
from liana.system import run


class Tracker(unittest.TestCase):
    def setUp(self):
        self.directory = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_a_tracker_finds_the_lengths_of_an_arm_from_a_run_and_other_files_and_runs_are_refused(self):
        arm, tour, poses, out = (self.directory / name for name in ("1g.json", "tour", "poses.csv", "1g_tracked.json"))
        lab = ["--robot", "lab_1g", "--seed", "3"]
        self.assertEqual(run("liana", "calibrate", *lab, "--out", arm).returncode, 0)
        words = ["--scene", "none", "--calibration", arm, "--record", tour]
        toured = run("liana", "run", "tracker_tour", *lab, *words, timeout=900)
        self.assertEqual(toured.returncode, 0, toured.stdout + toured.stderr)
        exported = run("liana", "log", "export", tour, "--tracker", poses)
        self.assertEqual(exported.returncode, 0, exported.stderr)

        def fit(file, *more):
            return run("liana", "calibrate", *lab, "--tracker", file, "--run", tour, *more)

        found = fit(poses, "--calibration", arm, "--out", out, "--json")
        self.assertEqual(found.returncode, 0, found.stdout + found.stderr)
        report, content, before = json.loads(found.stdout), json.loads(out.read_text()), json.loads(arm.read_text())
        self.assertEqual(report["fields"], content["fields"])
        self.assertGreaterEqual(report["poses"], 12)
        self.assertLess(report["after"]["tip_m"], 0.3e-3)
        lengths = [entry for entry in content["fields"] if entry["field"].endswith("module_length_m")]
        self.assertEqual(len(lengths), 3)
        for entry in lengths:
            self.assertLess(entry["sd"], 0.25e-3, "the table is known to 0.4 mm")
            self.assertLess(
                abs(entry["value"] - 0.06), 4 * entry["sd"], "the bench builds lengths as the table has them"
            )
        self.assertNotEqual(content["cables"], before["cables"], "zeros are corrected, too")
        with_load = run("liana", "check", "lab_tour", "--robot", "lab_1g", "--scene", "none", "--calibration", out)
        self.assertEqual(with_load.returncode, 0, with_load.stdout + with_load.stderr)

        rows = poses.read_text().splitlines()
        short, other = self.directory / "short.csv", self.directory / "other.csv"
        short.write_text("\n".join(rows[: len(rows) // 4]) + "\n")
        still = rows[1].split(",")[1:]
        other.write_text("\n".join([rows[0], *(",".join([str(i), *still]) for i in range(200))]) + "\n")
        changed, jigs = self.directory / "changed.lua", self.directory / "changed.json"
        changed.write_text('local t = require "robots.lab_1g"\nt.tool.mass_kg = 0.2\nreturn t\n')
        self.assertEqual(run("liana", "calibrate", "--robot", changed, "--out", jigs).returncode, 0)
        fitted = ["liana", "calibrate", "--tracker", poses, "--run", tour]
        for refused, named in (
            (fit(short, "--calibration", arm), "at least 8"),
            (fit(other, "--calibration", arm), "correlation"),
            (fit(poses), "--calibration"),
            (fit("/nowhere.csv", "--calibration", arm), "/nowhere.csv"),
            (run(*fitted, "--robot", changed, "--calibration", jigs), str(tour)),
        ):
            self.assertEqual((refused.returncode, refused.stdout), (2, ""), refused.stderr)
            self.assertIn(named, refused.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
