"""Every program of unit tests is run by ./dev test: with sanitizers, or by its name in UNSANITIZED of tests/tiers.py. What only
calls gtest_discover_tests would be built by neither, and nobody would notice."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
import tiers


def called(function):
    """What the lists of tests give that function first."""
    lists = (ROOT / "tests").rglob("CMakeLists.txt")
    return {name for path in lists for name in re.findall(rf"^\s*{function}\((\w+)", path.read_text(), re.M)}


class UnitTests(unittest.TestCase):
    def test_no_program_of_unit_tests_is_left_out(self):
        by_name = set(tiers.UNSANITIZED)
        self.assertGreater(len(called("add_unit_tests")), 30)
        self.assertEqual(called("gtest_discover_tests") - by_name, set())
        self.assertEqual(by_name - called("add_executable"), set())


if __name__ == "__main__":
    unittest.main()
