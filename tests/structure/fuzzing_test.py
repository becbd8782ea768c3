"""./dev test names the fuzz target in which something was found, and does not pass where none ran; ./dev numbers fuzz
replaces the rows of the targets that it measured, and no others."""
import pathlib
import subprocess
import sys
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/numbers"))
import fuzz

# All of ./dev but its last line, with targets that say what the test wants.
STAGE = """
source <(head -n -1 dev)
python3() {
  [[ $* != *planted* ]] || return "$PLANTED"
  printf "$SAID"
}
stage "fuzzing" fuzzing >/dev/null 2>&1
echo "passed $PASSED failed $FAILED"
printf 'failed: %s\\n' "${FAILED_NAMES[@]}"
"""


def stage(said, planted="1"):
    done = subprocess.run(
        ["bash", "-c", STAGE],
        cwd=ROOT,
        env={"PATH": "/usr/bin:/bin", "SAID": said, "PLANTED": planted},
        capture_output=True,
        text=True,
        check=False,
    )
    return [line for line in done.stdout.splitlines() if line != "failed: "]


class Fuzzing(unittest.TestCase):
    def test_what_was_found_fails_by_the_targets_name(self):
        said = r"good api 5 executions in 10 s\nfailed mcap 3 executions in 1 s: overflow: build/fuzz/mcap.log\n"
        self.assertEqual(
            stage(said),
            ["passed 2 failed 1", "failed: fuzzing mcap: 3 executions in 1 s: overflow: build/fuzz/mcap.log"],
        )

    def test_a_fuzzer_that_finds_no_planted_bug_fails(self):
        for code in ("0", "2"):
            self.assertEqual(
                stage(r"good api 5\n", code), ["passed 1 failed 1", "failed: the fuzzer finds a planted bug"]
            )

    def test_no_target_at_all_fails(self):
        self.assertEqual(stage(""), ["passed 1 failed 1", "failed: fuzzing: no target ran"])


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


class Names(unittest.TestCase):
    def test_what_follows_fuzz_has_to_be_a_target_even_where_a_section_has_that_name(self):
        done = subprocess.run([ROOT / "dev", "numbers", "fuzz", "golden"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("fuzz golden: no such target; one of: api bench", done.stderr)


if __name__ == "__main__":
    unittest.main()
