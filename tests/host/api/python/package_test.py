"""The package as people have it: installed by pip without a network, its types checked, its programs found."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[4]
SOURCE = ROOT / "host" / "api" / "python"
sys.path.insert(0, str(SOURCE))

import liana  # noqa: E402
from liana import LianaError, ProgramMissing, system  # noqa: E402


def run(*words, **environment):
    """A program outside of the tree, with nothing of Liana in its environment."""
    kept = {name: value for name, value in os.environ.items() if name not in ("LIANA_BIN", "PYTHONPATH")}
    call = list(map(str, words))
    return subprocess.run(call, capture_output=True, text=True, check=False, cwd="/", env={**kept, **environment})


class Folders(unittest.TestCase):
    def folder(self, *programs):
        """A folder with these programs, which only are there."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        for name in programs:
            (folder / name).write_text("#!/bin/sh\n")
            (folder / name).chmod(0o755)
        return folder

    def environment(self, **values):
        kept = {name: value for name, value in os.environ.items() if name != "LIANA_BIN"}
        self.enterContext(mock.patch.dict(os.environ, {**kept, **values}, clear=True))


class Found(Folders):
    def setUp(self):
        self.in_path, self.tree = self.folder("lianad"), self.folder()
        self.enterContext(mock.patch.object(system, "TREE", self.tree))

    def add(self, *parts):
        folder = self.tree.joinpath(*parts)
        folder.mkdir(parents=True)
        shutil.copy(self.in_path / "lianad", folder)
        return folder

    def test_programs_are_those_in_PATH_then_of_the_prefix_then_of_the_build_tree(self):
        built = self.add("build", "bin")
        self.environment(PATH=str(self.folder()))
        self.assertEqual(system.binaries(), built)
        installed = self.add("bin")
        self.assertEqual(system.binaries(), installed)
        os.environ["PATH"] = f"/no/such:{self.in_path}"
        self.assertEqual(system.binaries(), self.in_path)
        os.environ["LIANA_BIN"] = str(built)
        self.assertEqual(system.binaries(), built)

    def test_a_program_that_is_missing_is_an_error_that_says_where_it_was_searched(self):
        self.environment(PATH=str(self.folder()))
        with self.assertRaises(ProgramMissing) as caught:
            liana.System().write_tables()
        for named in ("lianad", "PATH", str(self.tree / "bin"), str(self.tree / "build" / "bin")):
            self.assertIn(named, str(caught.exception))
        os.environ["PATH"] = str(self.in_path)
        with self.assertRaises(LianaError) as caught:
            system.run("liana-bench", "--help")
        self.assertIn("liana-bench", str(caught.exception))
        self.assertIn(str(self.in_path), str(caught.exception))
        os.environ["LIANA_BIN"] = str(self.folder())
        with self.assertRaisesRegex(ProgramMissing, "LIANA_BIN"):
            system.program("lianad")

    def test_what_cannot_be_run_is_no_program(self):
        folder = self.folder("lianad")
        (folder / "lianad").unlink()
        (folder / "lianad").mkdir()
        self.environment(PATH=str(folder))
        with self.assertRaises(ProgramMissing):
            system.binaries()


class Installed(Folders):
    @classmethod
    def setUpClass(cls):
        cls.place = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        made = run(sys.executable, "-m", "venv", cls.place / "venv")
        if made.returncode != 0:
            raise AssertionError(f"{made.stdout}{made.stderr}: install python3-venv")
        cls.python = cls.place / "venv" / "bin" / "python"
        done = run(cls.python, "-m", "pip", "install", "--no-index", "--disable-pip-version-check", SOURCE)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)

    def said(self, code, **environment):
        done = run(self.python, "-c", code, **environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def test_pip_installs_it_without_a_network_with_its_version_and_types(self):
        code = "import importlib.metadata, liana; print(importlib.metadata.version('liana'), liana.__file__)"
        version, place = self.said(code).split()
        self.assertEqual(version, liana.__version__)
        self.assertTrue(place.startswith(str(self.place)), place)
        self.assertTrue((pathlib.Path(place).parent / "py.typed").is_file())
        listed = run(self.python, "-m", "pip", "check", "--disable-pip-version-check")
        self.assertEqual(listed.returncode, 0, listed.stdout)

    def test_it_finds_programs_and_tables_by_PATH_alone(self):
        programs = os.environ["LIANA_BIN"]
        code = "from liana import System, system; print(system.lua() / 'recordings'); System('micro').write_tables()"
        recordings = self.said(code, PATH=f"{programs}:{os.environ['PATH']}")
        self.assertTrue((pathlib.Path(recordings) / "approach_hand.hand").is_file(), recordings)

    def test_a_wheel_has_what_its_record_says_and_a_source_archive_makes_the_same_wheel(self):
        code = "import build_backend as b, sys; print(b.build_wheel(sys.argv[1]), b.build_sdist(sys.argv[1]))"
        here, there = self.folder(), self.folder()
        wheel, archive = run(sys.executable, "-c", code, here, PYTHONPATH=str(SOURCE)).stdout.split()
        shutil.unpack_archive(here / archive, there)
        (unpacked,) = there.iterdir()
        again = self.folder()
        run(sys.executable, "-c", code, again, PYTHONPATH=str(unpacked))
        self.assertEqual((again / wheel).read_bytes(), (here / wheel).read_bytes())


class Types(unittest.TestCase):
    def test_the_types_hold_by_the_strictest_rules(self):
        cache = self.enterContext(tempfile.TemporaryDirectory())
        done = run("/usr/bin/mypy", "--strict", "--cache-dir", cache, SOURCE / "liana")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
