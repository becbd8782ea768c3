"""A whole mission on CAN interfaces in real time, as `liana run` flies it (field `mission`)."""
import json
import subprocess
import tempfile

from can.system import reset_interfaces
from liana.system import program
from scenario_file import expect_that

kFields = {"name": str, "bus": str, "scene": str, "planted": str, "seed": int}
kExpected = {"outcome": str, "says": str}


class MissionRun:
    """`liana run` starts everything itself: lianad, the bench, the mission."""

    def __init__(self, scenario, stand):
        self.scenario, self.stand, self.expect, self.notes = scenario, stand, scenario.expect, []

    def go(self):
        reset_interfaces(self.stand.kind)
        with tempfile.TemporaryDirectory(prefix="liana-mission-") as folder:
            report = self.fly(f"{folder}/report.json")
        self.notes.append(f"{report['duration_s']:.0f} s")
        said = f"{report['outcome']}: {report.get('reason', '')}"
        expect_that(report["outcome"] == self.expect["outcome"], f"the mission ended with {said}")
        expect_that(self.expect.get("says", "") in said, f"'{self.expect.get('says')}' is not in: {said}")

    def fly(self, file):
        mission = self.scenario.mission
        words = [mission["name"], "--bus", mission["bus"], "--time", "real", "--json", file]
        for field, option in {"scene": "--scene", "planted": "--fault", "seed": "--seed"}.items():
            if field in mission:
                words += [option, str(mission[field])]
        done = subprocess.run([program("liana"), "run", *words], capture_output=True, text=True, check=False)
        expect_that(done.returncode in (0, 1), f"liana run ended with {done.returncode}: {done.stderr.strip()[-600:]}")
        with open(file, encoding="utf-8") as report:
            return json.load(report)
