"""The mutations are what they say: lines are found once or refused, and every part of the safety code has some."""
import unittest

import mutation
from mutation import BadMutation, Edit, Mutation, changed


class Lines(unittest.TestCase):
    TEXT = "void f() {\n  if (a) b();\n  c();\n}\n"

    def test_a_line_is_changed_and_keeps_its_indentation(self):
        self.assertEqual(changed(self.TEXT, Edit("f.cpp", "c();", "d();")), "void f() {\n  if (a) b();\n  d();\n}\n")
        self.assertEqual(changed(self.TEXT, Edit("f.cpp", "c();", "")), "void f() {\n  if (a) b();\n\n}\n")

    def test_a_line_that_is_not_there_or_there_twice_is_refused(self):
        for line, count in (("c()", 0), ("b();", 0)):
            with self.assertRaisesRegex(BadMutation, f"is there {count} times"):
                changed(self.TEXT, Edit("f.cpp", line, ""))
        with self.assertRaisesRegex(BadMutation, "is there 2 times"):
            changed(self.TEXT + self.TEXT, Edit("f.cpp", "c();", ""))

    def test_a_scenario_that_does_not_exist_is_refused(self):
        known = mutation.mutations()[0]
        with self.assertRaisesRegex(BadMutation, "no scenario 40_faults/none"):
            mutation.check([Mutation("x", known.edits, (), ["40_faults/none"])], {})

    def test_a_test_that_does_not_exist_is_refused(self):
        known = mutation.mutations()[0]
        for name, words in (
            ("Gate.Nothing in core_tests", "no test Gate.Nothing"),
            ("A.B in nowhere", "nowhere is not"),
        ):
            with self.assertRaisesRegex(BadMutation, words):
                mutation.check([Mutation("x", known.edits, (), [name])], {})

    def test_the_benchs_truth_has_mutations_and_each_kind_of_finder_its_programs(self):
        of_bench = [one for one in mutation.mutations() if one.edits[0].file.startswith("hil/")]
        self.assertGreaterEqual(len(of_bench), 7)
        self.assertEqual(mutation.programs_for(of_bench), ["liana_hil_tests"])

    def test_watchdogs_conditions_and_gate_each_have_mutations_and_every_name_is_there_once(self):
        wanted = mutation.mutations()
        self.assertEqual(len({one.name for one in wanted}), len(wanted))
        files = [edit.file for one in wanted for edit in one.edits]
        for part in ("drive_link_monitor", "conditions", "faults", "supervisor", "gate"):
            self.assertGreaterEqual(files.count(f"firmware_like/safety/{part}.cpp"), 2, part)


if __name__ == "__main__":
    unittest.main(verbosity=2)
