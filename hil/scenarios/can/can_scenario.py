"""One scenario on CAN interfaces of the kernel (README.md): read it, run it, judge it. Runs on the machine that has
them.
"""
import json
import math
import subprocess
import sys
import time

from system import BenchOnCan, HERE, kInterfaces
from liana_system import brief, must

sys.path.append(str(HERE.parent))
import calibrate_run  # noqa: E402
from scenario_file import BadScenario, Failed, check_fields, expect_that, read  # noqa: E402

kReadme = "hil/scenarios/can/README.md"
kFields = {
    "about": str,
    "on": list,
    "during": str,
    "do": list,
    "restart": str,
    "mend": list,
    "calibrate": dict,
    "expect": dict,
    "reduced": bool,
    "only_in_vm": bool,
}
kExpected = {
    "fault": (int, list, type(None)),
    "state": str,
    "within_ticks": int,
    "after_clear": str,
    "travel_deg": (int, float),
    "overruns": int,
}
kKinds = (*kInterfaces, "drives")
kDuring = ("boot", "rest", "move")
kMoveDeg = 2.0
kTravelDeg = 1.0  # of any true angle in the last run without torque
kRested_s = 0.6
kReach_s = 20.0  # of arm time for every state that is waited for


class CanScenario:
    def __init__(self, path):
        self.name = f"can/{path.parent.name}/{path.stem}"
        content = read(path)
        self.calibrate = content.get("calibrate")
        check_fields(
            self.name, content, kFields, ("about", "on", "expect", *([] if self.calibrate else ["during"])), kReadme
        )
        if self.calibrate:
            check_fields(f"{self.name}: calibrate", self.calibrate, calibrate_run.kFields, ("poses",), kReadme)
            check_fields(f"{self.name}: expect", content["expect"], calibrate_run.kExpected, ("code",), kReadme)
        else:
            check_fields(f"{self.name}: expect", content["expect"], kExpected, ("fault", "state"), kReadme)
            if content["during"] not in kDuring:
                raise BadScenario(f"{self.name}: during is {content['during']}; allowed are {', '.join(kDuring)}")
        if not content["on"] or not set(content["on"]) <= set(kKinds):
            raise BadScenario(f"{self.name}: on is {content['on']}; allowed are {', '.join(kKinds)}")
        self.on, self.during, self.expect = content["on"], content.get("during"), content["expect"]
        self.do, self.mend = content.get("do", []), content.get("mend", [])
        self.restart, self.reduced = content.get("restart"), content.get("reduced", False)
        self.only_in_vm = content.get("only_in_vm", False)
        number = self.expect.get("fault")
        self.numbers = [] if number is None else number if isinstance(number, list) else [number]

    def fault_count(self):
        return 1 if self.do or (self.calibrate and "cross_wired" in self.calibrate) else 0


def all_scenarios(folder=HERE):
    """In bring-up order."""
    return [CanScenario(path) for path in sorted(folder.glob("[0-9]*/*.json"))]


class Run:
    """A scenario under way in the system that `make_system` gives. `notes` says what was measured."""

    def __init__(self, scenario, make_system):
        self.scenario, self.make_system, self.expect = scenario, make_system, scenario.expect
        self.notes, self.enables = [], 0

    def go(self):
        with self.make_system() as system:
            client = system.client()
            self.bring_up(client)
            overruns = client.state["overruns"] if client.state else 0
            begin = self.act(system, client)
            if self.scenario.restart:
                client = self.start_again(system)
            self.watch(client, begin)
            if "overruns" in self.expect:
                self.count_overruns(client.state["overruns"] - overruns)
            self.shell(system, self.scenario.mend)
            if "after_clear" in self.expect:
                self.clear(client)
            self.end(system, client)
            self.judge(system)

    def bring_up(self, client):
        must(client.ask("acquire"))
        if self.scenario.during == "boot":
            return
        client.until(lambda state: state["faults"] or (state["state"] != "BOOTING" and state["is_homed"]), kReach_s)
        self.enable(client)
        if self.scenario.during == "move":
            client.start_moving(
                math.copysign(kMoveDeg, client.state["setpoint_js_deg"][8])
            )  # to and fro where one follows the other

    def enable(self, client):
        self.enables += 1
        must(client.ask("state_command", command="enable"))
        client.until(lambda state: state["faults"] or (state["state"] == "ENABLED" and state["at_rest"]), kReach_s)
        expect_that(not client.state["faults"], f"the arm could not be enabled: {brief(client.state)}")

    def shell(self, system, lines):
        for line in lines:
            done = subprocess.run(
                ["bash", "-ec", line], env=system.environment(), capture_output=True, text=True, check=False
            )
            expect_that(done.returncode == 0, f"`{line}` failed: {done.stderr.strip()}")

    def act(self, system, client):
        """Runs what the scenario does; the tick before it."""
        begin = client.state["tick"] if client.state else 0
        self.shell(system, self.scenario.do)
        return begin

    def start_again(self, system):
        """A program that was killed comes back, as an operator would start it."""
        name = self.scenario.restart
        system.ended(name)
        system.start_lianad() if name == "lianad" else system.start_bench()
        if name != "lianad":
            return system.clients[-1]
        client = system.client()
        must(client.ask("acquire"))
        return client

    def watch(self, client, begin):
        """The end state: reached, and kept for a while; in FAULT nothing enables or moves without a clear."""
        wanted, numbers = self.expect["state"], self.scenario.numbers
        client.step()
        if numbers:
            client.until(lambda state: state["faults"], kReach_s)
            first = client.state["faults"][0]
            found = [fault["number"] for fault in client.state["faults"]]
            expect_that(first["number"] in numbers, f"fault {numbers} was expected first, but: {brief(client.state)}")
            took = first["tick"] - begin
            self.notes.append(f"{first['number']} after {took} ticks" if not self.scenario.restart else f"{found[0]}")
            expect_that(
                took <= self.expect.get("within_ticks", took),
                f"{first['number']} after {took} ticks, allowed are {self.expect.get('within_ticks')}",
            )
        client.until(lambda state: state["state"] == wanted and (numbers or not state["is_busy"]), kReach_s)
        client.go_on(kRested_s)
        expect_that(
            client.state["state"] == wanted and bool(client.state["faults"]) == bool(numbers),
            f"{wanted} did not stay: {brief(client.state)}",
        )
        if wanted != "FAULT":
            return
        for op, words in (
            ("state_command", {"command": "enable"}),
            ("move_jp", {"goal_deg": client.state["setpoint_js_deg"]}),
        ):
            answer = client.ask(op, **words)
            expect_that(answer["op"] == "error", f"{op} was accepted while a fault is latched: {answer}")

    def count_overruns(self, found):
        self.notes.append(f"{found} overruns")
        expect_that(
            found <= self.expect["overruns"], f"{found} deadlines were missed, allowed are {self.expect['overruns']}"
        )

    def clear(self, client):
        wanted = self.expect["after_clear"]
        if self.scenario.numbers:
            client.go_on(kRested_s)  # what was mended shows itself
            must(client.ask("state_command", command="clear"))
            client.until(lambda state: any("cleared" in event["text"] for event in state["events"]), kReach_s)
        if wanted == "FAULT":
            client.go_on(kRested_s)
            expect_that(
                client.state["state"] == "FAULT", f"the clear was expected to be refused, but: {brief(client.state)}"
            )
            return
        client.until(lambda state: state["state"] == "DISABLED" and not state["faults"], kReach_s)
        if wanted == "ENABLED":
            self.enable(client)

    def end(self, system, client):
        client.request("shutdown")
        deadline = time.monotonic() + kReach_s
        try:
            while time.monotonic() < deadline:
                client.step()
        except (ConnectionError, OSError):
            pass
        codes = {"lianad": system.ended("lianad"), **system.end_drives()}
        expect_that(set(codes.values()) == {0}, f"a program did not end well: {codes}")

    def judge(self, system):
        """Drives had torque as often as the operator enabled them, never again by themselves, and none at the end."""
        enabled, travel = system.torque()
        rises = [slot for slot in range(1, len(enabled)) if enabled[slot] and not enabled[slot - 1]]
        allowed = self.enables if self.scenario.restart != "liana-bench" else 1
        expect_that(
            len(rises) == allowed,
            f"the drives got torque {len(rises)} times ({rises}), the operator enabled {allowed} times",
        )
        expect_that(not enabled[-1], "drives still have torque at the end")
        expect_that(
            travel <= self.expect.get("travel_deg", kTravelDeg), f"the arm travelled {travel:.2f} deg without torque"
        )


def run(scenario, kind, make_system):
    """A row of results: name, outcome, seconds of this machine's own clock, why, notes."""
    one = (calibrate_run.CalibrateRun if scenario.calibrate else Run)(scenario, make_system)
    start, why = time.monotonic(), ""
    try:
        one.go()
    except (Failed, AssertionError, OSError, ValueError, KeyError, subprocess.SubprocessError) as error:
        why = f"{type(error).__name__}: {error}"
    return {
        "name": scenario.name,
        "on": kind,
        "outcome": "failed" if why else "passed",
        "seconds": round(time.monotonic() - start, 2),
        "why": why,
        "notes": one.notes,
    }


def main():
    names = set(sys.argv[2:])
    with open(sys.argv[1], "w", encoding="utf-8") as results:
        for scenario in all_scenarios():
            for kind in scenario.on:
                if f"{scenario.name}@{kind}" not in names:
                    continue
                row = run(scenario, kind, lambda kind=kind: BenchOnCan(kind))
                print(
                    (
                        f"{row['outcome']}  {row['name']} ({kind})  {row['seconds']:.1f} s  {', '.join(row['notes'])} "
                        f" {row['why']}"
                    ),
                    flush=True,
                )
                results.write(json.dumps(row) + "\n")
                results.flush()


if __name__ == "__main__":
    main()
