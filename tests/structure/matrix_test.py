"""That docs/acceptance.md is a matrix of verifications: every statement once, with tests that are there."""

import pathlib
import re
import unittest

import accept
import requirements

ROW = re.compile(r"^\| (\w+) \| ([TSD]) \| (.*?) \| (\**[a-z ]+\**) \| (.*?) ?\|$")
LINK = re.compile(r"\[[^\]]+\]\(\.\./([^)]+)\)")


class Matrix(unittest.TestCase):
    # req:B23
    def test_every_statement_has_a_row_whose_tests_are_in_the_tree_or_is_not_met(self):
        text = (requirements.ROOT / accept.PAGE).read_text()
        rows = [match.groups() for match in map(ROW.match, text.splitlines()) if match]
        stated, _ = requirements.read_list((requirements.ROOT / requirements.LIST).read_text())
        self.assertEqual([row[0] for row in rows], [row.id for row in stated])
        for name, kind, _, status, tests in rows:
            files = LINK.findall(tests)
            self.assertTrue(files or kind == "D" or status == f"**{accept.NOT_MET}**", name)
            for file in files:
                self.assertTrue(pathlib.Path(requirements.ROOT, file).is_file(), f"{name}: {file}")


if __name__ == "__main__":
    unittest.main()
