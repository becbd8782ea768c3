"""The mission feeder_box on the simulated arm: in through the hole, around two corners, back out."""
import json
import pathlib
import sys
import tempfile
import unittest

from programs import liana
from message import Messages


class FeederBox(Messages, unittest.TestCase):
    def run_mission(self, *options):
        with tempfile.TemporaryDirectory(prefix="liana-test-") as folder:
            report = pathlib.Path(folder) / "report.json"
            code, _, error = liana("run", "feeder_box", *options, "--json", report)
            return code, json.loads(report.read_text(encoding="utf-8")), error

    def test_it_goes_in_around_two_corners_and_back_out_without_touching_the_box(self):
        code, report, error = self.run_mission("--seed=11")
        self.assertEqual(code, 0, error)
        self.assertEqual([step["outcome"] for step in report["steps"]], ["success"] * 3)
        self.assertGreater(report["min_clearance_m"], 0.005)

    def test_the_tour_for_a_tracker_is_for_arms_on_a_base_too(self):
        code, _, error = liana("check", "tracker_tour", "--robot", "feeder", "--scene", "none", timeout_s=900)
        self.assertEqual(code, 0, error)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
