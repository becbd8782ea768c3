"""Scenarios in which a program of the host is killed, stopped or starved while the arm moves (field `host`)."""
import os
import pathlib
import resource
import signal

import arms
import predicates
from embedded import TRAVEL_DEG
from liana.client import brief
from liana.drive_names import drive_text
from liana.system import System
from run_scenario import LimitedRun
from scenario_file import Failed, expect_that
from source_tree import SOURCE

ROLES = {
    "liana-archive": "client,archive",
    "liana-operator": "client,mission,operator",
}  # whom lianad waits for at its start
MISSIONS = SOURCE / "tests" / "system" / "missions"

MOVE_S = 0.5  # arm time: the move is well under way
RUN_ON = (
    750  # slots that the bench goes on alone when the bus has ended: drives that give torque damp until the arm rests
)
RUN_ON_S = 3.0
DEADLINE = 6  # slots until drives without targets have stopped: three periods, and the ramp
STILL_DEG = 1e-3
HOLD_S = 3.0  # arm time to come to rest on the path
MEMORY_MARGIN = 1 << 20


def fill_disk(system):
    """Every write of the recording fails with ENOSPC."""
    (system.directory / "ticks.mcap").symlink_to("/dev/full")


def starve(system, program):
    """No more memory than it has, and a megabyte."""
    pid = system.children[program].pid
    pages = int(pathlib.Path(f"/proc/{pid}/statm").read_text().split()[0])
    size = pages * resource.getpagesize()
    resource.prlimit(pid, resource.RLIMIT_AS, (size + MEMORY_MARGIN, size + MEMORY_MARGIN))


class HostRun(LimitedRun):
    """`expect.outcome`: drives_stop (nobody commands them any more), lianad_ends, holds, goes_on."""

    def act(self):
        host, outcome = self.scenario.host, self.expect["outcome"]
        expected = ROLES.get(host["program"], "client")
        with System(expect=expected, bench=("--run-on", RUN_ON_S), **arms.tables(self.scenario.robot)) as system:
            with self.limited(system):
                if host["action"] == "full_disk":
                    fill_disk(system)
                if host["program"] == "liana-archive":
                    system.start_archive()
                client = system.client()
                self.begin(system, client)
                self.strike(system, host)
                getattr(self, outcome)(system, client)
            for program, words in self.expect.get("says", []):
                expect_that(
                    words in system.log(program), f"{program} does not say '{words}' but: {system.log(program)[-500:]}"
                )
            self.violations += predicates.numbers_that_are_none(system.truth().rows)

    def begin(self, system, client):
        """The arm moves: by this client, or by a mission or an operator that is to die."""
        program, arm = self.scenario.host["program"], arms.ARMS[self.scenario.robot]
        if program in ("liana-mission", "liana-operator"):
            steers = program == "liana-operator"
            if steers:
                system.start_operator()
            system.start_mission(MISSIONS / ("steered.lua" if steers else arm.mission), lockstep=steers)
            client.until(
                lambda state: state["owner"] == "mission"
                and (state["device_engaged"] if steers else state["is_busy"])
                and not state["at_rest"],
                120,
            )
        else:
            client.enable()
            client.start_moving(joint=arm.joint)
        client.go_on(MOVE_S)
        expect_that(
            client.state["state"] == "ENABLED" and not client.state["faults"],
            f"the arm has to move: {brief(client.state)}",
        )

    def strike(self, system, host):
        if host["action"] == "kill":
            os.kill(system.children[host["program"]].pid, signal.SIGKILL)
        elif host["action"] == "no_memory":
            starve(system, host["program"])

    # ---- outcomes ----

    def drives_stop(self, system, client):
        """lianad is gone: the drives quick-stop by themselves, close their brakes, and nobody has torque any more."""
        with_error = False
        try:
            client.go_on(60)
        except OSError:
            with_error = True
        expect_that(with_error, "lianad still answers")
        for program in ("lianad", "liana-bus", "liana-bench"):
            system.ended(program)
        truth, summary = system.truth(), system.json("bench_summary.json")
        enabled = truth.column("enabled")
        last = max(slot for slot, count in enumerate(enabled) if count == len(summary["drives"]))
        self.notes.append(f"without torque after {last - (len(enabled) - RUN_ON)} ticks")
        expect_that(
            last <= len(enabled) - RUN_ON + DEADLINE,
            f"drives still have torque {last - (len(enabled) - RUN_ON)} ticks after the end",
        )
        expect_that(enabled[-1] == 0, f"{enabled[-1]:.0f} drives have torque at the end")
        for drive in summary["drives"]:
            expect_that(
                drive["quick_stops"] == 1 and drive["statusword"] & 0x6F == 0x40,
                f"{drive_text(drive['node'] - 1)} did not stop by itself: {drive}",
            )
        self.judge_travel(truth, last)

    def lianad_ends(self, system, client):
        """The other side of the bus is gone: lianad ends and says so."""
        try:
            client.go_on(60)
            raise Failed("lianad goes on without its bus")
        except OSError:
            pass
        code = system.ended("lianad")
        expect_that(code == 1, f"lianad ended with {code}")

    def holds(self, system, client):
        """Who steered is gone: the arm comes to rest on its path, keeps its tension, and moves for a new owner only."""
        before = client.state["tick"]
        client.until(lambda state: not state.get("device_engaged") and state["at_rest"], 60)
        client.go_on(HOLD_S)
        expect_that(
            client.state["state"] == "ENABLED" and not client.state["faults"],
            f"a hold was expected: {brief(client.state)}",
        )
        there = client.state["setpoint_js_deg"]
        client.go_on(1.0)
        crept = max(abs(now - then) for now, then in zip(client.state["setpoint_js_deg"], there))
        expect_that(crept < STILL_DEG, f"the arm moves by {crept:.5f} deg in a second though nobody steers")
        expect_that(
            any(word in event["text"] for event in client.events for word in ("died", "is gone")),
            f"no event names the dead: {client.events}",
        )
        system.shut_down(client)
        self.judge_travel(system.truth(), before, 3.0)

    def goes_on(self, system, client):
        """Motion needs nothing of what is gone: it comes to its end."""
        client.until(lambda state: state["faults"] or not state["is_busy"], 60)
        expect_that(
            client.state["state"] == "ENABLED" and not client.state["faults"],
            f"no fault was expected: {brief(client.state)}",
        )
        client.call("hold")
        codes = system.shut_down(client)
        expect_that(set(codes.values()) == {0}, f"a program did not end well: {codes}")
        program = self.scenario.host["program"]
        expect_that(
            program in codes or system.ended(program) != 0, f"{program} ended with 0 as if nothing had happened"
        )

    def judge_travel(self, truth, first, allowed_deg=TRAVEL_DEG):
        travel = truth.travel_deg(first, None)
        self.notes.append(f"travel {travel:.3f} deg")
        expect_that(travel <= allowed_deg, f"the arm travelled {travel:.2f} deg, allowed are {allowed_deg}")
