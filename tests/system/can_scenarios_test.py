"""Scenarios on CAN interfaces: their files, where each runs, and what makes a latency measurement fail. Nothing here
needs CAN.
"""
import json
import pathlib
import subprocess
import tempfile
import unittest
from unittest import mock

import support  # noqa: F401
from message import Messages
import preload
from can import can_scenario, latency_verdict, machine, real_drives
from scenario_file import BadScenario


class Files(unittest.TestCase):
    GOOD = {"about": "x", "on": ["vcan"], "during": "move", "expect": {"fault": None, "state": "ENABLED"}}

    def read(self, **changed):
        path = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "one.json"
        path.write_text(json.dumps({**self.GOOD, **changed}))
        return can_scenario.CanScenario(path)

    def test_mistakes_are_refused_with_the_field(self):
        self.assertEqual(self.read().on, ["vcan"])
        for words, changed in (
            (("durign", "not known"), {"durign": "move"}),
            (("on is", "sja1000"), {"on": ["vcam"]}),
            (("during", "boot, rest, move"), {"during": "flight"}),
            (("overruns", "wrong type"), {"expect": {**self.GOOD["expect"], "overruns": "none"}}),
            (("state is missing",), {"expect": {"fault": 3002}}),
        ):
            with self.assertRaises(BadScenario) as caught:
                self.read(**changed)
            for word in words:
                self.assertIn(word, str(caught.exception))

    def test_what_uses_the_bench_is_not_said_to_run_on_real_drives(self):
        served = [one for one in can_scenario.all_scenarios() if real_drives.KIND in one.on]
        self.assertGreaterEqual(len(served), 5)
        for one in served:
            words = " ".join(one.do + one.mend)
            self.assertFalse(
                one.only_in_vm
                or one.restart == "liana-bench"
                or "BENCH" in words
                or "vcan" in words
                or "cansend" in words
                or "DIR/line" in words
                or "tc " in words,
                one.name,
            )


class Where(unittest.TestCase):
    def run_all(self, has_can, items):
        """Names of what ran here and of what ran in guests."""
        here, guests = [], []

        def rows(group, native):
            (here if native else guests).extend(item.name for item in group)
            return [{"name": item.name} for item in group]

        def latency(group, runs):
            guests.extend(item.name for item in group)
            return [({"name": item.name}, {"runs": runs}) for item in group]

        with mock.patch.multiple(
            machine, check_packages=lambda: None, has_can=lambda: has_can, scenario_rows=rows, latency_rows=latency
        ):
            done, measured = machine.run_all(items, lambda row: None, {"250": 3, "500": 1})
        self.assertEqual(
            sorted(row["name"] for row in done), sorted(item.name for item in items), "each runs, and once"
        )
        self.assertEqual([row["runs"] for row in measured], [3, 3, 3, 1, 1])
        return here, guests

    def test_without_can_everything_runs_in_guests(self):
        here, guests = self.run_all(False, machine.all_items())
        self.assertEqual(here, [])

    def test_with_can_only_what_needs_the_guest_runs_there(self):
        here, guests = self.run_all(True, machine.all_items())
        self.assertIn("can/10_motion/joint_move/vcan", here)
        self.assertIn("can/20_bus_faults/cables_swapped/gateway", here)
        self.assertTrue(
            all(
                name.endswith(("/sja1000", "/serial"))
                or name.startswith("latency/")
                or "clock_step" in name
                or "memory_pressure" in name
                for name in guests
            ),
            guests,
        )

    def test_a_kernel_that_makes_no_interface_has_no_can(self):
        def answers(code):
            return mock.patch.multiple(
                machine, socket=mock.DEFAULT, subprocess=mock.Mock(run=lambda *_, **__: mock.Mock(returncode=code))
            )

        with answers(2):
            self.assertFalse(machine.has_can())
        with answers(0):
            self.assertTrue(machine.has_can())
        with mock.patch.object(machine.socket, "socket", side_effect=OSError):
            self.assertFalse(machine.has_can())


class Latency(Messages, unittest.TestCase):
    def measured(self, **changed):
        times = {"median": 7, "p99": 9, "worst": 10}
        return {
            "rate_hz": 250.0,
            "load": "idle",
            "enabled": True,
            "moving": 0.9,
            "overruns": 0,
            "wakeup_us": dict(times),
            "tick_us": dict(times),
            **changed,
        }

    def judged(self, *runs):
        row = latency_verdict.cell(250.0, "idle", list(runs))
        return row, latency_verdict.judge(row)

    def test_an_arm_that_stands_most_of_the_time_is_no_measurement(self):
        self.assert_names(self.judged(self.measured(moving=0.4))[1], "moved", "40 %")

    def test_runs_that_hold_and_agree_pass_and_the_worst_of_them_is_reported(self):
        row, why = self.judged(
            self.measured(), self.measured(tick_us={"median": 8, "p99": 9, "worst": 20}), self.measured()
        )
        self.assertEqual(why, "")
        self.assertEqual(
            (row["tick_us"], row["difference_us"], row["overruns"]), ({"median": 8, "p99": 9, "worst": 20}, 10, 0)
        )
        self.assertEqual([run["verdict"] for run in row["runs"]], ["holds"] * 3)

    def test_each_limit_fails(self):
        slow = {"median": 7, "p99": 9, "worst": 26}
        for words, changed in (
            ("1 overruns", {"overruns": 1}),
            ("26 us worst wake-up", {"wakeup_us": slow}),
            ("the arm was not enabled", {"enabled": False}),
            ("2001 us longest tick", {"tick_us": {**slow, "worst": 2001}}),
            ("no report", {"error": "no report"}),
        ):
            self.assertIn(f"run 2: {words}", self.judged(self.measured(), self.measured(**changed))[1])
        self.assertIn(
            "runs differ by 11 us",
            self.judged(self.measured(), self.measured(tick_us={"median": 18, "p99": 19, "worst": 20}))[1],
        )
        self.assertIn("run 1", self.judged({"error": "the machine did not start"})[1])


class Preload(unittest.TestCase):
    def test_the_archive_has_files_links_and_the_folders_above_them(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        (folder / "file").write_text("content")
        (folder / "link").symlink_to("file")
        listed = (
            subprocess.run(
                ["cpio", "-t", "--quiet"], input=preload.archive([folder / "link"]), capture_output=True, check=True
            )
            .stdout.decode()
            .split()
        )
        for path in (folder, folder / "file", folder / "link", pathlib.Path("/bin")):
            self.assertIn(f"preload{path}", listed)


if __name__ == "__main__":
    unittest.main(verbosity=2)
