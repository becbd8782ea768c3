"""That requirements.py finds what it has to find: each case plants a list and tests in a small tree."""

import pathlib
import tempfile
import unittest

import requirements

LIST = "## A: a source\nA1   D  context\nA2   T  what is asked for\nA3   S  more\n## B: another\nB1   T  one | two\n"
CPP = "// What is tested.\n#include <x>\n\n// Why.\n// req:A2 req:A3\nTEST_F(Arm,\n       Bends) {\n}\n"


def tags(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return requirements.read_tags(pathlib.Path(folder))


class List(unittest.TestCase):
    def test_a_row_has_id_kind_words_and_source(self):
        rows, problems = requirements.read_list(LIST)
        self.assertEqual(problems, [])
        self.assertEqual(rows[1], ("A2", "T", "what is asked for", "A: a source", [], []))
        self.assertEqual(rows[3].source, "B: another")

    def test_an_id_that_is_there_twice_is_found_with_its_line(self):
        self.assertEqual(
            requirements.read_list(LIST + "A2 T again\n")[1],
            ["tests/structure/requirements.txt:7: A2 is there twice; leave one"],
        )

    def test_a_row_without_words_or_of_another_kind_is_found(self):
        self.assertIn(":1: must be", requirements.read_list("A1 D\n")[1][0])
        self.assertIn(":1: must be", requirements.read_list("A1 X what\n")[1][0])

    def test_figures_and_deviations_belong_to_the_statement_above(self):
        text = (
            "@cross liana run x\n"
            + LIST
            + "   = time | <= 9 s | @cross | duration_s\n     | <= 12 s: why\n   ~ not all of it\n"
        )
        rows, problems = requirements.read_list(text)
        self.assertEqual(problems, [])
        self.assertEqual(rows[3].figures, [("time", "<= 9 s", "liana run x", "duration_s", "<= 12 s: why")])
        self.assertEqual(rows[3].deviations, ["not all of it"])
        self.assertEqual(rows[2].figures, [])

    def test_a_figure_with_too_few_parts_or_an_unknown_command_is_found(self):
        self.assertIn(":1: stands below no requirement", requirements.read_list("= a | b | c | d\n")[1][0])
        self.assertIn(":7: a figure has 4 or 5 parts", requirements.read_list(LIST + "= a | b\n")[1][0])
        self.assertIn(":7: @c stands for no command", requirements.read_list(LIST + "= a | b | @c | d\n")[1][0])

    def test_the_list_of_the_tree_is_good(self):
        rows, problems = requirements.read_list((requirements.ROOT / requirements.LIST).read_text())
        self.assertEqual(problems, [])
        self.assertEqual(len(rows), 103)


class Tags(unittest.TestCase):
    def test_tags_above_a_test_are_that_tests(self):
        self.assertEqual(
            tags({"tests/a/b_test.cpp": CPP})[0],
            [("A2", "tests/a/b_test.cpp", "Arm.Bends"), ("A3", "tests/a/b_test.cpp", "Arm.Bends")],
        )

    def test_every_kind_of_test_has_its_name(self):
        found, problems = tags(
            {
                "hil/x_test.py": "import os\n# req:A2\nclass Arm(unittest.TestCase):\n    # req:A3\n    def test_it(self):\n",
                "tests/page/y_test.ts": "import x;\n// req:A2\ntest('it\\'s so, \"here\"', () => {\n",
            }
        )
        self.assertEqual(problems, [])
        self.assertEqual([tag.test for tag in found], ["Arm", "test_it", 'it\'s so, "here"'])

    def test_tags_at_the_head_of_a_file_are_those_of_the_whole_file(self):
        found, problems = tags(
            {
                "tests/a_test.cpp": "// About this\n// (req:A2).\n#include <x>\n",
                "tests/a_test.py": '"""About this\n\n(req:A2)."""\nimport x\n',
                "tests/b_test.py": '"""About this (req:A2)."""\nimport x\n',
            }
        )
        self.assertEqual((problems, [tag.test for tag in found]), ([], ["", "", ""]))

    def test_a_scenario_is_tagged_in_what_it_is_about(self):
        self.assertEqual(
            tags({"hil/scenarios/s.json": '{\n "about": "Full. (req:A2)"\n}\n'})[0],
            [("A2", "hil/scenarios/s.json", "")],
        )

    def test_a_tag_above_no_test_is_found(self):
        text = "#include <x>\n// req:A2\nint helper();\n"
        self.assertEqual(
            tags({"tests/a.cpp": text})[1], ["tests/a.cpp:2: req:A2 stands above no test; put it directly above one"]
        )
        self.assertEqual(len(tags({"tests/a.py": '"""About."""\nimport x  # req:A2\n'})[1]), 1)
        self.assertEqual(len(tags({"tests/a.py": "import x\n# req:A2\ndef helper():\n"})[1]), 1)

    def test_a_tag_with_an_unknown_id_is_found(self):
        rows, _ = requirements.read_list(LIST)
        found, _ = tags({"tests/a_test.cpp": "#include <x>\n// req:A9\nTEST(Arm, Bends) {\n"})
        self.assertIn("tests/a_test.cpp: req:A9: no such id", requirements.unknown(rows, found)[0])


if __name__ == "__main__":
    unittest.main()
