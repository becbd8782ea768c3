"""The scenarios of hil/scenarios are judged by rules that can fail: each rule against traffic that breaks it, each mistake in a scenario's file refused."""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

from liana_system import SOURCE

FOLDER = SOURCE / "hil" / "scenarios"
sys.path.insert(0, str(FOLDER))

import predicates  # noqa: E402
import scenario  # noqa: E402

kPeriod_s = 0.004


def traffic(commands=(), reports=()):
    """Node 4's (slot, controlword, target) and (slot, position) as liana-bus writes them."""
    lines = [f"({slot * kPeriod_s + 0.002:.6f}) can0 204#{struct.pack('<Hi', word, target).hex().upper()}" for slot, word, target in commands]
    lines += [f"({slot * kPeriod_s + 0.001:.6f}) can0 184#{struct.pack('<Hih', 0x1237, place, 60).hex().upper()}" for slot, place in reports]
    return predicates.Traffic(["\n".join(lines)], kPeriod_s)


class Rules(unittest.TestCase):
    def test_a_target_that_steps_too_far_is_found_with_node_and_slot(self):
        good = [(10, 0x0F, 1000), (11, 0x0F, 1030), (13, 0x0F, 1090)]
        self.assertEqual(predicates.target_steps(traffic(good), 36), [])
        found = predicates.target_steps(traffic(good + [(14, 0x0F, 1127)]), 36)
        self.assertEqual(len(found), 1)
        self.assertIn("node 4, slot 14", found[0])

    def test_a_target_of_a_drive_without_torque_may_follow_it_anywhere(self):
        self.assertEqual(predicates.target_steps(traffic([(10, 0x00, 1000), (11, 0x06, 9000), (12, 0x0F, 20000)]), 36), [])

    def test_the_step_limit_is_the_cable_speed_with_the_gates_margin(self):
        robot = {"drives": {"drum_radius_m": 0.015, "counts_per_turn": 65536, "gear": 1}, "limits": {"cable_speed_m_s": 0.010}}
        self.assertAlmostEqual(predicates.step_limit_counts(robot, kPeriod_s), 36.8, 1)

    def test_enabling_while_the_fault_is_latched_is_found_and_after_the_operators_enable_it_is_not(self):
        commands = [(10, 0x0F, 0), (11, 0x00, 0), (20, 0x0F, 0), (30, 0x0F, 0)]
        self.assertEqual(len(predicates.enabling_without_clear(traffic(commands), 11, 30)), 1)
        self.assertEqual(predicates.enabling_without_clear(traffic(commands), 11, 20), [])
        self.assertEqual(predicates.enabling_without_clear(traffic([(10, 0x8F, 0)]), 0, 20), [], "a fault reset enables nothing")

    def test_a_target_that_moves_while_the_arm_holds_in_fault_is_found(self):
        commands = [(10, 0x0F, 1000), (20, 0x0F, 1030), (21, 0x0F, 1030), (30, 0x0F, 1031)]
        self.assertEqual(predicates.targets_that_move(traffic(commands), 20, 30), [])
        self.assertEqual(len(predicates.targets_that_move(traffic(commands), 20, 31)), 1)
        self.assertEqual(predicates.targets_that_move(traffic([(20, 0x00, 5), (21, 0x00, 9)]), 20, 31), [], "without torque a target follows the drum")

    def test_a_drum_that_moves_while_the_fault_is_latched_is_found(self):
        reports = [(10, 100), (11, 150), (12, 151), (13, 151), (20, 180)]
        self.assertEqual(predicates.drums_that_move(traffic(reports=reports), 11, 20), [])
        self.assertEqual(len(predicates.drums_that_move(traffic(reports=reports), 11, 21)), 1)
        self.assertEqual(predicates.drums_that_move(traffic(reports=reports), 11, 21, left_out=[4]), [])

    def test_a_drive_with_torque_while_the_fault_is_latched_is_found(self):
        self.assertEqual(predicates.drives_with_torque([15, 15, 0, 0, 15], 2, 4), [])
        self.assertEqual(len(predicates.drives_with_torque([15, 15, 0, 1, 15], 2, 4)), 1)

    def test_a_number_that_is_none_is_found(self):
        self.assertEqual(predicates.numbers_that_are_none([(1.0, 2.0)]), [])
        self.assertEqual(len(predicates.numbers_that_are_none([(1.0, 2.0), (float("nan"), 2.0)])), 1)


class Files(unittest.TestCase):
    GOOD = {"about": "x", "during": "move", "faults": [], "expect": {"fault": 3002, "index": 3, "within_ticks": 5, "state": "FAULT", "stopped_within_ticks": 9}}

    def read(self, **changed):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        path = pathlib.Path(folder) / "one.json"
        path.write_text(json.dumps({**self.GOOD, **changed}))
        return scenario.Scenario(path)

    def refused(self, *words, **changed):
        with self.assertRaises(scenario.BadScenario) as caught:
            self.read(**changed)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_a_good_file_is_read(self):
        self.assertEqual(self.read().expect["fault"], 3002)

    def test_mistakes_are_refused_with_the_field(self):
        self.refused("durign", "not known", durign="move")
        self.refused("during", "flight", "boot, rest, move", during="flight")
        self.refused("faults", "wrong type", faults={})
        self.refused("fault is missing", expect={"state": "FAULT"})
        self.refused("within_ticks", expect={"fault": 3002, "state": "FAULT"})
        self.refused("stopped_within_ticks", expect={"fault": 3002, "state": "FAULT", "index": 3, "within_ticks": 5})

    def test_every_folder_of_scenarios_says_what_it_is(self):
        folders = {FOLDER / one.name.split("/")[0] for one in scenario.all_scenarios()}
        self.assertGreaterEqual(len(folders), 5)
        for folder in folders:
            self.assertTrue((folder / "README.md").is_file(), folder)

    def test_a_pattern_without_a_scenario_and_a_file_that_cannot_be_written_end_with_2(self):
        for words, said in ((("--only", "nothing_like_it"), "names no scenario"), (("--json", "/no/such/folder/x"), "cannot be written"), (("--fast",), "--fast")):
            done = subprocess.run([sys.executable, FOLDER / "run.py", *words], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
