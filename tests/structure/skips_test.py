"""./dev test counts a skip that is not in its list as a failure, whoever skips: ctest, GoogleTest, or a part of a test
of Python's."""
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TESTS = """
add_test("Good.One" "/bin/true")
add_test("FullDisk.Any" "/bin/sh" "-c" "exit 4")
add_test("Other.One" "/bin/sh" "-c" "exit 4")
set_tests_properties("FullDisk.Any" "Other.One" PROPERTIES SKIP_RETURN_CODE 4)
add_test("system.runs" "/bin/sh" "-c" "yes line | head -n 900; echo 'OK (skipped=1)'")
add_test("system.part" "/bin/sh" "-c" "yes line | head -n 900; echo 'OK (skipped=2, expected failures=1)'")
add_test("system.whole" "/bin/echo" "OK")
"""
# All of ./dev but its last line, which would do what it was called for.
COUNT = """
source <(head -n -1 dev)
ctest --test-dir "$1" --test-output-size-passed 65536 --output-junit "$1/report.xml" >/dev/null
count_report "$1/report.xml"
bare_root_reason() { skip_one "README's first command on a bare Debian 12" "no root"; }
bare_root_reason
echo "passed $PASSED failed $FAILED skipped $SKIPPED"
printf 'failed: %s\\n' "${FAILED_NAMES[@]}"
printf 'skipped: %s\\n' "${SKIPPED_NAMES[@]}"
"""


class Skips(unittest.TestCase):
    def test_planned_ones_are_counted_as_skipped_others_fail_by_name(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "CTestTestfile.cmake").write_text(TESTS)
            done = subprocess.run(
                ["bash", "-c", COUNT, "bash", folder], cwd=ROOT, capture_output=True, text=True, check=False
            )
        self.assertEqual(
            done.stdout.splitlines(),
            [
                "passed 2 failed 2 skipped 3",
                "failed: Other.One: skipped, which nobody planned",
                "failed: system.part: skipped, which nobody planned",
                "skipped: FullDisk.Any",
                "skipped: system.runs",
                "skipped: README's first command on a bare Debian 12: no root",
            ],
            done.stderr,
        )
        self.assertIn("skipped: FullDisk.Any (planned: a small disk is mounted", done.stderr)


if __name__ == "__main__":
    unittest.main()
