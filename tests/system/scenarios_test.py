"""The scenarios of hil/scenarios are judged by rules that can fail: each rule against traffic that breaks it, each
mistake in a scenario's file refused.
"""
import ast
import graphlib
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

from support import SCENARIOS, SOURCE
from message import Messages

import coverage
import predicates
import recorded_rules
import scenario
import torque_rules
import wire_checks
from liana.system import ProgramRefused, System
from run_scenario import LimitedRun
from scenario_file import BadScenario, Failed

PERIOD_S = 0.004


def imported_by(path):
    """Modules that a file imports, as paths; of `from package import x` also package/x."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (name.name.replace(".", "/") for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            package = node.module.replace(".", "/")
            yield package
            yield from (f"{package}/{name.name}" for name in node.names)


def traffic(commands=(), reports=()):
    """Node 4's (slot, controlword, target) and (slot, position) as liana-bus writes them."""
    lines = [
        f"({slot * PERIOD_S + 0.002:.6f}) can0 204#{struct.pack('<Hi', word, target).hex().upper()}"
        for slot, word, target in commands
    ]
    lines += [
        f"({slot * PERIOD_S + 0.001:.6f}) can0 184#{struct.pack('<Hih', 0x1237, place, 60).hex().upper()}"
        for slot, place in reports
    ]
    return predicates.Traffic(["\n".join(lines)], PERIOD_S)


TORQUE_ARM = {
    "kind": "serial",
    "drives": {"mode": "torque", "counts_per_turn": 360000},
    "joints": [{"rate_deg_s": 4.0}] * 7,
}


def torque_traffic(commands):
    """Node 4's (slot, controlword, torque, rate)."""
    return torque_rules.TorqueTraffic(
        [
            "\n".join(
                f"({slot * PERIOD_S + 0.002:.6f}) can0 204#{struct.pack('<Hhi', *words).hex().upper()}"
                for slot, *words in commands
            )
        ],
        PERIOD_S,
    )


class TorqueRules(unittest.TestCase):
    def told(self, *commands):
        return torque_rules.told(torque_traffic([(10, 0x0F, 0, 0), *commands]), TORQUE_ARM, PERIOD_S)

    def test_a_torque_may_change_as_quickly_as_its_ramp_and_no_quicker(self):
        self.assertEqual(self.told((11, 0x0F, 40, 0), (13, 0x0F, -40, 0)), [])
        found = self.told((11, 0x0F, 60, 0))
        self.assertEqual(len(found), 1)
        self.assertIn("drive 4 (node 4), slot 11", found[0])
        self.assertEqual(self.told((11, 0x06, 900, 0)), [], "a drive that is not enabled may be told anything")

    def test_no_more_than_the_rated_torque_and_no_rate_that_the_joint_cannot_have(self):
        up = [(10 + k, 0x0F, 40 * k, 0) for k in range(1, 26)]
        self.assertEqual(self.told(*up), [])
        self.assertEqual(len(self.told(*up, (36, 0x0F, 1040, 0))), 1)
        self.assertEqual(self.told((11, 0x0F, 0, 4700)), [])
        self.assertEqual(len(self.told((11, 0x0F, 0, -4900))), 1)

    def test_a_drive_that_is_told_to_turn_while_the_arm_holds_in_fault_is_found(self):
        still = torque_traffic([(20, 0x0F, 100, 30), (21, 0x0F, 100, -30)])
        turning = torque_traffic([(20, 0x0F, 100, 30), (21, 0x0F, 100, -50)])
        self.assertEqual(torque_rules.rates_while_latched(still, TORQUE_ARM, 20, 30), [])
        self.assertEqual(len(torque_rules.rates_while_latched(turning, TORQUE_ARM, 20, 30)), 1)
        self.assertEqual(torque_rules.rates_while_latched(turning, TORQUE_ARM, 22, 30), [])


class Rules(unittest.TestCase):
    def test_a_target_that_steps_too_far_is_found_with_node_and_slot(self):
        good = [(10, 0x0F, 1000), (11, 0x0F, 1030), (13, 0x0F, 1090)]
        self.assertEqual(predicates.target_steps(traffic(good), 36), [])
        found = predicates.target_steps(traffic(good + [(14, 0x0F, 1127)]), 36)
        self.assertEqual(len(found), 1)
        self.assertIn("drive 4 (node 4), slot 14", found[0])

    def test_a_target_of_a_drive_without_torque_may_follow_it_anywhere(self):
        self.assertEqual(
            predicates.target_steps(traffic([(10, 0x00, 1000), (11, 0x06, 9000), (12, 0x0F, 20000)]), 36), []
        )

    def test_the_step_limit_is_the_cable_speed_and_a_rounding(self):
        robot = {
            "drives": {"drum_radius_m": 0.015, "counts_per_turn": 65536, "gear": 1},
            "limits": {"cable_speed_m_s": 0.010},
        }
        self.assertAlmostEqual(predicates.step_limit_counts(robot, PERIOD_S), 29.8, 1)

    def test_enabling_while_the_fault_is_latched_is_found_and_after_the_operators_enable_it_is_not(self):
        commands = [(10, 0x0F, 0), (11, 0x00, 0), (20, 0x0F, 0), (30, 0x0F, 0)]
        self.assertEqual(len(predicates.enabling_without_clear(traffic(commands), 11, 30)), 1)
        self.assertEqual(predicates.enabling_without_clear(traffic(commands), 11, 20), [])
        self.assertEqual(
            predicates.enabling_without_clear(traffic([(10, 0x8F, 0)]), 0, 20), [], "a fault reset enables nothing"
        )

    def test_a_target_that_moves_while_the_arm_holds_in_fault_is_found(self):
        commands = [(10, 0x0F, 1000), (20, 0x0F, 1030), (21, 0x0F, 1031), (30, 0x0F, 1032)]
        self.assertEqual(predicates.targets_that_move(traffic(commands), 20, 30), [], "a count is rounding")
        self.assertEqual(len(predicates.targets_that_move(traffic(commands), 20, 31)), 1)
        self.assertEqual(
            predicates.targets_that_move(traffic([(20, 0x00, 5), (21, 0x00, 9)]), 20, 31),
            [],
            "without torque a target follows the drum",
        )

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


def frames(*steps):
    """Of node 4: reset, boot-up, SDO objects, start, operational, PDO."""
    of = {
        "reset": (0, 130, 4, None, None),
        "start": (0, 1, 0, None, None),
        "boot-up": (0x704, None, None, 0, None),
        "operational": (0x704, None, None, 5, None),
        "PDO": (0x184, None, None, None, None),
    }
    return [wire_checks.Frame(line, *of.get(step, (0x604, None, None, None, step))) for line, step in enumerate(steps)]


class BootOrder(unittest.TestCase):
    def test_the_order_of_cia_301_is_accepted_after_the_last_reset(self):
        self.assertEqual(
            wire_checks.boot_order(
                frames("boot-up", "reset", "reset", "boot-up", 0x1000, 0x1018, 0x1400, "start", "operational", "PDO"), 4
            ),
            [],
        )

    def test_each_step_out_of_order_is_found(self):
        for wrong, words in (
            (("boot-up", 0x1018, "start", "operational"), "no reset"),
            (("reset", 0x1018, "boot-up", "start", "PDO"), "boot-up, SDO"),
            (("reset", "boot-up", "PDO", 0x1018, "start"), "boot-up, SDO"),
            (("reset", "boot-up", 0x1018, "PDO", "start"), "boot-up, SDO"),
            (("reset", "boot-up", "start", 0x1018, "PDO"), "boot-up, SDO"),
            (("reset", "boot-up", 0x1400, 0x1018, "start", "PDO"), "0x1400"),
            (("reset", "boot-up", 0x1400, "start", "PDO"), "never read"),
        ):
            found = wire_checks.boot_order(frames(*wrong), 4)
            self.assertEqual(len(found), 1, wrong)
            self.assertIn(words, found[0])


class Wire(unittest.TestCase):
    def log(self, text):
        path = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "can0.log"
        path.write_text(text)
        return path

    def test_a_malformed_frame_is_found_and_what_is_no_log_refused(self):
        good = (
            "(0000000001.000000) can0 080#\n(0000000001.001000) can0 704#05\n(0000000001.002000) can0"
            " 20000004#0008000000008000\n"
        )
        self.assertEqual(self.malformed(good), [])
        self.assertIn("line 4", self.malformed(good + "(0000000001.003000) can0 604#4018\n")[0])
        with self.assertRaises(ValueError):
            self.malformed("nothing of the kind")

    def malformed(self, text):
        log = self.log(text)
        return wire_checks.malformed(log.name, wire_checks.decoded(log))

    def test_of_sync_and_pdos_the_first_of_each_length_after_every_nmt_command_is_decoded(self):
        frames = ("080#", "184#0102", "080#", "184#0304", "184#05", "204#00", "704#05", "704#05", "604#40", "604#40")
        lines = [f"(0000000001.{place:06}) can0 {frame}" for place, frame in enumerate((*frames, "000#0104", *frames))]
        self.assertEqual([place for place, _ in wire_checks.telling(lines)], [1, 2, *range(5, 14), *range(16, 22)])


class Modules(unittest.TestCase):
    def test_scenarios_import_only_each_other_the_client_and_pythons_own_and_never_in_a_circle(self):
        files = {path.relative_to(SCENARIOS).with_suffix("").as_posix(): path for path in SCENARIOS.rglob("*.py")}
        graph = {name: set(imported_by(path)) for name, path in files.items()}
        allowed = {name.split("/")[0] for name in files} | {"liana"} | sys.stdlib_module_names
        for name, modules in graph.items():
            self.assertEqual({module.split("/")[0] for module in modules} - allowed, set(), name)
        graphlib.TopologicalSorter({name: modules & files.keys() for name, modules in graph.items()}).prepare()


class Files(Messages, unittest.TestCase):
    GOOD = {
        "about": "x",
        "during": "move",
        "faults": [],
        "expect": {"fault": 3002, "index": 3, "within_ticks": 5, "state": "FAULT", "stopped_within_ticks": 9},
    }

    def read(self, **changed):
        return self.read_text(json.dumps({**self.GOOD, **changed}))

    def read_text(self, text):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        path = pathlib.Path(folder) / "one.json"
        path.write_text(text)
        return scenario.Scenario(path)

    def refused(self, *words, **changed):
        with self.assertRaises(BadScenario) as caught:
            self.read(**changed)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_a_good_file_is_read(self):
        self.assertEqual(self.read().expect["fault"], 3002)

    def test_a_number_beyond_all_is_refused_with_its_place_and_itself(self):
        for number in ("1e400", "-1e400", "NaN"):
            text = json.dumps({**self.GOOD, "faults": [{"kind": "a"}, {"at": [0, "HERE"]}]}).replace('"HERE"', number)
            with self.assertRaises(BadScenario) as caught:
                self.read_text(text)
            self.assert_names(str(caught.exception), "one.json", "faults[1].at[1]", number, "finite")

    def test_mistakes_are_refused_with_the_field(self):
        self.refused("durign", "not known", durign="move")
        self.refused("during", "flight", "boot, rest, move", during="flight")
        self.refused("faults", "wrong type", faults={})
        self.refused("fault is missing", expect={"state": "FAULT"})
        self.refused("within_ticks", expect={"fault": 3002, "state": "FAULT"})
        self.refused("stopped_within_ticks", expect={"fault": 3002, "state": "FAULT", "index": 3, "within_ticks": 5})
        self.refused(
            "within_ticks is -1", "0 to", expect={"fault": 3002, "state": "FAULT", "index": 3, "within_ticks": -1}
        )
        self.refused(
            "fault is 9999", "1001 to", expect={"fault": 9999, "state": "FAULT", "index": 3, "within_ticks": 1}
        )
        self.refused("state is SLEEPING", "FAULT", expect={"fault": None, "state": "SLEEPING"})
        self.refused("time_limit_s is -1", "86400", time_limit_s=-1)

    def test_a_start_is_told_to_lianad_and_bench(self):
        read = self.read(
            during="boot",
            start={"pose": "jig", "in_pose": "jig", "cross_wired": [3, 4]},
            expect={"fault": None, "state": "DISABLED", "refused": ["x"]},
        )
        self.assertEqual(
            read.words(),
            {
                "lianad": ["--in-pose", "jig"],
                "bench": ["--start-pose", "jig", "--jig", "--cross-wired", "3,4"],
            },
        )
        self.assertEqual(read.fault_count(), 1)
        self.assertEqual(self.read().words(), {"lianad": [], "bench": []})
        self.refused("start", "place", start={"place": "jig"})
        self.refused("refused", "boot", expect={"fault": None, "state": "DISABLED", "refused": ["x"]})

    def test_the_robot_is_one_that_scenarios_know_and_a_stop_is_of_an_arm_that_is_enabled(self):
        self.assertEqual((self.read().robot, self.read(robot="micro").robot), ("zhu2022", "micro"))
        self.assertEqual(self.read(stop_after_s=0.5).stop_after_s, 0.5)
        self.refused("robot is r2d2", "micro", robot="r2d2")
        self.refused("stop_after_s", "during", during="boot", stop_after_s=0.5)
        self.refused("stop_after_s is -1", "0 to 60", stop_after_s=-1)

    def test_a_fault_of_the_host_has_fields_of_its_own(self):
        read = self.read(host={"action": "kill", "program": "lianad"}, expect={"outcome": "drives_stop"})
        self.assertEqual((read.host["program"], read.fault_count()), ("lianad", 1))
        self.refused("expect", "fault", host={"action": "kill", "program": "lianad"})
        self.refused("program is missing", host={"action": "kill"}, expect={"outcome": "drives_stop"})

    def test_past_its_time_limit_a_scenario_has_failed_and_its_programs_are_dead(self):
        class Endless(LimitedRun):
            def act(self):
                with System() as system, self.limited(system):
                    self.system = system
                    system.client().until(lambda state: False, 1e9)

        run = Endless(self.read(time_limit_s=0.5))
        with self.assertRaises(Failed) as caught:
            run.go()
        self.assert_names(str(caught.exception), "time limit", "0.5 s")
        self.assertTrue(all(child.returncode is not None for child in run.system.children.values()))

    def test_what_the_bench_refuses_ends_a_scenario_with_its_words(self):
        run = self.read(faults=[{"drive": 4, "kind": "silnt", "at_slot": 1}]).run()
        with self.assertRaises(ProgramRefused) as caught:
            run.go()
        self.assert_names(str(caught.exception), "kind", "silnt")

    def test_every_fault_number_is_shown_by_a_scenario_or_a_test_as_the_page_says(self):
        numbers = sorted(recorded_rules.reactions_by_hand())
        shown = coverage.shown_by()
        self.assertGreater(len(numbers), 15)
        for number in numbers:
            self.assertTrue(
                shown[number] or number in coverage.TESTS, f"fault {number}: no scenario expects it; add one"
            )
        for name, file in coverage.TESTS.values():
            self.assertIn(f"{name.replace('.', ', ')})", (SOURCE / file).read_text())
        self.assertIn(
            coverage.table(numbers, {}),
            (SOURCE / "docs" / "reference" / "faults.md").read_text(),
            "put there what python3 hil/scenarios/coverage.py prints",
        )

    def test_every_folder_of_scenarios_says_what_it_is(self):
        folders = {SCENARIOS / one.name.split("/")[0] for one in scenario.all_scenarios()}
        self.assertGreaterEqual(len(folders), 5)
        for folder in folders:
            self.assertTrue((folder / "README.md").is_file(), folder)

    def test_a_pattern_without_a_scenario_and_a_file_that_cannot_be_written_end_with_2(self):
        for words, said in (
            (("--only", "nothing_like_it"), "names no scenario"),
            (("--json", "/no/such/folder/x"), "cannot be written"),
            (("--fast",), "--fast"),
        ):
            done = subprocess.run(
                [sys.executable, SCENARIOS / "run.py", *words], capture_output=True, text=True, check=False
            )
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
