"""The examples of docs/getting-started/python.md and docs/examples run as they stand there, and a system ends whatever
happens in its block.
"""
import contextlib
import io
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[4]
sys.path.insert(0, str(ROOT / "host" / "api" / "python"))

from liana import BenchEnvironment, LianaError, ProgramRefused, System, system  # noqa: E402


def examples_of(page):
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(), re.M | re.S)


FOLDER = ROOT / "docs" / "examples"
NOTEBOOK = FOLDER / "07_notebook" / "notebook.py"
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

    def test_a_recording_has_its_period_and_torques(self):
        self.assertRegex(said_by(EXAMPLES[2]), r"^0\.004 -?\d+ \d\d\n$")

    def test_the_environment_of_the_page_tells_how_far_the_goal_is(self):
        said = re.fullmatch(r"(0\.\d+) m to go, reward -(0\.\d+)\n", said_by(EXAMPLES[4]))
        self.assertEqual(said[1], said[2])

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


def python_with(*modules):
    """The interpreter that has these modules: the one that runs, else Debian's."""
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", f"import {', '.join(modules)}"], capture_output=True).returncode == 0:
            return python
    raise AssertionError(f"no Python has {', '.join(modules)}: install python3-numpy and python3-matplotlib")


class Notebook(unittest.TestCase):
    def run_it(self, *words):
        """The notebook, or what else `words` end with, in a folder of its own: how it ended, and the folder."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        package = str(ROOT / "host" / "api" / "python")
        environment = {**os.environ, "MPLCONFIGDIR": str(folder), "PYTHONPATH": package}
        call = [python_with("numpy", "matplotlib"), *(words or [NOTEBOOK])]
        return subprocess.run(call, cwd=folder, capture_output=True, text=True, check=False, env=environment), folder

    def test_the_cells_move_the_arm_and_draw_its_tensions_in_newtons(self):
        done, folder = self.run_it()
        self.assertEqual(done.returncode, 0, done.stderr)
        said = re.fullmatch(
            r"(\d+) ticks of 4 ms, 15 cables\nlargest tension by torque (\d+) N, in the simulator (\d+) N\n"
            r"goal reached: True, [\d.]+ mm .*\ntensions.png is written\n",
            done.stdout,
        )
        self.assertTrue(said, done.stdout)
        self.assertGreater(int(said[1]), 1000)
        self.assertLess(abs(int(said[2]) - int(said[3])), 0.1 * int(said[3]))
        self.assertEqual((folder / "tensions.png").read_bytes()[:4], b"\x89PNG")

    def test_the_plot_of_the_page_has_the_tensions_in_newtons(self):
        done, folder = self.run_it("-c", EXAMPLES[3])
        said = re.fullmatch(r"(\d+) N at most, in tensions.png\n", done.stdout)
        self.assertTrue(said, done.stdout + done.stderr)
        self.assertTrue(30 < int(said[1]) < 150)
        self.assertEqual((folder / "tensions.png").read_bytes()[:4], b"\x89PNG")

    def test_without_matplotlib_it_says_what_to_install(self):
        hidden = "import sys, runpy; sys.modules['matplotlib'] = None; runpy.run_path(sys.argv[1], run_name='__main__')"
        done, folder = self.run_it("-c", hidden, NOTEBOOK)
        self.assertEqual((done.returncode, list(folder.glob("*.png"))), (1, []), done.stderr)
        self.assertIn("python3-matplotlib", done.stderr)


class Robots(unittest.TestCase):
    def test_a_simulated_system_of_every_shipped_robot_starts(self):
        robots = sorted(file.stem for file in (ROOT / "lua" / "robots").glob("*.lua"))
        self.assertGreater(len(robots), 8)
        for robot in robots:
            with self.subTest(robot), System(robot=robot) as one:
                self.assertEqual(one.client().enable()["state"], "ENABLED")

    def test_the_bus_and_the_pose_are_those_of_liana_run(self):
        self.assertEqual(
            [system.bus_of(robot) for robot in ("zhu2022", "micro", "macro", "tdcr_benchmark")],
            ["embedded", "embedded_micro", "bench_7", "bench_6"],
        )
        self.assertEqual(system.start_pose_of("lab_1g"), "park")


class Environment(unittest.TestCase):
    def steps(self, seed, count=4):
        with BenchEnvironment("micro") as environment:
            observation, info = environment.reset(seed=seed)
            speed_m_s = 0.5 * environment.action_space.high[0]
            return [(observation, info), *(environment.step([speed_m_s, 0.0, -speed_m_s]) for _ in range(count))]

    def test_a_seed_repeats_every_number_and_another_one_has_another_goal(self):
        once = self.steps(3)
        self.assertEqual(once, self.steps(3))
        self.assertNotEqual(once[0][0][-3:], self.steps(4, 0)[0][0][-3:])

    def test_a_step_moves_the_tip_as_asked_and_returns_the_five_values(self):
        with BenchEnvironment("micro", limit_steps=27) as environment:
            first, info = environment.reset(seed=1, options={"goal_m": [9.0, 0.0, 0.0]})
            self.assertEqual(len(first), len(environment.observation_names))
            self.assertTrue(environment.observation_space.contains(first))
            for number in range(1, 28):  # and comes to rest
                action = (0.0, 0.03 if number <= 12 else 0.0, 0.0)
                observation, reward, terminated, truncated, info = environment.step(action)
                self.assertEqual((terminated, truncated, info["refused"]), (False, number == 27, ""))
            tip = environment.observation_names.index("tip_x_m")
            moved_m = [after - before for after, before in zip(observation[tip : tip + 3], first[tip : tip + 3])]
            self.assertEqual(reward, -math.dist(observation[tip : tip + 3], observation[-3:]))
        for got_m, asked_m in zip(moved_m, (0.0, 12 * 0.1 * 0.03, 0.0)):
            self.assertAlmostEqual(got_m, asked_m, delta=0.005)

    def test_at_the_goal_it_is_terminated(self):
        with BenchEnvironment("micro") as environment:
            first, _ = environment.reset(seed=1)
            tip = environment.observation_names.index("tip_x_m")
            environment.reset(seed=1, options={"goal_m": first[tip : tip + 3]})
            self.assertEqual(environment.step((0.0, 0.0, 0.0))[2:4], (True, False))

    def test_what_is_not_allowed_is_an_error_with_value_and_range(self):
        for words in ({"step_s": 1.0}, {"step_s": 0.0}, {"limit_steps": 0}, {"goal_m": math.nan}):
            with self.assertRaisesRegex(LianaError, next(iter(words))):
                BenchEnvironment("micro", **words)
        with BenchEnvironment("micro") as environment:
            with self.assertRaisesRegex(LianaError, "reset"):
                environment.step((0.0, 0.0, 0.0))
            for wrong in ({"seed": -1}, {"options": {"gaol_m": [0, 0, 0]}}, {"options": {"goal_m": [0, math.nan, 0]}}):
                with self.assertRaises(LianaError):
                    environment.reset(**wrong)
            environment.reset(seed=2)
            high = environment.action_space.high[0]
            environment.step((high, -high, 0.0))
            for action in ((1.01 * high, 0.0, 0.0), (0.0, 0.0), (0.0, 0.0, math.nan)):
                with self.assertRaisesRegex(LianaError, "action"):
                    environment.step(action)


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
