"""Programs that are killed, buses that go and a lianad that stands still, in real time, while a mission has the arm
inside the slit, at moments drawn by seed: the arm comes to rest beside no other place than those it was told.
slit_kills.py, one folder up, does the same in lockstep, with the arm's inertia and contacts, which the light arm of
this folder has not.
"""
import collections
import contextlib
import random
import subprocess
import time

import predicates
from can.system import BenchOnCan
from liana.client import ConnectionClosed, NotReached
from run_scenario import LimitedRun
from scenario_file import expect_that
from slit import FOLDER, ROBOT, MOMENTS, TARGETS
from slit_truth import beside_way_m

KIND = "vcan"
VICTIMS = ("liana-operator", "liana-mission", "client", "liana-archive", "bus", "lianad", "stall")
STALLS_S = (0.005, 0.02, 0.1, 1.0)
COUNT = 20
SEED = 1
REDUCED = 1
MOVING_S = 30.0  # until the mission has begun to move the arm
UNLED_S = 3.0  # that whoever is left gets; every stop is over in half of it

Strike = collections.namedtuple("Strike", "victim moment after_s stall_s bus seed")


def draw(count, seed):
    """Every victim in turn; moment, time after the first motion, length of a stall and bus by seed."""
    choice = random.Random(f"real kills {seed}")
    for i in range(count):
        moment, after_s = choice.choice(("step4", "step6", "retract")), choice.uniform(0.2, 3.0)
        stall_s, bus = choice.choice(STALLS_S), choice.randrange(2)
        yield Strike(VICTIMS[i % len(VICTIMS)], moment, after_s, stall_s, bus, choice.randrange(1, 10**6))


def all_real_kills():
    return [RealKill(i, one) for i, one in enumerate(draw(COUNT, SEED))]


class RealKill:
    """One strike; looks like a CanScenario."""

    on, only_in_vm, expect = (KIND,), False, {}

    def __init__(self, number, strike):
        self.name = f"can/40_slit_kills/{number}_{strike.victim}_{strike.moment}"
        self.strike, self.reduced, self.time_limit_s = strike, number < REDUCED, 300
        self.target = TARGETS["killed"]

    def fault_count(self):
        return 1

    def run(self, _):
        return RealKillRun(self)


class RealKillRun(LimitedRun):
    """`way`: the angles that were told to the arm, as often as a client hears of them."""

    def __init__(self, scenario):
        super().__init__(scenario)
        self.way = []

    def act(self):
        moment = MOMENTS[self.scenario.strike.moment]
        words = ["--start-pose", moment.pose]
        with BenchOnCan(
            KIND, robot=str(ROBOT), scene="panel_slit", seed=self.scenario.strike.seed, bench=words
        ) as system:
            with self.limited(system):
                system.start_archive()
                client, bystander = system.client(), system.client(name="bystander")
                system.start_operator(lockstep=False)
                system.start_mission(FOLDER / moment.mission, lockstep=False)
                client.until(lambda state: self.heard(state) and state["is_busy"] and not state["at_rest"], MOVING_S)
                self.watch(client, self.scenario.strike.after_s)
                expect_that(not client.state["faults"], f"a fault before the strike: {client.state['faults']}")
                self.strike(system, bystander)
                self.watch(client, UNLED_S)
                self.end(system, client)
            self.judge(system)

    def heard(self, state):
        """Keeps what the arm is told; always true."""
        if state["setpoint_js_deg"]:
            self.way.append(state["setpoint_js_deg"])
        return True

    def watch(self, client, seconds):
        """Listens for so long, to whoever is left."""
        end = time.monotonic() + seconds
        with contextlib.suppress(ConnectionClosed, ConnectionError, NotReached):
            client.until(lambda state: self.heard(state) and time.monotonic() > end, 2 * seconds)
        time.sleep(max(0.0, end - time.monotonic()))

    def strike(self, system, bystander):
        one = self.scenario.strike
        if one.victim == "client":
            bystander.close()
        elif one.victim == "bus":
            subprocess.run(["ip", "link", "set", system.ours[one.bus], "down"], check=True)
        elif one.victim == "stall":
            system.stand_still("lianad", one.stall_s)
        else:
            system.kill(one.victim)

    def end(self, system, client):
        with contextlib.suppress(ConnectionClosed, ConnectionError):
            system.end_lianad(client)
        system.ended("lianad")
        system.end_drives()

    def judge(self, system):
        truth, robot, target = system.truth(), system.json("robot.json"), self.scenario.target
        with_torque, _ = system.torque()
        begin = with_torque.index(True)
        depth_m = max(truth.column("slit_depth_m")[begin:])
        beside_mm = 1e3 * beside_way_m(robot, truth, self.way)
        self.notes.append(f"{depth_m:.2f} m inside, {beside_mm:.1f} mm beside its way")
        expect_that(depth_m > 0, f"the tip is {-depth_m:.2f} m before the slit")
        if beside_mm > target["tube_mm"]:
            self.violations.append(f"rests {beside_mm:.1f} mm beside its way, allowed are {target['tube_mm']}")
        resting = truth.column("fastest_deg_s")[-1]
        if resting > target["rest_deg_s"]:
            self.violations.append(f"still moves by {resting:.2f} deg/s at the end")
        self.violations += predicates.numbers_that_are_none(truth.rows)
