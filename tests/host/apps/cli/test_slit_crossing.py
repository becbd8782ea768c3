"""The slit crossing from the command line: one whole fast run with its recording, then runs that are disturbed."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from programs import ROOT, liana, liana_json, start_liana

DEG = 3.141592653589793 / 180
README = (ROOT / "README.md").read_text(encoding="utf-8")


def children_of(pid):
    """Names and process ids of the programs a run has started."""
    out = subprocess.run(
        ["ps", "--ppid", str(pid), "-o", "pid=,comm="], capture_output=True, text=True, check=False
    ).stdout
    return {name: int(number) for number, name in (line.split() for line in out.splitlines())}


def wait_for_line(stream, pattern, timeout_s=60):
    """Reads lines until one matches; returns it."""
    end = time.monotonic() + timeout_s
    while time.monotonic() < end:
        line = stream.readline()
        if not line or re.search(pattern, line):
            return line
    return ""


class WholeRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.mkdtemp(prefix="liana-test-")
        cls.record = os.path.join(cls.directory, "record")
        cls.report_file = os.path.join(cls.directory, "report.json")
        cls.code, cls.out, cls.error = liana(
            "run", "slit_crossing", "--seed", 1, "--record", cls.record, "--json", cls.report_file, timeout_s=600
        )
        cls.report = json.loads(pathlib.Path(cls.report_file).read_text())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.directory)

    # req:A50 req:A53
    def test_the_run_succeeds_within_the_arm_time_of_the_experiment(self):
        self.assertEqual((self.code, self.report["outcome"]), (0, "success"), self.error)
        self.assertLessEqual(self.report["duration_s"], 216.4)
        self.assertEqual(len(self.report["steps"]), 6)
        self.assertEqual(self.report["faults"], [])

    def test_every_line_of_the_readmes_sample_is_printed_in_this_order(self):
        sample = re.search(r"^<!-- The sample below .*-->\n```text\n(.*?)^```", README, re.M | re.S)[1].splitlines()
        printed = iter((self.error + self.out).splitlines())
        self.assertGreater(len(sample), 5)
        for line in sample:
            self.assertTrue(line in printed, f"README.md: not printed, or not in this order: {line}")

    def test_the_tip_ends_at_the_rod(self):
        self.assertLessEqual(self.report["tip_error_m"], 1.5e-3)
        self.assertLessEqual(self.report["tip_attitude_error_rad"], 0.15 * DEG)
        self.assertIn("open_loop_tip_error_m", self.report)

    def test_nothing_is_touched_and_no_cable_is_slack_or_overloaded(self):
        self.assertGreaterEqual(self.report["min_slit_clearance_m"], 3e-3)
        self.assertGreaterEqual(self.report["min_sphere_clearance_m"], 50e-3)
        self.assertLess(self.report["max_contact_force_N"], 5.0)
        tension = self.report["cable_tension_N"]
        self.assertGreaterEqual(tension["min"], 1.0)
        self.assertGreaterEqual(tension["min_motor"], 15.0)
        self.assertLessEqual(tension["max"], 400.0)

    # req:A41
    def test_the_held_pitches_stand_at_zero_at_the_end(self):
        self.assertLessEqual(abs(self.report["final_theta_deg"][6]), 0.05)
        self.assertLessEqual(abs(self.report["final_theta_deg"][8]), 0.05)

    def test_both_buses_are_counted_within_their_worst_case(self):
        self.assertEqual([bus["name"] for bus in self.report["buses"]], ["can0", "can1"])
        for bus in self.report["buses"]:
            self.assertLess(0.0, bus["measured_load"])
            self.assertLessEqual(bus["measured_load"], bus["worst_load"])
            self.assertLessEqual(bus["worst_load"], 0.75)

    def test_the_recording_replays_without_a_differing_tick(self):
        result = liana_json("replay", self.record, timeout_s=300)
        self.assertGreaterEqual(result["ticks"], self.report["ticks"])
        self.assertEqual((result["differing_ticks"], result["missing_ticks"]), (0, 0))

    def test_the_bus_log_is_canopen_without_a_malformed_frame(self):
        """tshark must be installed: apt install tshark."""
        log = pathlib.Path(self.record) / "can0.log"
        part = pathlib.Path(self.directory) / "part.log"
        with log.open() as lines:
            part.write_text("".join(line for line, _ in zip(lines, range(20000))))
        call = ["tshark", "-r", str(part), "-d", "can.subdissector,canopen"]
        decoded = subprocess.run(call, capture_output=True, text=True, check=True).stdout
        self.assertIn("CANopen", decoded)
        malformed = subprocess.run([*call, "-Y", "_ws.malformed"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(malformed, "")


class DisturbedRun(unittest.TestCase):
    def start(self):
        run = start_liana("run", "slit_crossing", "--time", "paced")
        self.addCleanup(run.kill)
        self.assertIn("step 1", wait_for_line(run.stderr, r"step 1"))
        self.started = children_of(run.pid)
        self.assertIn("lianad", self.started)
        return run

    def finish(self, run):
        out, error = run.communicate(timeout=60)
        left = [name for name, pid in self.started.items() if os.path.exists(f"/proc/{pid}")]
        self.assertEqual(left, [])
        return out, error

    def test_a_killed_mission_fails_the_run_and_leaves_no_process(self):
        run = self.start()
        os.kill(children_of(run.pid)["liana-mission"], signal.SIGKILL)
        out, error = self.finish(run)
        self.assertEqual(run.returncode, 1)
        self.assertIn("outcome failed", out)
        self.assertIn("liana-mission", error.replace("the mission runner", "liana-mission"))

    def test_a_killed_bench_fails_the_run_with_its_name(self):
        run = self.start()
        os.kill(children_of(run.pid)["liana-bench"], signal.SIGKILL)
        _, error = self.finish(run)
        self.assertEqual(run.returncode, 1)
        self.assertIn("killed by signal 9", error)

    def test_ctrl_c_stops_the_arm_and_reports_an_abort(self):
        run = self.start()
        run.send_signal(signal.SIGINT)
        out, error = self.finish(run)
        self.assertEqual(run.returncode, 1)
        self.assertIn("outcome aborted", out)
        self.assertIn("DISABLED", error)

    def test_status_and_estop_reach_the_running_system(self):
        run = self.start()
        self.assertIn(liana_json("status")["state"], ["ENABLING", "ENABLED"])
        self.assertTrue(liana_json("estop")["stopped"])
        out, _ = self.finish(run)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(out, "outcome (aborted|failed|refused)")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
