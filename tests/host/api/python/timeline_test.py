"""A run's report beside an expected timeline."""
import json
import pathlib
import re
import sys
import unittest

from liana.timeline import compare, main, step_times, text

ROOT = pathlib.Path(__file__).resolve().parents[4]
sys.path.append(str(ROOT / "tests"))  # message.py

from message import Messages  # noqa: E402

TIMELINE = {
    "zero": "servo begins",
    "events": [
        {"event": "servo begins", "step": "servo", "edge": "begin", "flight_s": 0},
        {
            "event": "servo ends",
            "step": "servo",
            "edge": "end",
            "flight_s": 40,
            "after": "servo begins",
            "within_s": [25, 45],
        },
        {
            "event": "captured",
            "step": "push",
            "edge": "end",
            "flight_s": 311,
            "after": "servo ends",
            "within_s": [5, 300],
        },
    ],
}


def report(*steps):
    """A report of steps (name, duration, outcome)."""
    return {"steps": [{"name": name, "duration_s": time_s, "outcome": how} for name, time_s, how in steps]}


class Timeline(Messages, unittest.TestCase):
    """Rows of the comparison."""

    def test_a_run_within_its_times_has_no_fault(self):
        rows = compare(
            report(("prepare", 5.0, "success"), ("servo", 31.0, "success"), ("push", 8.0, "success")), TIMELINE
        )
        self.assertEqual([row.fault for row in rows], ["", "", ""])
        self.assertEqual([row.ours_s for row in rows], [0.0, 31.0, 39.0])
        self.assertIn("| servo ends | 40.0 | 31.0 | 31.0 after servo begins |  |", text(rows))

    def test_what_took_too_long_or_never_was_is_said(self):
        rows = compare(report(("servo", 50.0, "success"), ("push", 8.0, "failed")), TIMELINE)
        self.assert_names(rows[1].fault, "50.0 s", "25", "45")
        self.assert_names(rows[2].fault, "push")

    def test_of_a_step_that_was_tried_again_the_try_that_succeeded_counts(self):
        tried = report(("servo", 20.0, "failed"), ("back off", 4.0, "success"), ("servo", 30.0, "success"))
        self.assertEqual(step_times(tried)["servo"], (24.0, 54.0))

    def test_an_order_that_is_not_the_flights_is_a_fault(self):
        rows = compare(report(("push", 8.0, "success"), ("servo", 31.0, "success")), TIMELINE)
        self.assertTrue(rows[2].fault)

    def test_a_file_that_is_no_report_is_bad_input(self):
        self.assertEqual(main([str(ROOT / "README.md"), str(ROOT / "README.md")]), 2)
        self.assertEqual(main([]), 2)

    # req:B27
    def test_the_payloads_timeline_names_steps_of_its_mission_and_events_of_its_own(self):
        timeline = json.loads((ROOT / "lua/missions/payload_timeline.json").read_text(encoding="utf-8"))
        mission = (ROOT / "lua/missions/payload_install.lua").read_text(encoding="utf-8")
        known = set()
        for event in timeline["events"]:
            self.assertIn(f'step "{event["step"]}"', mission)
            self.assertIn(event["edge"], ("begin", "end"))
            if "after" in event:
                self.assertIn(event["after"], known)
                self.assertLess(*event["within_s"])
            known.add(event["event"])
        self.assertIn(timeline["zero"], known)

    # req:B5
    def test_the_payloads_mission_goes_through_four_phases_in_their_order(self):
        mission = (ROOT / "lua/missions/payload_install.lua").read_text(encoding="utf-8")
        phases = [int(digit) for digit in re.findall(r'^  step "(\d) ', mission, re.M)]
        self.assertEqual(phases, sorted(phases))
        self.assertEqual(sorted(set(phases)), [1, 2, 3, 4])
        ways = re.findall(r'step = "(\d) ', mission)
        self.assertTrue(ways)
        self.assertEqual(set(ways), {"3"}, "retries stay within the operations of the arms")


if __name__ == "__main__":
    unittest.main()
