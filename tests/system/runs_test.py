"""`liana run` with input that cannot work: one message, exit code 2 before anything moves or 1 after, and a safe arm (A35)."""
import json
import pathlib
import socket
import unittest

from liana_system import SOURCE, SystemTest, Truth, start_run

MISSIONS = pathlib.Path(__file__).resolve().parent / "missions"
ATTACKS = SOURCE / "tests" / "lua" / "attacks"
PATIENCE_S = 300


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
        for option, value in (("--time", "soon"), ("--physics", "magic"), ("--seed", "-1"), ("--seed", "1.5"), ("--seed", "x")):
            self.refused("slit_crossing", option, value, says=[option])

    def test_scripts_that_fail_before_they_are_missions(self):
        for name, says in {"syntax_error": "syntax_error.lua:1", "endless_loop": "endless_loop", "endless_pcall": "endless_pcall",
                           "memory_bomb": "memory", "nothing": "nothing.lua"}.items():
            with self.subTest(name):
                self.refused(ATTACKS / f"{name}.lua", says=[says])


class MissionsThatFailWhileTheArmMoves(Runs):
    def failed(self, name, *says):
        process = start_run(self, MISSIONS / f"{name}.lua", "--json", "report.json", "--record", "record")
        directory = process.home
        out, error = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 1, error)
        for word in says:
            self.assertIn(word, out + error)
        report = json.loads((directory / "report.json").read_text())
        self.assertEqual(report["outcome"], "failed")
        truth = Truth(directory / "record" / "truth.bin")
        enabled = truth.column("enabled")
        self.assertEqual(max(enabled), 15)
        first = enabled.index(15)
        self.assertGreater(truth.travel_deg(first, None), 0.015, "the arm has to be moving when the script fails")
        self.assert_stopped(truth, len(truth.rows) - 130)
        self.assertLess(max(truth.column("contact_force_N")), 5.0)
        return report

    def test_an_endless_loop_inside_pcall_is_ended_and_named(self):
        self.failed("endless", "instructions")

    def test_a_memory_bomb_is_ended_and_named(self):
        self.failed("bomb", "memory", "64 MiB")

    def test_a_mistake_in_a_step_is_named(self):
        self.failed("mistake", "no pose named nowhere")


if __name__ == "__main__":
    unittest.main(verbosity=2)
