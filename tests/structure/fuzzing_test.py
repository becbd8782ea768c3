"""./dev test names the fuzz target in which something was found, and does not pass where none ran; ./dev numbers fuzz
replaces the rows of the targets that it measured, and no others."""

import contextlib
import io
import pathlib
import subprocess
import sys
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/numbers"), str(ROOT / "tests")]
import fuzz
import tiers


def stage(said, planted=1):
    """What the stage counts when the targets say so, and the planted one ends with that code."""
    answers = iter([subprocess.CompletedProcess([], planted, ""), subprocess.CompletedProcess([], 0, said)])
    tally = tiers.Tally()
    with unittest.mock.patch.object(tiers, "TALLY", tally), contextlib.redirect_stderr(io.StringIO()):
        tiers.fuzzing(lambda *options: next(answers))
    return tally.passed, tally.failed


class Fuzzing(unittest.TestCase):
    def test_what_was_found_fails_by_the_targets_name(self):
        said = "good api 5 executions in 10 s\nfailed mcap 3 executions in 1 s: overflow: build/fuzz/mcap.log\n"
        self.assertEqual(
            stage(said),
            (2, ["fuzzing mcap: 3 executions in 1 s: overflow: build/fuzz/mcap.log"]),
        )

    def test_a_fuzzer_that_finds_no_planted_bug_fails(self):
        for code in (0, 2):
            self.assertEqual(stage("good api 5\n", code), (1, ["the fuzzer finds a planted bug"]))

    def test_no_target_at_all_fails(self):
        self.assertEqual(stage(""), (1, ["fuzzing: no target ran"]))


class Rows(unittest.TestCase):
    def test_those_of_other_targets_stay_and_those_of_targets_that_are_gone_do_not(self):
        def result(name, executions):
            return {"name": name, "bytes": 256, "executions": executions, "seconds": 2.0, "again": 7, "found": None}

        with unittest.mock.patch("targets.targets", return_value=["api", "link"]):
            before = fuzz.text_of([result("api", 100), result("link", 200)], "")
            gone = before.replace("| link |", "| went |")
            after = fuzz.text_of([result("api", 300)], before)
            rows = [line.split(" | ")[:5] for line in after.splitlines() if line.startswith("| ")][2:]
            self.assertEqual(rows, [["| api", "256", "300", "2", "150"], ["| link", "256", "200", "2", "100"]])
            self.assertNotIn("went", fuzz.text_of([result("api", 300)], gone))


if __name__ == "__main__":
    unittest.main()
