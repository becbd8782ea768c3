"""./dev test names the fuzz target in which something was found, and does not pass where none ran."""
import pathlib
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
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


if __name__ == "__main__":
    unittest.main()
