"""A whole mission on CAN interfaces in real time, as `liana run` flies it (field `mission`)."""
import json
import os
import pathlib
import subprocess
import tempfile
import time

from can.system import HARDWARE_PRIORITY, reset_interfaces
from liana.system import program
from scenario_file import expect_that

FIELDS = {"name": str, "robot": str, "bus": str, "scene": str, "planted": str, "faults": list, "seed": int}
OPTIONS = {"robot": "--robot", "scene": "--scene", "planted": "--fault", "seed": "--seed"}
EXPECTED = {"outcome": str, "says": str, "failed": dict}


def put_bench_first(process):
    """The bench stands for hardware, which is never late for want of a processor. With a fault list `liana run` asks a
    bench first whether it is right (--check): that is another process, gone before the run.
    """
    while process.poll() is None:
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if (folder / "comm").read_text().strip() != "liana-bench":
                    continue
                words = (folder / "cmdline").read_bytes().split(b"\0")
                if len(words) < 2 or b"--check" in words:  # none yet: it is just about to begin
                    continue
                os.sched_setscheduler(int(folder.name), os.SCHED_FIFO, os.sched_param(HARDWARE_PRIORITY))
                return
            except OSError:  # it has just ended
                continue
        time.sleep(0.01)


class MissionRun:
    """`liana run` starts everything itself: lianad, the bench, the mission."""

    def __init__(self, scenario, stand):
        self.scenario, self.stand, self.expect, self.notes = scenario, stand, scenario.expect, []

    def go(self):
        reset_interfaces(self.stand.kind)
        with tempfile.TemporaryDirectory(prefix="liana-mission-") as folder:
            report = self.fly(pathlib.Path(folder))
        self.notes.append(f"{report['duration_s']:.0f} s")
        said = f"{report['outcome']}: {report.get('reason', '')}"
        expect_that(report["outcome"] == self.expect["outcome"], f"the mission ended with {said}")
        expect_that(self.expect.get("says", "") in said, f"'{self.expect.get('says')}' is not in: {said}")

        for name, why in self.expect.get("failed", {}).items():
            reasons = [
                step["reason"] for step in report["steps"] if step["name"] == name and step["outcome"] == "failed"
            ]
            expect_that(any(why in reason for reason in reasons), f"no '{name}' failed with '{why}': {reasons}")

    def fly(self, folder):
        mission, file = self.scenario.mission, folder / "report.json"
        words = [mission["name"], "--bus", mission["bus"], "--time", "real", "--json", file]
        if "faults" in mission:
            faults = folder / "faults.json"
            faults.write_text(json.dumps(mission["faults"]), encoding="utf-8")
            words += ["--faults", faults]
        for field, option in OPTIONS.items():
            if field in mission:
                words += [option, str(mission[field])]
        process = subprocess.Popen(
            [program("liana"), "run", *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        put_bench_first(process)
        _, said = process.communicate()
        expect_that(process.returncode in (0, 1), f"liana run ended with {process.returncode}: {said.strip()[-600:]}")
        with open(file, encoding="utf-8") as report:
            return json.load(report)
