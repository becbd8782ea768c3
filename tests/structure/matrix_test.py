"""That docs/development/requirements.md is a matrix of verifications: every statement once, with tests that are there.
"""

import pathlib
import re
import unittest

import requirements

ROW = re.compile(r"^\| (\w+) \| ([TSD]) \| (.*?) \| (.*?) ?\|$")
LINK = re.compile(r"\[[^\]]+\]\((?:\.\./){2}([^)]+)\)")


class Matrix(unittest.TestCase):
    # req:B23
    def test_every_statement_has_a_row_whose_tests_are_in_the_tree_or_is_listed_as_without(self):
        text = (requirements.ROOT / requirements.PAGE).read_text()
        rows = [match.groups() for match in map(ROW.match, text.splitlines()) if match]
        stated, _ = requirements.read_list((requirements.ROOT / requirements.LIST).read_text())
        self.assertEqual([row[0] for row in rows], [row.id for row in stated])
        without = set(re.findall(r"^- (\w+): ", text, re.M))
        for name, kind, _, tests in rows:
            files = LINK.findall(tests)
            self.assertEqual(name in without, kind != "D" and not files, name)
            for file in files:
                self.assertTrue(pathlib.Path(requirements.ROOT, file).is_file(), f"{name}: {file}")


if __name__ == "__main__":
    unittest.main()
