"""./dev test counts a skip that is not in its list as a failure, whoever skips: ctest, GoogleTest, or a part of a test
of Python's. Of a program that runs whole each case is counted."""

import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import tiers

TESTS = """
add_test("Good.One" "/bin/true")
add_test("Bad.One" "/bin/sh" "-c" "echo what is wrong; exit 1")
add_test("FullDisk.Any" "/bin/sh" "-c" "exit 4")
add_test("Other.One" "/bin/sh" "-c" "exit 4")
set_tests_properties("FullDisk.Any" "Other.One" PROPERTIES SKIP_RETURN_CODE 4)
add_test("system.runs" "/bin/sh" "-c" "yes line | head -n 900; echo 'OK (skipped=1)'")
add_test("system.part" "/bin/sh" "-c" "yes line | head -n 900; echo 'OK (skipped=2, expected failures=1)'")
add_test("system.whole" "/bin/echo" "OK")
"""
PROGRAMS = """
add_test("good_tests" "/bin/true")
add_test("bad_tests" "/bin/sh" "-c" "echo as a whole; exit 1")
add_test("dying_tests" "/bin/sh" "-c" "echo where it died; exit 1")
add_test("silent_tests" "/bin/sh" "-c" "echo before any case; exit 1")
"""
CASE = '<testcase classname="Suite" name="{}" result="{}">{}</testcase>'
FAILURE = '<failure message="short">what is wrong</failure>'
CASES = {
    "good_tests": [("One", "completed", ""), ("Two", "completed", ""), ("Off", "suppressed", "")],
    "bad_tests": [("Three", "completed", ""), ("Four", "completed", FAILURE), ("Five", "skipped", "<skipped/>")],
    "dying_tests": [("Six", "completed", "")],
}


class Skips(unittest.TestCase):
    def test_planned_ones_are_counted_as_skipped_others_fail_by_name(self):
        tally, told = tiers.Tally(), io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(told):
            (pathlib.Path(folder) / "CTestTestfile.cmake").write_text(TESTS)
            report = pathlib.Path(folder) / "report.xml"
            ctest = ["ctest", "--test-dir", folder, "--test-output-size-passed", "65536", "--output-junit", report]
            subprocess.run(ctest, stdout=subprocess.DEVNULL, check=False)
            tally.add_report(report)
        tally.skip(tiers.BARE_ROOT, "no root")
        self.assertEqual(tally.passed, 2)
        self.assertEqual(
            tally.failed,
            ["Bad.One", "Other.One: skipped, which nobody planned", "system.part: skipped, which nobody planned"],
        )
        self.assertEqual(tally.skipped, ["FullDisk.Any", "system.runs", f"{tiers.BARE_ROOT}: no root"])
        self.assertEqual(tally.ends, ["--- Bad.One, its last lines:\nwhat is wrong"])
        self.assertIn("skipped: FullDisk.Any (planned: a small disk is mounted", told.getvalue())

    def test_of_a_program_that_runs_whole_each_case_is_counted_and_its_death_is_a_failure(self):
        tally, told = tiers.Tally(), io.StringIO()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(told):
            home = pathlib.Path(folder)
            (home / "CTestTestfile.cmake").write_text(PROGRAMS)
            for program, cases in CASES.items():
                text = "".join(CASE.format(*case) for case in cases)
                (home / f"{program}.xml").write_text(f"<testsuites><testsuite>{text}</testsuite></testsuites>")
            report = home / "report.xml"
            ctest = ["ctest", "--test-dir", folder, "--output-junit", report]
            subprocess.run(ctest, stdout=subprocess.DEVNULL, check=False)
            tally.add_report(report, home)
        self.assertEqual(tally.passed, 4)
        skipped = "Suite.Five: skipped, which nobody planned"
        self.assertEqual(tally.failed, ["Suite.Four", skipped, "dying_tests", "silent_tests"])
        self.assertEqual(tally.ends[0], "--- Suite.Four, its last lines:\nwhat is wrong")


if __name__ == "__main__":
    unittest.main()
