"""hil/scenarios/soak.py: its rule of memory finds what grows and lets other memory pass; an arm minute of it runs."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from support import SCENARIOS

import soak

SOAK = str(SCENARIOS / "soak.py")


def samples(hours, kB_of):
    """One each arm minute."""
    return [(minute / 60, kB_of(minute / 60)) for minute in range(int(60 * hours) + 1)]


class Memory(unittest.TestCase):
    def test_the_slope_of_a_line_is_found_exactly(self):
        slope, error = soak.slope_of([(0, 10), (1, 12), (2, 14), (4, 18)])
        self.assertAlmostEqual(slope, 2)
        self.assertAlmostEqual(error, 0)

    def test_scatter_alone_does_not_grow_and_a_slope_beside_it_does(self):
        for slope, grows in (0, False), (0.9, False), (3, True), (-3, False):
            points = samples(24, lambda hours: 5000 + slope * hours + 4 * (round(60 * hours) % 2))
            row = soak.judge_memory(points, 24)
            self.assertIs(row["grows"], grows, row)

    def test_growth_of_the_first_hour_does_not_count_nor_of_a_short_soak_the_first_quarter(self):
        for hours, settled in (24, 1.0), (1, 0.25):
            row = soak.judge_memory(samples(hours, lambda at: 5000 - 900 * max(0, settled - at)), hours)
            self.assertIs(row["grows"], False, row)
            self.assertLess(row["first_kB"], row["last_kB"])

    def test_a_few_samples_are_not_judged(self):
        self.assertIsNone(soak.judge_memory(samples(0.1, lambda at: 1e6 * at), 0.1)["grows"])

    def test_faults_depend_on_the_seed_alone_and_lie_within_the_time(self):
        lists = [soak.fault_list(soak.random.Random(seed), 7200) for seed in (1, 1, 2)]
        self.assertEqual(lists[0], lists[1])
        self.assertNotEqual(lists[0], lists[2])
        self.assertTrue(all(0 < fault["at_slot"] < 7200 * soak.SLOTS_PER_S for fault in lists[0]))


class Command(unittest.TestCase):
    def test_hours_that_are_none_end_with_2(self):
        for words in [], ["--hours", "0"], ["--hours", "x"], ["--hours", "1", "--json", "/nowhere/x.json"]:
            done = subprocess.run([sys.executable, SOAK, "--check", *words], capture_output=True, check=False)
            self.assertEqual(done.returncode, 2, words)

    def test_an_arm_minute_leaves_a_whole_archive_and_nothing_else(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "soak.json")
            done = subprocess.run(
                [sys.executable, SOAK, "--hours", "0.016", "--json", file], capture_output=True, text=True, check=False
            )
            result = json.loads(file.read_text())
        self.assertEqual((done.returncode, result["problems"]), (0, []), done.stdout + done.stderr)
        self.assertTrue(result["archives"][0]["whole"])
        self.assertEqual({row["program"] for row in result["memory"]}, set(soak.LONG_LIVED))


if __name__ == "__main__":
    unittest.main()
