"""One scenario: read it, run it on the embedded bus in lockstep, judge it (hil/scenarios/README.md)."""
import contextlib
import pathlib
import sys
import threading

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "system"))

import predicates  # noqa: E402
import trial  # noqa: E402
import wire_checks  # noqa: E402
from liana_system import System, brief, must  # noqa: E402
from scenario_file import BadScenario, Failed, check_fields, expect_that, read  # noqa: E402

kMoveDeg = 6.0
kEnabling_s = 75  # arm time; the pretension ramp has 60 s
kPathStop = 500  # ticks; twice what rest from full speed takes
kTravelDeg = 1.0  # of any angle from the fault to the end, where a scenario says nothing else
kRefusing_s = 2.0
kRested = 250  # ticks looked at after the end state, and after a clear

kFields = {
    "about": str,
    "during": str,
    "faults": list,
    "bus_script": list,
    "expect": dict,
    "reduced": bool,
    "host": dict,
    "start": dict,
    "time_limit_s": (int, float),
}
kStart = {"pose": str, "in_pose": str, "cross_wired": list}
kExpected = {
    "fault": (int, type(None)),
    "index": int,
    "detail": int,
    "within_ticks": int,
    "state": str,
    "stopped_within_ticks": int,
    "travel_deg": (int, float),
    "after_clear": str,
    "events": list,
    "late_commands": bool,
    "boot_order": bool,
    "also": list,
    "refused": list,
}
kHost = {"action": str, "program": str, "bytes": int}
kHostExpected = {"outcome": str, "says": list}
kDuring = ("boot", "rest", "move")
kTimeLimit_s = 300  # wall clock


class Scenario:
    def __init__(self, path):
        self.name = f"{path.parent.name}/{path.stem}"
        content = read(path)
        check_fields(self.name, content, kFields, ("about", "during", "expect"))
        expect = content["expect"]
        self.host, self.time_limit_s = content.get("host"), content.get("time_limit_s", kTimeLimit_s)
        if self.host is None:
            check_fields(f"{self.name}: expect", expect, kExpected, ("fault", "state"))
            self.check_fault(expect, content["during"])
        else:
            check_fields(f"{self.name}: host", self.host, kHost, ("action", "program"))
            check_fields(f"{self.name}: expect", expect, kHostExpected, ("outcome",))
        self.start = content.get("start", {})
        check_fields(f"{self.name}: start", self.start, kStart, ())
        if "refused" in expect and content["during"] != "boot":
            raise BadScenario(f"{self.name}: expect: refused is of an arm that is never enabled: during has to be boot")
        if content["during"] not in kDuring:
            raise BadScenario(f"{self.name}: during is {content['during']}; allowed are {', '.join(kDuring)}")
        self.during, self.expect = content["during"], expect
        self.faults, self.bus_script = content.get("faults"), content.get("bus_script")
        self.about, self.reduced = content["about"], content.get("reduced", False)

    def check_fault(self, expect, during):
        if expect["fault"] is not None and not {"index", "within_ticks"} <= expect.keys():
            raise BadScenario(f"{self.name}: expect: a fault needs index and within_ticks")
        if expect["fault"] is not None and during != "boot" and "stopped_within_ticks" not in expect:
            raise BadScenario(f"{self.name}: expect: a fault of an enabled arm needs stopped_within_ticks")

    def run(self):
        import host_run  # it builds on this file

        return Run(self) if self.host is None else host_run.HostRun(self)

    def strangers_nodes(self):
        """Nodes in whose name a scripted stranger speaks: what the log says of them is not what controller and drive
        said.
        """
        return [int(rule["id"], 16) & 0x7F for rule in self.bus_script or [] if rule["action"] == "send"]

    def fault_count(self):
        return (
            len(self.faults or [])
            + len(self.bus_script or [])
            + (self.host is not None)
            + ("cross_wired" in self.start)
        )

    def words(self):
        """What lianad and the bench are told of the start."""
        start = self.start
        bench = (["--start-pose", start["pose"], "--fixture"] if "pose" in start else []) + (
            ["--cross-wired", ",".join(map(str, start["cross_wired"]))] if "cross_wired" in start else []
        )
        return {"lianad": ["--in-pose", start["in_pose"]] if "in_pose" in start else [], "bench": bench}


def all_scenarios(folder=HERE):
    """In bring-up order."""
    return [Scenario(path) for path in sorted(folder.glob("[0-9]*/*.json"))]


class Run:
    """A scenario under way. `notes` says what was measured, `violations` which safety rules were broken."""

    def __init__(self, scenario):
        self.scenario, self.expect = scenario, scenario.expect
        self.latched = self.enabled_again = None  # ticks
        self.notes, self.violations, self.over_time = [], [], False

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

    def act(self):
        with System(
            expect="client,archive",
            faults=self.scenario.faults,
            bus_script=self.scenario.bus_script,
            **self.scenario.words(),
        ) as system:
            with self.limited(system):
                trial.start_archive(system)
                client = system.client()
                self.bring_up(client)
                self.watch(client)
                self.stay(client)
                if "refused" in self.expect:
                    self.judge_refusal(client)
                if "after_clear" in self.expect:
                    self.clear(client)
                end = client.state["tick"]
                self.judge_events(client)
                codes = system.shut_down(client)
            expect_that(set(codes.values()) == {0}, f"a program did not end well: {codes}")
            self.judge(system, end)
            self.judge_wire(system)
            recorded = trial.Trial(self.scenario.faults or [])
            recorded.judge(system, client.faults_told)
            self.violations += recorded.complaints

    def bring_up(self, client):
        must(client.ask("acquire"))
        refused = "refused" in self.expect
        client.until(lambda state: state["faults"] or (state["state"] != "BOOTING" and (state["is_homed"] or refused)))
        if self.scenario.during == "boot":
            return
        expect_that(not client.state["faults"], f"a fault before the arm was enabled: {brief(client.state)}")
        must(client.ask("state_command", command="enable"))
        client.until(lambda state: state["faults"] or (state["state"] == "ENABLED" and state["at_rest"]), kEnabling_s)
        if self.scenario.during == "move" and not client.state["faults"]:
            goal = list(client.state["setpoint_js_deg"])
            goal[8] -= kMoveDeg
            must(client.ask("move_jp", goal_deg=goal))

    def watch(self, client):
        """Goes on until the expected fault, or, when none is expected, until the motion has ended."""
        number = self.expect["fault"]
        if number is None:
            client.go_on(1.0)
            client.until(lambda state: state["faults"] or not state["is_busy"], 60)
            client.go_on(1.0)
            expect_that(not client.state["faults"], f"no fault was expected: {brief(client.state)}")
            return
        try:
            client.until(lambda state: any(fault["number"] == number for fault in state["faults"]), 60)
        except AssertionError:
            raise Failed(f"fault {number} was expected, but: {brief(client.state)}") from None
        first = client.state["faults"][0]
        self.latched = first["tick"]
        expect_that(
            (first["number"], first["index"]) == (number, self.expect["index"]),
            f"{number} of {self.expect['index']} was expected first, but: {brief(client.state)}",
        )
        if "detail" in self.expect:
            expect_that(
                first["detail"] == self.expect["detail"],
                f"detail {self.expect['detail']} was expected, but: {first['detail']}",
            )

    def stay(self, client):
        """The end state, for a second: nothing clears itself, and nothing moves or enables without a clear."""
        wanted = self.expect["state"]
        try:
            client.until(lambda state: state["state"] == wanted)
        except AssertionError:
            raise Failed(f"state {wanted} was expected, but: {brief(client.state)}") from None
        if self.latched is None:
            return
        end = client.state["tick"] + kRested
        client.until(lambda state: state["tick"] >= end)
        expect_that(
            client.state["state"] == wanted and client.state["faults"], f"the fault did not stay: {brief(client.state)}"
        )
        if wanted == "FAULT":
            for op, words in (
                ("state_command", {"command": "enable"}),
                ("move_jp", {"goal_deg": client.state["setpoint_js_deg"]}),
            ):
                answer = client.ask(op, **words)
                expect_that(answer["op"] == "error", f"{op} was accepted while a fault is latched: {answer}")

    def judge_refusal(self, client):
        """An arm that is not homed stays so and says why: to who wants to enable it, and to who only looks."""
        client.go_on(kRefusing_s)
        expect_that(not client.state["is_homed"], "the arm counts as homed")
        answer = client.ask("state_command", command="enable")
        expect_that(answer["op"] == "error", f"the arm was enabled: {answer}")
        for text in [answer["message"], " ".join(event["text"] for event in client.events)]:
            expect_that(
                all(words in text for words in self.expect["refused"]), f"{self.expect['refused']} is not in: {text}"
            )
        client.go_on(kRefusing_s)
        expect_that(client.state["state"] == "DISABLED", f"DISABLED was expected, but: {brief(client.state)}")

    def clear(self, client):
        wanted = self.expect["after_clear"]
        must(client.ask("state_command", command="clear"))
        client.until(lambda state: any("cleared" in event["text"] for event in state["events"]))
        if wanted != "FAULT":
            client.until(lambda state: state["state"] == "DISABLED" and not state["faults"])
        if wanted == "ENABLED":
            self.enabled_again = client.state["tick"]
            must(client.ask("state_command", command="enable"))
            client.until(lambda state: state["state"] == "ENABLED" and state["at_rest"])
        end = client.state["tick"] + kRested
        client.until(lambda state: state["tick"] >= end)
        expect_that(
            client.state["state"] == wanted, f"after the clear {wanted} was expected, but: {brief(client.state)}"
        )

    def judge_events(self, client):
        """What came besides, and what the arm got over, has been said."""
        told = {number for number, _, _ in client.faults_told}
        for wanted in self.expect.get("also", []):
            expect_that(wanted in told, f"{wanted} was expected besides, but there were {sorted(told)}")
        for wanted in self.expect.get("events", []):
            expect_that(
                any(wanted in event["text"] for event in client.events),
                f"no event says '{wanted}'; there were {[event['text'] for event in client.events]}",
            )

    def begun(self, system):
        """The slot in which the first fault began; 0 without one."""
        courses = system.json("bench_summary.json")["faults"]
        missing = [course["kind"] for course in courses if course["begun_slot"] is None]
        expect_that(not missing, f"never began: {', '.join(missing)}")
        slots = [course["begun_slot"] for course in courses] + [
            rule["from_slot"] for rule in self.scenario.bus_script or []
        ]
        return min(slots, default=0)

    def judge(self, system, end):
        begun, truth = self.begun(system), system.truth()
        period_s = 1.0 / system.json("buses.json")["rate_hz"]
        traffic = predicates.Traffic([path.read_text() for path in sorted(system.directory.glob("can*.log"))], period_s)
        for node in self.scenario.strangers_nodes():
            traffic.commands.pop(node, None), traffic.reports.pop(node, None)
        expect_that(
            self.scenario.during == "boot" or traffic.commands,
            "no command on the wire: the rules had nothing to look at",
        )
        self.violations += predicates.target_steps(
            traffic, predicates.step_limit_counts(system.json("robot.json"), period_s)
        )
        if "refused" in self.expect:
            self.violations += predicates.drives_with_torque(truth.column("enabled"), 0, end)
        if self.latched is None:
            return
        took = self.latched - begun
        self.notes.append(f"{self.expect['fault']} after {took} ticks")
        expect_that(
            0 <= took <= self.expect["within_ticks"],
            f"latched {took} ticks after it began, allowed are {self.expect['within_ticks']}",
        )
        self.violations += predicates.targets_that_move(traffic, self.latched + kPathStop, self.enabled_again or end)
        if self.expect["state"] == "FAULT":
            self.judge_stop(truth, traffic, self.enabled_again or end)
        travel, allowed = truth.travel_deg(begun, self.enabled_again or end), self.expect.get("travel_deg", kTravelDeg)
        self.notes.append(f"travel {travel:.3f} deg")
        expect_that(travel <= allowed, f"the arm travelled {travel:.2f} deg, allowed are {allowed}")

    def judge_wire(self, system):
        """As another decoder reads it."""
        logs = sorted(system.directory.glob("can*.log"))
        self.violations += wire_checks.malformed(logs)
        if self.expect.get("boot_order"):
            for bus, log in zip(system.json("buses.json")["buses"], logs):
                frames = wire_checks.decoded(log)
                self.violations += [
                    complaint for node in bus["nodes"] for complaint in wire_checks.boot_order(frames, node)
                ]

    def judge_stop(self, truth, traffic, end):
        stopped = self.latched + self.expect.get("stopped_within_ticks", 0)
        enabled = truth.column("enabled")
        last = max((slot for slot in range(self.latched, end) if enabled[slot] > 0), default=self.latched)
        self.notes.append(f"without torque after {last - self.latched} ticks")
        nodes = [1 + drive for drive in trial.self_reporting(self.scenario.faults or [], 15)]
        self.violations += predicates.drives_with_torque(enabled, stopped, end)
        if not self.expect.get(
            "late_commands"
        ):  # those that waited in a transmit queue switch nothing on, as truth shows
            self.violations += predicates.enabling_without_clear(traffic, stopped, end)
        self.violations += predicates.drums_that_move(traffic, stopped, end, nodes)
