"""The examples of docs/getting-started/python.md and docs/examples run as they stand there, and a system ends whatever
happens in its block.
"""
import contextlib
import io
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[4]
sys.path.insert(0, str(ROOT / "host" / "api" / "python"))

from liana import ProgramRefused, System  # noqa: E402


def examples_of(page):
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(), re.M | re.S)


FOLDER = ROOT / "docs" / "examples"
EXAMPLES, README = examples_of("docs/getting-started/python.md"), examples_of("README.md")


def said_by(example, **names):
    with contextlib.redirect_stdout(io.StringIO()) as said:
        exec(compile(example, "docs/getting-started/python.md", "exec"), names)
    return said.getvalue()


class Examples(unittest.TestCase):
    def test_a_whole_system_moves_the_arm_and_leaves_a_recording(self):
        self.assertRegex(said_by(EXAMPLES[0]), r"^\d{4,} ticks, ends \w+, moved [12]\.\d deg\n$")

    def test_what_the_readme_shows_moves_the_arm_and_says_where_it_is(self):
        self.assertEqual(said_by(README[0]), "theta 9 is at 10.0 deg\n")

    def test_the_smallest_example_reads_the_state(self):
        said = said_by((FOLDER / "01_read_state" / "read_state.py").read_text())
        self.assertRegex(said, r"^DISABLED at \d+\.\d\d s, joints at (-?\d+\.\d\d, ){9}-?\d+\.\d\d deg\n$")

    def test_the_second_example_moves_to_a_named_pose(self):
        said = said_by((FOLDER / "02_named_pose" / "named_pose.py").read_text())
        self.assertRegex(said, r"^ENABLED, largest error 0\.[01]\d deg after \d+ s\n$")

    def test_a_client_of_a_running_system_is_told_why_it_may_not_move_the_arm(self):
        with System() as system:
            system.client("watcher").step()
            self.assertRegex(said_by(EXAMPLES[1], api=system.api), r"^not_\w+ .+\n[A-Z]+ \[.*\]\n$")


class Ends(unittest.TestCase):
    def test_nothing_of_a_system_is_left_after_its_block_also_when_that_failed(self):
        with contextlib.redirect_stderr(io.StringIO()) as said:
            with self.assertRaisesRegex(ValueError, "of the block"):
                with System() as system:
                    children, directory = list(system.children.values()), system.directory
                    raise ValueError("of the block")
        self.assertEqual(len(children), 3)
        self.assertTrue(all(child.returncode is not None for child in children))
        self.assertFalse(directory.exists())
        self.assertIn("--- lianad", said.getvalue())

    def test_input_that_a_program_refuses_is_said_in_its_words(self):
        with contextlib.redirect_stderr(io.StringIO()):
            with self.assertRaisesRegex(ProgramRefused, "kind.*silnt"):
                with System(faults=[{"drive": 4, "kind": "silnt", "at_slot": 1}]) as system:
                    system.client().go_on(1.0)
        with self.assertRaisesRegex(ProgramRefused, "nosuch"):
            System(bus="nosuch").write_tables()


if __name__ == "__main__":
    unittest.main(verbosity=2)
