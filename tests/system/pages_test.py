"""The commands of pages of the documentation, as they stand there: by hand, for an arm of one's own, and from the crate
to the first motion.
"""
import contextlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

from support import SOURCE
from message import Messages
from liana.system import program


class Pages(Messages, unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-page-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def carry_out(self, name):
        """What the blocks of commands of a page print, in one shell with the programs in its path; none may fail."""
        page = (SOURCE / "docs" / name).read_text()
        commands = "".join(re.findall(r"^```\n(.*?)^```$", page, re.M | re.S))
        self.assertGreater(commands.count("liana"), 5)
        environment = {**os.environ, "XDG_RUNTIME_DIR": str(self.folder), "XDG_STATE_HOME": str(self.folder)}
        environment["PATH"] = os.path.dirname(program("liana")) + os.pathsep + environment["PATH"]
        file = self.folder / "out.txt"
        with file.open("w") as out:
            shell = subprocess.Popen(
                ["bash", "-e", "-c", commands],
                cwd=self.folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            try:
                code = shell.wait(timeout=500)
            finally:
                with contextlib.suppress(ProcessLookupError):  # what the page has left running
                    os.killpg(shell.pid, signal.SIGKILL)
        self.assertEqual(code, 0, file.read_text())
        return file.read_text()

    def test_every_program_started_by_hand_makes_a_system_that_ends_well(self):
        out = self.carry_out("how-to/start-by-hand.md")
        self.assertRegex(out, "api.sock: [A-Z]+, t = .* owner nobody")
        self.assertEqual(json.loads((self.folder / "report.json").read_text())["outcome"], "success", out)
        self.assertIn("shutdown: signal", (self.folder / "events.txt").read_text())
        checked = subprocess.run(
            [program("liana"), "log", "verify", self.folder / "archive", "--json"],
            capture_output=True,
            text=True,
            check=True,
        )
        (life,) = json.loads(checked.stdout)["lives"]
        self.assertTrue(life["finished"], checked.stdout)

    def test_an_arm_of_ones_own_goes_from_six_answers_to_a_calibrated_mission(self):
        out = self.carry_out("how-to/bring-your-own-arm.md")
        self.assertIn("fits\n", out)
        self.assertIn("converged", out)
        self.assertEqual(out.count("outcome success, arm time"), 4, "a dry run and three runs\n" + out)
        self.assertEqual(out.count("clearance: nothing"), 3, "of the dry run and two runs\n" + out)
        self.assertRegex(out, r"\d+ ticks, 0 differ")
        self.assertTrue((self.folder / "routing.svg").exists() and (self.folder / "reach.svg").exists())

    def test_from_the_crate_to_the_first_motion_one_motor_one_segment_the_arm(self):
        out = self.carry_out("how-to/commission-drives.md")
        self.assertRegex(out, r"node 1 on can0 moved \+0\.0(2|1999|2000) turns")
        self.assertIn("emergency 0x7305, additional modules", out)
        self.assert_names(out, "not", "disabled")
        self.assert_names(out, "--by", "3 turns", "0.001", "0.25 turns")
        self.assertEqual(re.findall("exit code (.)", out), ["1", "1", "2"], out)
        self.assertEqual(out.count("as type cia402_csp"), 2 + 3 + 9, out)
        self.assertEqual(out.count("disabled: switch_on_disabled"), 2 + 6, out)
        self.assertEqual(out.count("outcome success, arm time"), 4, "two dry runs and two runs\n" + out)
        self.assertEqual(len(re.findall(r"\d+ ticks, 0 differ", out)), 2, out)


if __name__ == "__main__":
    unittest.main(verbosity=2)
