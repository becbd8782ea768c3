"""`liana run` with bad input: one message, exit code 2 before anything moves or 1 after, and a safe arm."""
import contextlib
import json
import os
import pathlib
import signal
import socket
import sqlite3
import tempfile
import time
import unittest

from support import MISSIONS, SOURCE, SystemTest, start_run
from liana.recordings import Truth
from liana.system import run

ATTACKS = SOURCE / "tests" / "lua" / "attacks"
PATIENCE_S = 300
HELD_UP_S = 4.0  # a run of seconds would be over by then; lianad waits 10 s for who is in lockstep


def has_can():
    try:
        socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW).close()
        return True
    except OSError:
        return False


class Runs(SystemTest):
    def finished(self, *words):
        process = start_run(self, *words)
        out, error = process.communicate(timeout=PATIENCE_S)
        return process, out, error


class RunsThatAreRefused(Runs):
    def refused(self, *words, says):
        process, out, error = self.finished(*words)
        self.assertEqual((process.returncode, out), (2, ""), error)
        self.assertEqual(len(error.strip().splitlines()), 1, error)
        for word in says:
            self.assertIn(word, error)
        self.assertEqual(list(process.home.iterdir()), [], "nothing may be left behind")

    def test_a_bus_that_does_not_exist(self):
        self.refused("slit_crossing", "--bus", "nosuch", says=["nosuch"])

    def test_vcan_where_there_is_none(self):
        if has_can():
            self.skipTest("this kernel has CAN")
        self.refused("slit_crossing", "--bus", "vcan", says=["vcan", "this kernel has no CAN", "embedded"])

    def test_a_mission_that_does_not_exist(self):
        self.refused("nosuch", says=["nosuch"])

    def test_time_physics_and_seed_that_do_not_exist(self):
        for option, value in (
            ("--time", "soon"),
            ("--physics", "magic"),
            ("--seed", "-1"),
            ("--seed", "1.5"),
            ("--seed", "x"),
            ("--seed", "9007199254740992"),
            ("--seed", "18446744073709551616"),
        ):
            self.refused("slit_crossing", option, value, says=[option])

    def test_the_range_of_seeds_is_said(self):
        self.refused("slit_crossing", "--seed", "1e30", says=["--seed", "1e30", "0 to 9007199254740991"])

    def test_a_report_that_cannot_be_written(self):
        self.refused(
            "slit_crossing",
            "--json",
            "/nonexistent/report.json",
            says=["--json", "/nonexistent/report.json", "directory that exists"],
        )
        self.refused("slit_crossing", "--json", "/nonexistent/report.json", "--record", "record", says=["--json"])
        self.refused("slit_crossing", "--json", "/", says=["--json", "directory"])

    def test_a_mission_that_the_robot_cannot_do(self):
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder) / "far.lua"
            script.write_text(
                (MISSIONS / "short.lua").read_text().replace('liana.move_to "prepare"', 'liana.move_to "moon"')
            )
            self.refused(script, says=["far.lua", "step 1", "run: pose moon", "zhu2022"])

    def test_scripts_that_fail_before_they_are_missions(self):
        for name, says in {
            "syntax_error": "syntax_error.lua:1",
            "endless_loop": "endless_loop",
            "endless_pcall": "endless_pcall",
            "memory_bomb": "memory",
            "nothing": "nothing.lua",
        }.items():
            with self.subTest(name):
                self.refused(ATTACKS / f"{name}.lua", says=[says])


class MissionsThatFailWhileTheArmMoves(Runs):
    def failed(self, what, *says):
        script = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "goes_wrong.lua"
        text = (MISSIONS / "goes_wrong.lua").read_text()
        self.assertIn("-- WHAT GOES WRONG", text)
        script.write_text(text.replace("-- WHAT GOES WRONG", what))
        process = start_run(self, script, "--json", "report.json", "--record", "record", "--seed", 5)
        directory = process.home
        out, error = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 1, error)
        for word in says:
            self.assertIn(word, out + error)
        report = json.loads((directory / "report.json").read_text())
        self.assertEqual(report["outcome"], "failed")
        self.assertEqual(
            [report[key] for key in ("robot", "mission", "physics", "seed")], ["zhu2022", str(script), "nominal", 5]
        )
        truth = Truth(directory / "record" / "truth.bin")
        enabled = truth.column("enabled")
        self.assertEqual(max(enabled), 15)
        first = enabled.index(15)
        self.assertGreater(truth.travel_deg(first, None), 0.015, "the arm has to be moving when the script fails")
        self.assert_stopped(truth, len(truth.rows) - 130)
        self.assertLess(max(truth.column("contact_force_N")), 5.0)
        return report

    def test_an_endless_loop_inside_pcall_is_ended_and_named(self):
        self.failed("while true do pcall(function() while true do end end) end", "instructions")

    def test_a_memory_bomb_is_ended_and_named(self):
        self.failed("local t = {} for i = 1, 1e9 do t[i] = { i, i, i, i } end", "memory", "64 MiB")

    def test_a_mistake_in_a_step_is_named(self):
        self.failed('arm.move_jp { goal_deg = arm.named_pose "nowhere" }', "no pose named nowhere")


class RunsInRealTime(Runs):
    def test_a_run_whose_mission_fails_ends_by_itself(self):
        script = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "goes_wrong.lua"
        script.write_text((MISSIONS / "goes_wrong.lua").read_text().replace("-- WHAT GOES WRONG", 'error("enough")'))
        process, out, error = self.finished(script, "--time", "real")
        if "liana doctor" in error:
            self.skipTest(error)
        self.assertEqual(process.returncode, 1)
        self.assertIn("the run did not succeed", error)


class RunsThatRepeat(Runs):
    def told(self, *, held_up):
        """Report, events and commands of a run; held up: `liana run` itself stands still for a while as the arm
        moves.
        """
        process = start_run(self, MISSIONS / "short.lua", "--json", "report.json", "--record", "record", "--seed", 3)
        if held_up:
            for line in process.stderr:
                if "prepare" in line:
                    break
            os.kill(process.pid, signal.SIGSTOP)
            time.sleep(HELD_UP_S)
            os.kill(process.pid, signal.SIGCONT)
        _, error = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 0, error)
        files = ("report.json", "record/events.txt", "record/commands.txt")
        return {file: (process.home / file).read_text() for file in files}

    def test_what_a_run_tells_does_not_depend_on_how_fast_its_states_are_read(self):
        plain, held_up = self.told(held_up=False), self.told(held_up=True)
        self.assertIn("verified_clearance_m", plain["report.json"])
        for file, text in plain.items():
            with self.subTest(file):
                self.assertEqual(held_up[file], text)


class RunsOnAPage(Runs):
    """With the page built, as `./dev test page` or `./dev view` build it."""

    def test_a_page_is_of_the_run_that_ended_last_not_of_one_that_goes_on(self):
        process, _, error = self.finished(MISSIONS / "short.lua", "--seed", 3)
        self.assertEqual(process.returncode, 0, error)
        (ended,) = (process.home / "liana" / "runs").iterdir()
        going_on = ended.with_name("liana-run-goes-on")
        going_on.mkdir()
        (going_on / "archive.db").write_bytes((ended / "archive.db").read_bytes())
        with contextlib.closing(sqlite3.connect(going_on / "archive.db")) as archive:
            archive.execute("UPDATE life SET finished=0")
            archive.commit()
        shown = run("liana", "view", "--json", env={**os.environ, "XDG_STATE_HOME": str(process.home)})
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertEqual(json.loads(shown.stdout)["run"], str(ended))
        self.assert_names(shown.stderr, "liana view liana-run-goes-on")


if __name__ == "__main__":
    unittest.main(verbosity=2)
