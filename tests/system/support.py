"""What the tests of the whole system share: safe arms as assertions, and `liana run` in a folder of its own.

Importing it makes the tree's Python client (host/api/python) and the scenarios' modules (hil/scenarios, hil/vm) importable.
"""
import atexit
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TESTS = pathlib.Path(__file__).resolve().parent
SOURCE = TESTS.parents[1]
SCENARIOS = SOURCE / "hil" / "scenarios"
PYTHON = SOURCE / "host" / "api" / "python"
MISSIONS = TESTS / "missions"
sys.path[:0] = [str(PYTHON), str(SCENARIOS), str(SOURCE / "hil" / "vm")]
sys.path.append(str(SOURCE / "tests"))  # message.py

# `liana estop` looks wherever a system can be: those of other test programs are not to be found there.
os.environ["XDG_RUNTIME_DIR"] = os.environ["TMPDIR"] = tempfile.tempdir = tempfile.mkdtemp(prefix="liana-tests-")
atexit.register(shutil.rmtree, tempfile.tempdir, ignore_errors=True)

from liana.client import brief  # noqa: E402
from liana.system import program  # noqa: E402
from message import Messages  # noqa: E402


def start_run(test, *words):
    """`liana run` with these words, its runtime directory its own; ended when the test ends."""
    home = tempfile.mkdtemp(prefix="liana-home-")
    test.addCleanup(shutil.rmtree, home, ignore_errors=True)
    process = subprocess.Popen(
        [program("liana"), "run", *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=home,
        env={**os.environ, "XDG_RUNTIME_DIR": home, "XDG_STATE_HOME": home, "TMPDIR": home},
    )
    process.home = pathlib.Path(home)
    test.addCleanup(process.communicate)
    test.addCleanup(process.kill)
    return process


class SystemTest(Messages, unittest.TestCase):
    """Assertions about a safe arm, and tables of a test's own."""

    def bus_of(self, drives):
        """A bus table like embedded_micro with these entries of `drives` (Lua)."""
        folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-drives-"))
        self.addCleanup(shutil.rmtree, folder)
        file = folder / "own.lua"
        file.write_text(f"local t = require 'buses.embedded_micro'\nt.drives = {{ {drives} }}\nreturn t\n")
        return str(file)

    def assert_refused(self, answer, code, *words):
        self.assertEqual(answer["op"], "error", answer)
        self.assertEqual(answer["code"], code, answer)
        for word in words:
            self.assertIn(word, answer["message"])

    def assert_fault(self, state, number, index):
        found = [(fault["number"], fault["index"]) for fault in state["faults"]]
        self.assertIn((number, index), found, brief(state))

    def assert_holds(self, state):
        self.assertEqual(state["state"], "ENABLED", brief(state))
        self.assertTrue(state["at_rest"], brief(state))
        self.assertFalse(state["is_busy"], brief(state))

    def assert_still(self, truth, first, allowed_deg=0.02):
        """The true arm keeps its place from row `first` on, and all its numbers are finite."""
        self.assertTrue(all(math.isfinite(value) for value in truth.rows[-1]))
        self.assertLess(truth.travel_deg(first, None), allowed_deg)

    def assert_stopped(self, truth, event_slot, stop_deg=1.0, swing_deg=0.02):
        """Brakes closed at the end, little travel after the event, next to none in the last half second.

        Brakes hold the drums; on its elastic cables the arm swings on with what motion it had, and next to nothing
        damps it.
        """
        self.assertEqual(truth.column("enabled")[-1], 0)
        self.assertLess(truth.travel_deg(event_slot, None), stop_deg)
        self.assert_still(truth, len(truth.rows) - 125, swing_deg)
