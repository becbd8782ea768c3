"""CAN interfaces in real time, with the light arm or real drives; judged by what the drives did."""
import abc
import math
import subprocess

from scenario_file import expect_that
from stand import Stand

MOVE_DEG = 2.0
TRAVEL_DEG = 1.0  # of any true angle in the last run without torque


class CanStand(Stand):
    """`start()` gives a CanSystem."""

    reach_s = enabling_s = fault_s = 20.0
    rested_s = 0.6

    def __init__(self):
        self.begin = 0  # the tick before the strike

    @abc.abstractmethod
    def start(self, scenario):
        """The system that the scenario runs in, not yet entered."""

    def client(self, system):
        return system.client()

    def start_move(self, client):
        # To and fro, where one scenario follows the other.
        client.start_moving(math.copysign(MOVE_DEG, client.state["setpoint_js_deg"][8]))

    def shell(self, system, lines):
        """The scenario's own commands; each must succeed."""
        for line in lines:
            call = ["bash", "-ec", line]
            done = subprocess.run(call, env=system.environment(), capture_output=True, text=True, check=False)
            expect_that(done.returncode == 0, f"`{line}` failed: {done.stderr.strip()}")

    def strike(self, run, system, client):
        self.begin = client.state["tick"] if client.state else 0
        self.shell(system, run.scenario.do)
        return self.start_again(run.scenario.restart, system, client)

    def start_again(self, name, system, client):
        """A program that was killed comes back, as an operator would start it."""
        if name is None:
            return client
        system.ended(name)
        if name != "lianad":
            system.start_bench()
            return client
        system.start_lianad()
        again = self.client(system)
        again.call("acquire")
        return again

    def mend(self, run, system):
        self.shell(system, run.scenario.mend)
        if run.scenario.numbers and "after_clear" in run.expect:
            system.clients[-1].go_on(self.rested_s)  # what was mended shows itself

    def judge(self, run, system, client):
        """Drives had torque as often as the operator enabled them, never again by themselves, and none at the end."""
        if run.latched is not None and run.scenario.restart:
            run.notes.append(f"{run.number}")  # starting a program takes what it takes
        elif run.latched is not None:
            run.judge_delay(self.begin)
        enabled, travel_deg = system.torque()
        rises = [slot for slot in range(1, len(enabled)) if enabled[slot] and not enabled[slot - 1]]
        allowed = run.enables if run.scenario.restart != "liana-bench" else 1
        expect_that(
            len(rises) == allowed,
            f"the drives got torque {len(rises)} times ({rises}), the operator enabled {allowed} times",
        )
        expect_that(not enabled[-1], "drives still have torque at the end")
        allowed_deg = run.expect.get("travel_deg", TRAVEL_DEG)
        expect_that(travel_deg <= allowed_deg, f"the arm travelled {travel_deg:.2f} deg without torque")
