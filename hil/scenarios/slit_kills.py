#!/usr/bin/env python3
"""Programs that are killed, and a lianad that stands still, while the arm is inside the slit, at moments drawn by seed:
the arm comes to rest beside no other place than those of its verified way. `slit_kills.py --count 200 --seed 1` prints
what came of each as a table.
"""
import argparse
import collections
import contextlib
import random
import sys

import predicates
from liana.client import ConnectionClosed, NotReached
from liana.system import System
from run_scenario import LimitedRun
from scenario_file import expect_that
from slit import FOLDER, MOMENTS, TARGETS, ROBOT, print_rows
from slit_truth import Aftermath, beside_way_m

VICTIMS = ("liana-operator", "liana-mission", "client", "liana-archive", "liana-bench", "liana-bus", "lianad", "stall")
STALLS = (1, 2, 3, 10, 125, 1000)  # slots
UNLED_S = 20.0  # arm time that whoever is left gets
REDUCED = len(VICTIMS)
SEED_OF_REDUCED = 1

Strike = collections.namedtuple("Strike", "victim moment slot stall seed")


def draw(count, seed):
    """Every victim in turn; moment, slot and length of a stall by seed."""
    choice = random.Random(f"kills {seed}")
    for i in range(count):
        moment = choice.choice(sorted(set(MOMENTS) - {"mouth"}))
        slot = MOMENTS[moment].fault_slot + choice.randrange(-200, 400)
        yield Strike(VICTIMS[i % len(VICTIMS)], moment, slot, choice.choice(STALLS), choice.randrange(1, 10**6))


def all_kills():
    """Looks like a list of scenarios to the program that runs them."""
    return [Kill(i, one, True) for i, one in enumerate(draw(REDUCED, SEED_OF_REDUCED))]


class Kill:
    """One strike as a scenario."""

    def __init__(self, number, strike, reduced):
        self.name = f"85_slit_kills/{number}_{strike.victim}_{strike.moment}"
        self.strike, self.reduced, self.time_limit_s, self.expect = strike, reduced, 900, {}
        self.target = TARGETS["killed"]

    def fault_count(self):
        return 1

    def run(self):
        return KillRun(self)


class KillRun(LimitedRun):
    """`way`: the angles that were told to the arm, as often as a client hears of them."""

    aftermath = None

    def __init__(self, scenario):
        super().__init__(scenario)
        self.way = []

    def script(self):
        one = self.scenario.strike
        rule = {"action": "pause", "from_slot": one.slot, "to_slot": one.slot + one.stall - 1}
        return [rule] if one.victim == "stall" else []

    def act(self):
        one = self.scenario.strike
        with System(
            expect="client,mission,operator,archive",
            robot=str(ROBOT),
            scene="panel_slit",
            bus_script=self.script(),
            seed=one.seed,
            bench=["--start-pose", MOMENTS[one.moment].pose, "--jig", "--rest-within", 10],
        ) as system:
            with self.limited(system):
                system.start_archive()
                client = system.client()
                bystander = system.client("bystander", lockstep=False)
                system.start_operator()
                system.start_mission(FOLDER / MOMENTS[one.moment].mission)
                client.until(lambda state: self.heard(state) and state["tick"] >= one.slot, 200)
                self.strike(system, bystander)
                self.watch(system, client)
            self.judge(system)

    def heard(self, state):
        """Keeps what the arm is told; always true."""
        if state["setpoint_js_deg"]:
            self.way.append(state["setpoint_js_deg"])
        return True

    def strike(self, system, bystander):
        victim = self.scenario.strike.victim
        if victim == "client":
            bystander.close()
        elif victim != "stall":
            system.kill(victim)

    def watch(self, system, client):
        """Whoever is left goes on for a while, and is ended."""
        with contextlib.suppress(ConnectionClosed, ConnectionError):
            with contextlib.suppress(NotReached):
                client.until(lambda state: self.heard(state) and client.is_ending, UNLED_S)
            system.end_lianad(client)
        for name in ("lianad", "liana-bus", "liana-bench"):
            system.ended(name)

    def judge(self, system):
        one, robot, target = self.scenario.strike, system.json("robot.json"), self.scenario.target
        if one.victim == "liana-bench":
            return  # the arm itself is gone: that nothing hangs is all that can be said
        truth, period_s = system.truth(), 1.0 / system.json("buses.json")["rate_hz"]
        expect_that(len(truth.rows) > one.slot, "it was over before anything could be killed")
        depth_m = truth.column("slit_depth_m")[one.slot]
        expect_that(depth_m > 0, f"the tip is {-depth_m:.2f} m before the slit")
        self.aftermath = Aftermath(truth, robot, one.slot, period_s)
        self.aftermath.tube_mm = 1e3 * beside_way_m(robot, truth, self.way)
        self.notes.append(f"{self.aftermath.note()}, {self.aftermath.tube_mm:.1f} mm beside its way")
        self.violations += self.aftermath.complaints(target)
        if self.aftermath.tube_mm > target["tube_mm"]:
            self.violations.append(
                f"rests {self.aftermath.tube_mm:.1f} mm beside its verified way, allowed are {target['tube_mm']}"
            )
        resting = truth.column("fastest_deg_s")[-1]
        if resting > target["rest_deg_s"]:
            self.violations.append(f"still moves by {resting:.2f} deg/s at the end")
        self.violations += predicates.numbers_that_are_none(truth.rows)


FIGURES = ("contact_N", "clearance_mm", "link_mm", "tube_mm", "rest_s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1, help="what is drawn from (1)")
    options = parser.parse_args()
    wanted = [Kill(i, one, False) for i, one in enumerate(draw(options.count, options.seed))]
    rows = print_rows(wanted, FIGURES, ("contact N", "clearance mm", "link mm", "beside its way mm", "rest s"))
    failed = sum(bool(row["why"]) for row in rows)
    print(f"{failed} of {len(wanted)} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
