"""`liana calibrate` on CAN interfaces: a person puts the arm into one jig after the other and presses Enter (field
`calibrate`).
"""
import contextlib
import json
import subprocess

from liana.system import program
from scenario_file import expect_that

FIELDS = {"poses": list, "cross_wired": list}
EXPECTED = {"code": int, "says": list}


class CalibrateRun:
    """Nothing runs by itself: `liana calibrate` starts lianad, the person the bench."""

    def __init__(self, scenario, stand):
        self.scenario, self.stand, self.expect, self.notes = scenario, stand, scenario.expect, []

    def go(self):
        with contextlib.ExitStack() as stack:
            system = self.stand.start(self.scenario)
            stack.push(system.__exit__)
            system.write_tables()
            file = system.directory / "arm.json"
            code, said = self.calibrate(system, file)
            expect_that(code == self.expect["code"], f"liana calibrate ended with {code}: {said}")
            for words in self.expect.get("says", []):
                expect_that(words in said, f"'{words}' is not in: {said}")
            expect_that(file.exists() == (code == 0), f"there must be a file exactly when all is well: {said}")
            if code == 0:
                self.judge_file(json.loads(file.read_text()))

    def calibrate(self, system, file):
        """Answers each prompt with the arm in its jig and Enter, as many as there are poses; exit code and all
        that was said.
        """
        words = ["--bus", system.directory / "buses.json", "--physics", "ideal", "--out", file]
        process = subprocess.Popen(
            [program("liana"), "calibrate", *map(str, words)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        left, said = list(self.scenario.calibrate["poses"]), []
        for line in process.stdout:
            said.append(line)
            if "put the arm into jig" not in line:
                continue
            self.end_bench(system)
            if left:
                self.put_into(system, left.pop(0), line)
                process.stdin.write("\n")
                process.stdin.flush()
            else:
                process.stdin.close()
        code = process.wait()
        self.end_bench(system)
        return code, "".join(said)

    def put_into(self, system, pose, prompt):
        """The arm, anew, in a jig."""
        expect_that(f"jig {pose}," in prompt, f"jig {pose} was expected, but: {prompt}")
        crossed = self.scenario.calibrate.get("cross_wired")
        system.bench_words = [
            "--start-pose",
            pose,
            "--jig",
            *(["--cross-wired", ",".join(map(str, crossed))] if crossed else []),
        ]
        system.start_bench()

    def end_bench(self, system):
        """Before the arm is put elsewhere: no drive had torque."""
        if "liana-bench" not in system.children:
            return
        codes = system.end_drives()
        expect_that(set(codes.values()) == {0}, f"a program did not end well: {codes}, {system.log('liana-bench')}")
        expect_that(not any(system.torque()[0]), "drives had torque")
        del system.children["liana-bench"]

    def judge_file(self, content):
        cables = content["cables"]
        expect_that([cable["serial"] for cable in cables] == [1001 + i for i in range(15)], f"serial numbers: {cables}")
        expect_that([cable["direction"] for cable in cables] == [(-1) ** i for i in range(15)], f"directions: {cables}")
        worst = max(abs(cable["drum_radius_m"] / 0.015 - 1.0) for cable in cables)
        self.notes.append(f"drums within {100 * worst:.2f} %")
        expect_that(worst < 0.01, f"drums are off by {worst}")
