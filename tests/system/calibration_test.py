"""Calibration as an operator does it: measured in fixtures, used by a run, and refused before motion when anything
does not fit.
"""
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

from support import MISSIONS, start_run
from message import Messages
from liana.system import program, run


def signed(content):
    body = {key: value for key, value in content.items() if key != "sha256"}
    canonical = json.dumps(body, sort_keys=True, separators=(",", ":"))
    return {**body, "sha256": hashlib.sha256(canonical.encode()).hexdigest()}


class Calibration(Messages, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.file = cls.directory / "arm.json"
        cls.done = run("liana", "calibrate", "--out", cls.file)
        assert cls.done.returncode == 0, cls.done.stdout + cls.done.stderr
        cls.content = json.loads(cls.file.read_text())

    def mission(self, content, name="short", *words):
        changed = self.directory / "changed.json"
        changed.write_text(json.dumps(content))
        process = start_run(self, MISSIONS / f"{name}.lua", "--calibration", changed, *words)
        out, error = process.communicate(timeout=120)
        return process, out, error

    def refused(self, content, *words):
        process, out, error = self.mission(content)
        self.assertEqual((process.returncode, out), (2, ""), error)
        for word in words:
            self.assertIn(word, error)
        self.assertEqual(list(process.home.iterdir()), [], "nothing may be left behind")

    def test_the_file_is_signed_and_a_mission_runs_with_it(self):
        self.assertEqual(signed(self.content), self.content)
        process, out, error = self.mission(self.content)
        self.assertEqual(process.returncode, 0, out + error)
        self.assertIn("outcome success", out)

    def test_an_arm_that_lies_in_the_fixture_it_is_said_to_lie_in_is_enabled(self):
        process, out, error = self.mission(self.content, "out_of_fixture", "--in-pose", "jig")
        self.assertEqual(process.returncode, 0, out + error)
        self.assertIn("outcome success", out)

    def test_a_pose_that_would_hide_an_exchange_is_refused(self):
        process, out, error = self.mission(self.content, "short", "--in-pose", "zero")
        self.assertEqual((process.returncode, out), (2, ""), error)
        self.assert_names(error, "--in-pose", "zero", "cable 1 (segment 1) and cable 2 (segment 1)", "0.0 mm")

    def test_the_drums_directions_and_zeros_of_the_simulated_arm_are_found(self):
        self.assertEqual(len(self.content["cables"]), 15)
        for number, cable in enumerate(self.content["cables"]):
            self.assertEqual((cable["serial"], cable["direction"]), (1001 + number, (-1) ** number))
            self.assertAlmostEqual(cable["drum_radius_m"], 0.015, delta=1e-4)
            self.assertLess(abs(cable["offset_m"]), 0.5e-3)

    def test_exchanged_cables_are_named_and_leave_no_file(self):
        out_file = self.directory / "crossed.json"
        crossed = run("liana", "calibrate", "--cross-wired", "4,5", "--out", out_file)
        self.assertEqual(crossed.returncode, 1, crossed.stderr)
        self.assert_names(crossed.stdout, "drive 4 (node 4, segment 2)", "cable 5 (segment 2)")
        self.assert_names(crossed.stdout, "drive 5 (node 5, segment 2)", "cable 4 (segment 2)")
        self.assertEqual(len(crossed.stdout.strip().splitlines()), 2, crossed.stdout)
        self.assertFalse(out_file.exists())

    def test_the_load_of_an_arm_with_weight_is_added_to_its_calibration_and_a_run_begins_with_it(self):
        jigs, loaded = self.directory / "lab.json", self.directory / "lab_loaded.json"
        self.assertEqual(run("liana", "calibrate", "--robot", "lab_1g", "--out", jigs).returncode, 0)
        words = ["--load", "--poses", "zero,park,look,deep", "--calibration", jigs, "--out", loaded, "--json"]
        found = run("liana", "calibrate", "--robot", "lab_1g", *words)
        self.assertEqual(found.returncode, 0, found.stdout + found.stderr)
        report, content = json.loads(found.stdout), json.loads(loaded.read_text())
        self.assertEqual(report["fields"], content["fields"])
        self.assertIn("segments[0].module_mass_kg", [entry["field"] for entry in content["fields"]])
        self.assertLess(report["after"]["torque_Nm"], report["before"]["torque_Nm"])
        self.assertEqual(content["cables"], json.loads(jigs.read_text())["cables"])
        again = run("liana", "calibrate", "--robot", "lab_1g", *words[:2], "zero", "--calibration", loaded)
        self.assertEqual(
            (again.returncode, again.stdout), (2, ""), "four poses are the minimum, and the arm stays still"
        )

    def test_a_load_that_cannot_be_measured_is_refused_before_anything_starts(self):
        for words, named in (
            (["--load"], "gravity_m_s2"),
            (["--load", "--friction"], "--friction"),
            (["--load", "--robot", "lab_1g", "--out", self.directory / "x.json"], "--calibration"),
            (["--load", "--robot", "lab_1g", "--poses", "nosuch"], "nosuch"),
        ):
            refused = run("liana", "calibrate", *words)
            self.assertEqual((refused.returncode, refused.stdout), (2, ""), refused.stderr)
            self.assertIn(named, refused.stderr)

    def test_drives_to_exchange_that_are_not_two_of_the_robot_are_refused_before_anything_starts(self):
        for words in (["calibrate"], ["run", MISSIONS / "short.lua"]):
            for drives in ("3,99", "0,3", "3,3", "3", "3,4,", "3,4,5"):
                done = run("liana", *words, "--cross-wired", drives)
                self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
                self.assert_names(done.stderr, "--cross-wired", drives, "two", "1", "15")

    def test_an_interrupt_ends_with_130_whatever_is_under_way_and_leaves_nothing(self):
        for says in ("pose 1", "pose 2"):
            with tempfile.TemporaryDirectory() as home:
                running = subprocess.Popen(
                    [program("liana"), "calibrate"],
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    text=True,
                    env={**os.environ, "TMPDIR": home},
                )
                error = ""
                while says not in error:
                    error += running.stderr.readline()
                running.send_signal(signal.SIGINT)
                out, rest = running.communicate(timeout=60)
                self.assertEqual((running.returncode, out), (130, ""), error + rest)
                self.assertEqual(list(pathlib.Path(home).iterdir()), [])

    def test_what_is_no_calibration_file_at_all_is_refused_with_what_makes_one(self):
        for text in ("[]", "null", "{"):
            file = self.directory / "none.json"
            file.write_text(text)
            done = run("liana", "run", MISSIONS / "short.lua", "--calibration", file)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("liana calibrate", done.stderr)
            self.assertNotIn("{ format", done.stderr)

    def test_a_changed_foreign_or_stale_file_is_refused_before_anything_starts(self):
        changed = json.loads(self.file.read_text())
        changed["cables"][2]["zero_counts"] += 1000
        self.refused(changed, "sha256", "changed or damaged", "liana calibrate")
        self.refused(signed({**self.content, "robot": "other"}), 'robot: "other"', "another robot")
        self.refused(
            signed({**self.content, "date": "2020-01-01"}), 'date: "2020-01-01"', "365 days", "liana calibrate"
        )

    def test_swapped_drives_are_named_and_the_arm_is_never_enabled(self):
        content = json.loads(self.file.read_text())
        a, b = content["cables"][2], content["cables"][5]
        a["serial"], b["serial"] = b["serial"], a["serial"]
        recording = self.directory / "recording"
        process, out, error = self.mission(signed(content), "short", "--record", recording)
        self.assertEqual(process.returncode, 1, out + error)
        replayed = run("liana", "replay", recording)
        self.assertEqual(replayed.returncode, 1)
        self.assertIn("no tick was recorded", replayed.stderr)
        self.assert_names(out, "node 3", "can0", "0x1018:4", "1006")
        self.assertNotIn("ENABL", out + error)


if __name__ == "__main__":
    unittest.main(verbosity=2)
