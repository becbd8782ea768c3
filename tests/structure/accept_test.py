"""That accept.py computes what it says: values of pages and JSON, limits, statuses, what is missing or has expired."""

import unittest

import accept
import acceptance
from requirements import Figure, Requirement, Tag

SECTIONS = {
    "runs": "`./dev numbers runs`, 2026-11-24 07:22 UTC, commit ac441f28, took 9 s.\n\n42 of 50 found.\n\n"
    "| kind | seed | s | N |\n| --- | --- | --- | --- |\n"
    "| nominal | 1 | 206.7 | 1 / 2 |\n| nominal | 2 | 210.1 | - |\n| worn | 1 | 222 | 1,234 / 7 |\n",
    "acceptance": "`./dev numbers acceptance`, 2026-11-25 08:00 UTC, commit 1234abc, took 9 s.\n\n"
    "| command | value | measured |\n| --- | --- | --- |\n| liana x | a.b | 7.5 |\n| liana x | c | - |\n",
}
TAGS = [Tag("A1", "tests/hil/a_test.cpp", "Arm.Bends"), Tag("A1", "tests/hil/a_test.cpp", "Arm.Rests")]


def entry(*figures, what="asked for", kind="T", tags=TAGS, deviations=(), expired=()):
    row = Requirement("A1", kind, what, "A: a source", [Figure(*figure) for figure in figures], list(deviations))
    return accept.entry_of(row, tags, SECTIONS, set(expired))


class Values(unittest.TestCase):
    def test_a_cell_is_found_by_row_column_and_place_in_the_cell(self):
        for where, value in {
            "nominal; 1 > s": 206.7,
            "*; 2 > s": 210.1,
            "max nominal > s": 210.1,
            "median nominal > s": 208.4,
            "worn > N": 1234,
            "worn > N #2": 7,
            r"~(\d+) of 50 found": 42,
        }.items():
            self.assertAlmostEqual(accept.value_in(SECTIONS["runs"], where), value, msg=where)

    def test_what_is_not_in_the_page_is_no_value(self):
        for where in ("nominal; 2 > N", "ideal > s", "nominal > m", r"~(\d+) lost"):
            self.assertIsNone(accept.value_in(SECTIONS["runs"], where), where)

    def test_keys_lead_to_a_value_of_json(self):
        document = {
            "a": {"b": 2},
            "steps": [{"name": "in", "s": -3, "held": [7, 9]}, {"name": "out", "s": 1, "held": []}],
        }
        for where, value in {
            "a.b x 1000": 2000,
            "steps.1.s": 1,
            "max abs steps.*.s": 3,
            "min steps.*.s": -3,
            "count steps.name=in.held.*": 2,
            "count steps.name=out.held.*": 0,
            "sum a.*": 2,
        }.items():
            self.assertEqual(acceptance.value_of(document, where), value, where)
        for where in ("b", "steps.*.s", "steps.name=on.s", "steps.name=in.held"):
            with self.assertRaises((LookupError, TypeError, ValueError), msg=where):
                acceptance.value_of(document, where)


class Limits(unittest.TestCase):
    def test_each_operator_keeps_its_bound(self):
        for text, inside, outside in (
            ("<= 3 s", 3, 3.01),
            ("< 3 s", 2.99, 3),
            (">= 25 Hz", 25, 24.9),
            ("> 0", 0.1, 0),
            ("= 142 +- 0.5 mm", 142.5, 142.6),
            ("= 15", 15, 15.1),
            (">= -0.1 J", -0.1, -0.2),
        ):
            self.assertTrue(accept.holds(accept.limit_of(text), inside), text)
            self.assertFalse(accept.holds(accept.limit_of(text), outside), text)

    def test_another_text_is_no_limit(self):
        for text in ("3 s", "<= s", "about 3 s", ""):
            with self.assertRaises(ValueError, msg=text):
                accept.limit_of(text)


class Statuses(unittest.TestCase):
    def test_a_value_within_its_limit_is_met_with_its_origin(self):
        found = entry(("time", "<= 8 s", "liana x", "a.b"))
        self.assertEqual((found["status"], found["deviation"]), (accept.MET, ""))
        self.assertEqual(
            (found["command"], found["commit"], found["date"]), ("build/bin/liana x", "1234abc", "2026-11-25")
        )
        self.assertEqual(found["figures"][0]["value"], 7.5)

    def test_a_value_beyond_its_limit_is_not_met_and_within_a_wider_one_deviates(self):
        self.assertEqual(entry(("time", "<= 7 s", "liana x", "a.b"))["status"], accept.NOT_MET)
        self.assertEqual(entry(("time", "<= 7 s", "liana x", "a.b", "<= 7.4 s: soft"))["status"], accept.NOT_MET)
        found = entry(("time", "<= 7 s", "liana x", "a.b", "<= 8 s: soft"))
        self.assertEqual((found["status"], found["figures"][0]["status"]), (accept.DEVIATES, accept.DEVIATES))

    def test_a_figure_that_nothing_measured_is_not_met(self):
        for figure in (
            ("c", "<= 8 s", "liana x", "c"),
            ("d", "<= 8 s", "liana y", "a.b"),
            ("e", "> 1", "gone", "a > b"),
        ):
            self.assertEqual(entry(figure)["status"], accept.NOT_MET, figure)

    def test_a_figure_that_has_expired_is_not_called_met(self):
        found = entry(("time", "<= 300 s", "runs", "max nominal > s"), expired=["runs"])
        self.assertEqual((found["status"], found["figures"][0]["expired"]), (accept.DEVIATES, True))
        self.assertEqual(entry(("time", "<= 300 s", "runs", "max nominal > s"))["status"], accept.MET)

    def test_a_statement_without_a_test_or_with_a_number_and_no_figure_is_not_met(self):
        self.assertEqual(entry(tags=[])["status"], accept.NOT_MET)
        self.assertEqual(entry(what="at least 25 Hz")["status"], accept.NOT_MET)
        self.assertEqual(entry(what="X5 comes first")["status"], accept.MET)
        self.assertEqual(entry(what="at least 25 Hz", kind="D", tags=[])["status"], accept.DEVIATES)

    def test_a_figure_may_be_one_that_a_test_of_the_statement_asserts(self):
        self.assertEqual(entry(("gap", "= 100 mm", "test", "Arm.Rests"))["status"], accept.MET)
        self.assertEqual(entry(("gap", "= 100 mm", "test", "Arm.Flies"))["status"], accept.NOT_MET)

    def test_what_differs_is_a_deviation_and_never_hides_what_is_not_met(self):
        self.assertEqual(entry(deviations=["no rig"])["status"], accept.DEVIATES)
        self.assertEqual(entry(deviations=["no rig"], tags=[])["status"], accept.NOT_MET)


class Pages(unittest.TestCase):
    def test_what_is_not_met_is_marked_and_listed_and_the_page_keeps_what_had_expired(self):
        made = accept.page([entry(tags=[])], [], {"runs", "archive"})
        self.assertIn("## Not met\n- A1: no test.\n", made)
        self.assertIn("| A1 | T | asked for | **not met** |  |\n", made)
        self.assertEqual(accept.expired_in(made), {"runs", "archive"})
        self.assertEqual(accept.expired_in(accept.page([entry()], TAGS, set())), set())


if __name__ == "__main__":
    unittest.main()
