"""Runs one scenario on whatever stand: bring up, strike, watch, clear, end, judge (README.md)."""
import contextlib
import subprocess
import threading
import time

from liana.client import LianaError, NotReached, brief
from scenario_file import Failed, expect_that

REFUSING_S = 2.0
# What makes a scenario fail: its own verdict, what the client complains about, and what it cannot read or start.
FAILURES = (Failed, LianaError, OSError, ValueError, KeyError, subprocess.SubprocessError)


def outcome(run):
    """Runs it: outcome, seconds of this machine's own clock, why, notes."""
    start, why = time.monotonic(), ""
    try:
        run.go()
    except FAILURES as error:
        why = f"{type(error).__name__}: {error}"
    seconds = round(time.monotonic() - start, 2)
    return {"outcome": "failed" if why else "passed", "seconds": seconds, "why": why, "notes": run.notes}


class LimitedRun:
    """A scenario under way. `notes` says what was measured, `violations` which safety rules were broken."""

    def __init__(self, scenario):
        self.scenario, self.expect = scenario, scenario.expect
        self.notes, self.violations, self.over_time = [], [], False

    def act(self):
        raise NotImplementedError

    def go(self):
        """Runs it; past its time limit the programs are killed, which ends whatever waits for them."""
        try:
            self.act()
        except Exception:
            expect_that(
                not self.over_time, f"over its time limit of {self.scenario.time_limit_s} s: the programs were killed"
            )
            raise
        expect_that(not self.violations, "; ".join(self.violations))

    def kill_all(self, system):
        self.over_time = True
        for child in list(system.children.values()):
            child.kill()

    @contextlib.contextmanager
    def limited(self, system):
        limit = threading.Timer(self.scenario.time_limit_s, self.kill_all, [system])
        limit.start()
        try:
            yield
        finally:
            limit.cancel()


class Run(LimitedRun):
    """`latched`, `number`: of the first fault; `enables`: how often the arm was enabled. In ticks, `enabled_again`:
    when it was enabled after a clear, `end`: the last that is judged.
    """

    def __init__(self, scenario, stand):
        super().__init__(scenario)
        self.stand = stand
        self.latched = self.number = self.enabled_again = self.end = None
        self.enables = self.overruns = 0

    def act(self):
        with self.stand.start(self.scenario) as system:
            with self.limited(system):
                client = self.operate(system)
                codes = system.shut_down(client)
            expect_that(set(codes.values()) == {0}, f"a program did not end well: {codes}")
            self.stand.judge(self, system, client)

    def operate(self, system):
        """All that the operator does, until the arm may be judged; his client."""
        client = self.stand.client(system)
        self.bring_up(client)
        self.overruns = client.state["overruns"] if client.state else 0
        client = self.stand.strike(self, system, client)
        self.stop(client)
        self.watch(client)
        self.stay(client)
        self.count_overruns(client)
        self.stand.mend(self, system)
        if "refused" in self.expect:
            self.judge_refusal(client)
        if "after_clear" in self.expect:
            self.clear(client)
        self.end = client.state["tick"]
        self.judge_events(client)
        return client

    def bring_up(self, client):
        """The arm as `during` says."""
        client.call("acquire")
        boots, scheduled = self.scenario.during == "boot", self.stand.faults_are_scheduled
        if boots and not scheduled:
            return
        client.until(lambda state: state["faults"] or self.is_ready(state), self.stand.reach_s)
        if boots:
            return
        self.enable(client)
        expect_that(scheduled or not client.state["faults"], f"the arm could not be enabled: {brief(client.state)}")
        if self.scenario.during == "move" and not client.state["faults"]:
            self.stand.start_move(client)

    def stop(self, client):
        """The operator's stop, where the scenario has one; the arm has to move until then if it was told to."""
        if getattr(self.scenario, "stop_after_s", None) is None:
            return
        client.go_on(self.scenario.stop_after_s)
        moving = client.state["is_busy"] and not client.state["at_rest"]
        expect_that(moving or self.scenario.during != "move", f"the arm has to move: {brief(client.state)}")
        client.call("stop", reason="scenario")

    def is_ready(self, state):
        """Booted, and homed where the scenario lets it be."""
        return state["state"] != "BOOTING" and (state["is_homed"] or "refused" in self.expect)

    def enable(self, client):
        expect_that(not client.state["faults"], f"a fault before the arm was enabled: {brief(client.state)}")
        self.enables += 1
        client.call("state_command", command="enable")
        client.until(
            lambda state: state["faults"] or (state["state"] == "ENABLED" and state["at_rest"]), self.stand.enabling_s
        )

    def watch(self, client):
        """Goes on until the expected fault, or, when none is expected, until the motion has ended."""
        numbers = self.scenario.numbers
        if not numbers:
            client.go_on(self.stand.rested_s)
            client.until(lambda state: state["faults"] or not state["is_busy"], self.stand.fault_s)
            return
        wanted = " or ".join(map(str, numbers))
        try:
            client.until(
                lambda state: {fault["number"] for fault in state["faults"]} & set(numbers), self.stand.fault_s
            )
        except NotReached:
            raise Failed(f"fault {wanted} was expected, but: {brief(client.state)}") from None
        first = client.state["faults"][0]
        self.latched, self.number = first["tick"], first["number"]
        index = self.expect.get("index", first["index"])
        expect_that(
            self.number in numbers and first["index"] == index,
            f"{wanted} of {index} was expected first, but: {brief(client.state)}",
        )
        detail = self.expect.get("detail", first.get("detail"))
        expect_that(first.get("detail") == detail, f"detail {detail} was expected, but: {first.get('detail')}")

    def stay(self, client):
        """The end state: nothing clears itself, and in FAULT nothing moves or enables without a clear."""
        wanted, numbers = self.expect["state"], self.scenario.numbers
        try:
            client.until(lambda state: state["state"] == wanted, self.stand.reach_s)
        except NotReached:
            raise Failed(f"state {wanted} was expected, but: {brief(client.state)}") from None
        client.go_on(self.stand.rested_s)
        stayed = client.state["state"] == wanted and bool(client.state["faults"]) == bool(numbers)
        fault = "the fault" if numbers else "no fault"
        expect_that(stayed, f"{wanted} with {fault} did not stay: {brief(client.state)}")
        if wanted == "FAULT":
            expect_refused(client, "while a fault is latched")

    def count_overruns(self, client):
        """Deadlines missed since before the strike."""
        if "overruns" in self.expect:
            found = client.state["overruns"] - self.overruns
            self.notes.append(f"{found} overruns")
            allowed = self.expect["overruns"]
            expect_that(found <= allowed, f"{found} deadlines were missed, allowed are {allowed}")

    def judge_refusal(self, client):
        """An arm that is not homed stays so and says why: to who wants to enable it, and to who only looks."""
        client.go_on(REFUSING_S)
        expect_that(not client.state["is_homed"], "the arm counts as homed")
        answer = client.ask("state_command", command="enable")
        expect_that(answer["op"] == "error", f"the arm was enabled: {answer}")
        seen = (client.state["not_homed"] or {}).get("text", "")
        for text in [answer["message"], " ".join(event["text"] for event in client.events), f"not homed: {seen}"]:
            expect_that(
                all(words in text for words in self.expect["refused"]), f"{self.expect['refused']} is not in: {text}"
            )
        client.go_on(REFUSING_S)
        expect_that(client.state["state"] == "DISABLED", f"DISABLED was expected, but: {brief(client.state)}")

    def clear(self, client):
        """The operator's clear, where there is a fault, and his enable, where ENABLED is expected after it."""
        wanted, reach_s = self.expect["after_clear"], self.stand.reach_s
        if self.scenario.numbers:
            client.call("state_command", command="clear")
            told = ("cleared", "booting goes on")  # the second: of drives that were not booted
            client.until(lambda _: any(text in event["text"] for event in client.events for text in told), reach_s)
        elif client.state["stop"]:
            client.call("state_command", command="clear")
            client.until(lambda state: not state["stop"], reach_s)
        if wanted != "FAULT":
            client.until(
                lambda state: state["state"] == "DISABLED" and state["is_homed"] and not state["faults"], reach_s
            )
        if wanted == "ENABLED":
            self.enabled_again = client.state["tick"]
            self.enable(client)
        client.go_on(self.stand.rested_s)
        expect_that(
            client.state["state"] == wanted, f"after the clear {wanted} was expected, but: {brief(client.state)}"
        )

    def judge_events(self, client):
        """What came besides, and what the arm got over, has been said."""
        told, texts = {number for number, _, _ in client.faults_told}, [event["text"] for event in client.events]
        for wanted in self.expect.get("also", []):
            expect_that(wanted in told, f"{wanted} was expected besides, but there were {sorted(told)}")
        for wanted in self.expect.get("events", []):
            expect_that(any(wanted in text for text in texts), f"no event says '{wanted}'; there were {texts}")

    def judge_delay(self, begun):
        """The fault was latched soon enough after the tick in which what causes it began."""
        took = self.latched - begun
        self.notes.append(f"{self.number} after {took} ticks")
        allowed = self.expect.get("within_ticks", took)
        expect_that(0 <= took <= allowed, f"latched {took} ticks after it began, allowed are {allowed}")


def expect_refused(client, when):
    """Neither enable nor a move is accepted."""
    asked = {"state_command": {"command": "enable"}, "move_jp": {"goal_deg": client.state["setpoint_js_deg"]}}
    for op, fields in asked.items():
        answer = client.ask(op, **fields)
        expect_that(answer["op"] == "error", f"{op} was accepted {when}: {answer}")
