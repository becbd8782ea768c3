"""The payload's installation as users run it: by its name alone, with faults by theirs, and what its report says."""
import json
import tempfile
import unittest
from pathlib import Path

from support import SOURCE, SystemTest
from liana import timeline
from liana.system import run

FIGURES = (
    "servo_error_m servo_error_deg settling_s lateral_sway_m force_rise_s force_N load_duration_s peak_joint_torque_Nm "
    "insertion_m unload_s base_deflection_m resisted_N margin_N end_force_N end_torque_Nm base_force_N base_torque_Nm"
).split()
WHOLE_FLIGHT_S = 900  # of wall time, where much else goes on
FAULTS = SOURCE / "lua" / "missions" / "payload_install" / "faults"
TIMELINE = SOURCE / "lua" / "missions" / "payload_timeline.json"


class Payload(SystemTest):
    """Flown by liana run, but for one from before the adapter on: seconds of wall time instead of minutes."""

    def flown(self, *words, scene="payload_at_adapter"):
        folder = tempfile.TemporaryDirectory(prefix="liana-payload-")
        self.addCleanup(folder.cleanup)
        self.report_file = Path(folder.name) / "report.json"
        words = ("payload_install", "--scene", scene, *words, "--json", self.report_file)
        done = run("liana", "run", *words, timeout=WHOLE_FLIGHT_S)
        return done, json.loads(self.report_file.read_text(encoding="utf-8"))

    def names(self, report):
        return [event["event"] for event in report["timeline"]]

    # req:B15 req:B21 req:B22 req:B25 req:B27
    def test_the_payload_is_captured_unloaded_and_locked_and_the_report_says_how(self):
        done, report = self.flown("--seed", "8002")
        self.assertEqual((done.returncode, report["outcome"], report["robot"]), (0, "success", "macro_micro"))
        for figure in FIGURES:
            self.assertIn(figure, report)
        self.assertIsNone(report["servo_error_m"], "no servo was needed")
        self.assertTrue(15 <= report["force_N"] <= 60, report["force_N"])
        self.assertTrue(0.0195 <= report["insertion_m"] <= 0.023, report["insertion_m"])
        self.assertLess(report["peak_joint_torque_Nm"], 100)
        self.assertLess(report["unload_s"], 5)
        order = [
            "force control begins",
            "set force 9.0",
            "contact",
            "set force 30.0",
            "captured",
            "set force 0",
            "latch closed",
            "lock closing",
            "lock closed",
        ]
        self.assertEqual([name for name in self.names(report) if name in order], order)
        times = [event["time_s"] for event in report["timeline"]]
        self.assertEqual(times, sorted(times))
        expected = json.loads(TIMELINE.read_text(encoding="utf-8"))
        rows = {row.event: row for row in timeline.compare(report, expected)}
        self.assertEqual([rows[event].fault for event in ("captured", "unloaded", "locked")], ["", "", ""])

    # req:B5 req:B6 req:B16
    def test_the_large_arm_carries_the_payload_from_the_mechanism_to_the_site_where_it_is_installed(self):
        words = ("--robot", "macro_micro_stiff", "--bus", "embedded_payload", "--seed", "8003")
        done, report = self.flown(*words, scene="payload_adapter")
        self.assertEqual((done.returncode, report["outcome"]), (0, "success"), report.get("reason"))
        (carried,) = [step for step in report["steps"] if step["name"] == "3 carried to the site"]
        self.assertTrue(60 <= carried["duration_s"] <= 61, carried)
        self.assertLess(report["servo_error_m"], 0.008)
        self.assertLess(report["lateral_sway_m"], 0.015)
        self.assertTrue(0.0195 <= report["insertion_m"] <= 0.023, report["insertion_m"])

    # req:B19 req:B26
    def test_a_push_that_begins_as_far_aside_as_the_funnels_take_and_jams_is_begun_again_aligned(self):
        words = ("--robot", "macro_micro_stiff", "--bus", "embedded_payload", "--seed", "181003")
        done, report = self.flown(*words, scene="payload_misaligned")
        self.assertEqual((done.returncode, report["outcome"]), (0, "success"), report.get("reason"))
        pushes = [step["outcome"] for step in report["steps"] if step["name"] == "3 push"]
        self.assertEqual(pushes, ["failed", "success"], "the first one jams")
        self.assertTrue(0.0195 <= report["insertion_m"] <= 0.023, report["insertion_m"])
        self.assertLess(report["peak_force_N"], 60)
        self.assertLess(report["peak_joint_torque_Nm"], 100)

    # req:B26
    def test_a_sensor_that_fails_while_it_pushes_ends_in_an_arm_that_holds(self):
        done, report = self.flown("--seed", "8002", "--fault", "sensor_failed")
        self.assertEqual((done.returncode, report["outcome"]), (1, "failed"))
        self.assertEqual([fault["number"] for fault in report["faults"]], [2004])
        self.assertTrue(report["ends_at_rest"])
        self.assertEqual(report["fault"]["name"], "sensor_failed")
        self.assertGreater(report["fault"]["begun_s"], 30)
        self.assertNotIn("captured", self.names(report))

    def flown_with(self, faults):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write(json.dumps(faults))
            file.flush()
            return self.flown("--seed", "8002", "--faults", file.name)

    # req:B19 req:B26
    def test_a_lock_that_stops_half_way_is_asked_again_and_what_the_adapter_says_twice_counts_once(self):
        names = ("lock_failed", "duplicate_capture")
        done, report = self.flown_with(
            [each for name in names for each in json.loads((FAULTS / f"{name}.json").read_text())]
        )
        self.assertEqual((done.returncode, report["outcome"]), (0, "success"), done.stderr)
        names = self.names(report)
        self.assertLess(names.index("lock failed"), names.index("lock closed"))
        outcomes = [step["outcome"] for step in report["steps"] if step["name"] == "3 lock"]
        self.assertEqual((outcomes[0], outcomes[-1]), ("failed", "success"))

    # req:B19 req:B26
    def test_a_latch_that_closes_while_the_arm_backs_off_is_not_pulled_at(self):
        late = {"kind": "depth_lies", "pin": 1, "depth_m": 0.01, "when": {"depth_above_m": 0.002}, "for_slots": 9600}
        done, report = self.flown_with([late])
        self.assertEqual((done.returncode, report["outcome"], report["faults"]), (1, "failed", []))
        self.assertEqual(
            (report["steps"][-1]["name"], report["steps"][-1]["outcome"]), ("3 away from the adapter", "failed")
        )
        self.assertTrue(report["ends_at_rest"])
        self.assertLess(report["max_joint_torque_Nm"], 100)

    def test_a_payload_for_an_arm_without_torque_drives_is_refused_before_anything_starts(self):
        for mission, robot in (("micro_reach", "micro"), ("lab_tour", "three_segment_lab")):
            done = run("liana", "run", mission, "--robot", robot, "--scene", "payload_at_adapter")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('drives.mode = "torque"', done.stderr)
            self.assertNotIn("liana-bench", done.stderr)

    def test_an_unknown_fault_is_refused_with_the_names_there_are(self):
        done = run("liana", "run", "payload_install", "--fault", "meteor")
        self.assertEqual(done.returncode, 2)
        self.assert_names(done.stderr, "--fault", "meteor", "base_moving")


if __name__ == "__main__":
    unittest.main()
