"""`liana latency` as users call it: the shape of its report and its counts. Times are the machine's own and judged by
nobody here.
"""
import json
import os
import shutil
import subprocess
import tempfile
import unittest

from support import SystemTest
from liana.client import PATIENCE_S
from liana.system import System, program


class Latency(unittest.TestCase):
    def liana_latency(self, *words):
        home = tempfile.mkdtemp(prefix="liana-home-")
        self.addCleanup(shutil.rmtree, home, ignore_errors=True)
        done = subprocess.run(
            [program("liana"), "latency", *words],
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
            env={**os.environ, "XDG_RUNTIME_DIR": home, "TMPDIR": home},
        )
        left = [name for name in os.listdir(home) if name.startswith("liana-run-")]
        self.assertEqual(left, [], "tables and logs are removed")
        return done

    def check_times(self, times, ticks):
        self.assertEqual(set(times), {"median", "p99", "worst", "buckets"})
        self.assertLessEqual(times["median"], times["p99"])
        self.assertLessEqual(times["p99"], times["worst"])
        self.assertAlmostEqual(
            sum(count for _, count in times["buckets"]), ticks, delta=2
        )  # a tick may run at reset and at reading
        bounds = [bound for bound, _ in times["buckets"]]
        self.assertEqual(bounds, sorted(set(bounds)))
        self.assertGreaterEqual(times["worst"], bounds[-1])

    def test_a_second_is_measured_or_the_missing_privilege_is_named(self):
        done = self.liana_latency("--seconds", "1", "--json")
        if "time mode real: " in done.stderr:  # no real-time priority, or memory cannot be locked
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, "CAP_SYS_NICE|CAP_IPC_LOCK")
            return
        report = json.loads(done.stdout)
        self.assertEqual((report["rate_hz"], report["seconds"], report["buses"]), (250, 1, "embedded"))
        lost = report["overrun_causes"]["lost_ticks"]
        self.assertGreaterEqual(report["ticks"] + lost, 125)
        for key in ("wakeup_us", "tick_us"):
            self.check_times(report[key], report["ticks"])
        self.assertEqual(
            report["overruns"], sum(report["overrun_causes"][cause] for cause in ("late_wake", "long_tick", "bus_wait"))
        )
        self.assertEqual(done.returncode, 0 if report["overruns"] == 0 and report["enabled"] else 1)
        if report["enabled"] and not report["overruns"]:  # a busy machine may stop the arm before it moves
            self.assertGreater(report["moving"], 0.0)
        self.assertIn("real-time priority", [finding["name"] for finding in report["realtime"]])
        self.assertEqual(done.stderr, "")


class VirtualTime(SystemTest):
    def test_in_virtual_time_there_is_no_timing(self):
        with System() as system:
            client = system.client()
            self.assert_refused(client.ask("timing"), "refused", "time mode fast", "real")
            client.call("acquire")


if __name__ == "__main__":
    unittest.main(verbosity=2)
