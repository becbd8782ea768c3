#!/usr/bin/env python3
# req:A55
"""Faults while the arm is inside the slit, judged by the truth against targets written by hand (slit/targets.json).

An operator steers by hand (step 4), the arm goes planar (step 5), the operator steers to the rod (step 6), or the arm
is led back; it begins where slit/zhu2022_in_slit.lua puts it, so that the slit is reached within seconds. `slit.py
--kind cable_break --count 20` draws so many moments and drives by seed and prints what came of each as a table.
"""
import argparse
import collections
import contextlib
import concurrent.futures
import json
import math
import os
import random
import sys

import source_tree
import trial
from liana.client import ConnectionClosed, NotReached
from liana.system import System
from run_scenario import LimitedRun, outcome
from scenario_file import expect_that
from slit_truth import Aftermath

FOLDER = source_tree.SCENARIOS / "slit"
TARGETS = json.loads((FOLDER / "targets.json").read_text())
ROBOT = FOLDER / "zhu2022_in_slit.lua"
GOES_ON_S = 15.0  # arm time after the fault, for one that nothing has stopped
LED_BACK_S = 60.0  # and more, for one that is led back
FOREVER = 1000000

# Where it begins: pose and mission; `fault_slot`: well within what the moment is named for.
Moment = collections.namedtuple("Moment", "pose mission fault_slot")
MOMENTS = {
    "step4": Moment("entering", "onward.lua", 2200),
    "step5": Moment("entered", "onward.lua", 1700),
    "step6": Moment("inside", "onward.lua", 2600),
    "retract": Moment("entering", "back.lua", 3200),
    "mouth": Moment("mouth", "onward.lua", 1500),  # from here 10 mm aside leave room
}


def bench(kind, drive=None, **values):
    return {"kind": kind, **({} if drive is None else {"drive": drive + 1}), **values}


# What every kind is told; those of the bus are rules of its script.
FAULTS = {
    "cable_break": bench("cable_break", 13),
    "slack": bench("slack", 13),
    "cable_slip": bench("cable_slip", 10, length_m=0.0005),
    "encoder_jump": bench("encoder_jump", 10, counts=350),
    "motor_saturation": bench("motor_saturation", 10, tension_N=25),
    "silent": bench("silent", 13),
    "missing": bench("missing", 3),
    "reboot": bench("reboot", 8),
    "wrong_identity_after_reboot": bench("wrong_identity_after_reboot", 5),
    "late": bench("late", 6, cycles=10),
    "wrong_pdo_length": bench("wrong_pdo_length", 2),
    "fault": bench("fault", 10),
    "sto": bench("sto", 13),
    "emcy": bench("emcy", 4, code=0x4210),
    "stuck": bench("stuck", 12),
    "noisy": bench("noisy", 9, permille=200),
    "bus_lost": {"action": "drop", "bus": 0},
    "lianad_stands_still": {"action": "pause"},
    "camera_dropped": bench("camera_dropped"),
    "camera_frozen": bench("camera_frozen"),
    "camera_late": bench("camera_late", seconds=1.0),
    "camera_jump": bench("camera_jump", length_m=0.03),
    "camera_mirrored": bench("camera_mirrored"),
}
FIGURES = ("contact_N", "clearance_mm", "link_mm", "least_tension_N", "rest_s")
# What ./dev test runs, within two minutes of a processor.
REDUCED = {
    ("step4", "cable_slip"),
    ("step4", "silent"),
    ("step4", "lianad_stands_still"),
    ("step4", "camera_mirrored"),
    ("step5", "sto"),
    ("step6", "bus_lost"),
    ("step6", "camera_jump"),
    ("retract", "fault"),
}
REDUCED_BREAKS = {("step4", 13), ("step6", 14), ("retract", 12)}
SECOND_SLOTS = 500  # after the first: the arm is on its way back
PAUSE_SLOTS = 250  # a second; lianad_stands_still


class Slit:
    """Looks like a scenario to the program that runs them. `second`: a fault of the bench so many slots after the
    first; `offset`: MM,DEG of the scene.
    """

    def __init__(
        self, name, kind, moment, reduced=False, physics="nominal", seed=7331, drive=None, second=None, offset=""
    ):
        self.name, self.kind, self.moment, self.reduced = f"80_slit/{name}", kind, MOMENTS[moment], reduced
        self.physics, self.seed, self.offset = physics, seed, offset
        self.second = {**FAULTS[second], "when": {"after_first_slots": SECOND_SLOTS}} if second in FAULTS else None
        self.fault_slot, self.during, self.time_limit_s = self.moment.fault_slot, "move", 900
        self.fault = dict(FAULTS[kind]) if kind in FAULTS else None
        if drive is not None:
            self.fault["drive"] = drive + 1
        self.target = TARGETS["camera" if kind.startswith("camera") else kind]
        if second:  # what either may do
            worse = max(self.target["contact_N"], TARGETS[second]["contact_N"])
            self.target = {**self.target, "contact_N": worse}
        self.expect = {}

    def bench_faults(self):
        first = [{**self.fault, "at_slot": self.fault_slot}] if self.fault and "kind" in self.fault else []
        return first + ([self.second] if self.second else [])

    def bus_script(self):
        if not self.fault or "action" not in self.fault:
            return []
        last = self.fault_slot + PAUSE_SLOTS if self.fault["action"] == "pause" else FOREVER
        return [{**self.fault, "from_slot": self.fault_slot, "to_slot": last}]

    def fault_count(self):
        return len(self.bench_faults()) + len(self.bus_script())

    def run(self):
        return SlitRun(self)


class SlitRun(LimitedRun):
    """`aftermath`: what came of it."""

    aftermath = None

    def act(self):
        one = self.scenario
        words = ["--start-pose", one.moment.pose, "--jig", "--physics", one.physics, "--rest-within", 10]
        words += ["--scene-offset", one.offset] if one.offset else []
        told = ["--physics", one.physics]
        with System(
            expect="client,mission,operator,archive",
            robot=str(ROBOT),
            scene="panel_slit",
            faults=one.bench_faults(),
            bus_script=one.bus_script(),
            seed=one.seed,
            bench=words,
            lianad=told,
        ) as system:
            with self.limited(system):
                system.start_archive()
                client = system.client()
                system.start_operator()
                system.start_mission(FOLDER / one.moment.mission)
                self.watch(system, client)
                codes = {name: system.ended(name) for name in ("lianad", "liana-bus", "liana-bench")}
                expect_that(set(codes.values()) == {0}, f"a program did not end well: {codes}")
            self.judge(system, client)

    def watch(self, system, client):
        """Until lianad ends by itself, the arm at rest after its mission; what nothing has stopped is ended here."""
        with contextlib.suppress(ConnectionClosed):
            client.until(lambda state: state["tick"] > self.scenario.fault_slot, 200)
            with contextlib.suppress(NotReached):
                client.until(lambda state: client.is_ending, GOES_ON_S)
            if client.state["faults"] or not client.state["owner"] or self.scenario.moment.mission == "back.lua":
                with contextlib.suppress(NotReached):
                    client.until(lambda state: client.is_ending, LED_BACK_S)
            system.end_lianad(client)

    def judge(self, system, client):
        truth, robot = system.truth(), system.json("robot.json")
        period_s = 1.0 / system.json("buses.json")["rate_hz"]
        courses = system.json("bench_summary.json")["faults"]
        missing = [course["kind"] for course in courses if course["begun_slot"] is None]
        expect_that(not missing, f"never began: {', '.join(missing)}")
        expect_that(len(truth.rows) > self.scenario.fault_slot, "it was over before the fault could begin")
        depth_m = truth.column("slit_depth_m")[self.scenario.fault_slot]
        expect_that(depth_m > 0 or self.scenario.offset, f"the tip is {-depth_m:.2f} m before the slit")
        self.aftermath = Aftermath(truth, robot, self.scenario.fault_slot, period_s)
        self.notes.append(self.aftermath.note())
        numbers = sorted({number for number, _, _ in client.faults_told})
        self.notes.append(f"latched {numbers}, ends {client.state['state']}")
        self.violations += self.aftermath.complaints(self.scenario.target)
        recorded = trial.Trial(self.scenario.bench_faults(), self.scenario.bus_script())
        recorded.judge(system, client.faults_told)
        self.violations += recorded.complaints


def all_slit():
    """Every kind in every moment; drives in turn for a break; what else may be wrong besides."""
    found = []
    for moment in sorted(set(MOMENTS) - {"mouth"}):
        for kind in FAULTS:
            if kind == "cable_break" or (kind.startswith("camera") and moment in ("step5", "retract")):
                continue  # nobody looks through the camera there
            found.append(Slit(f"{moment}_{kind}", kind, moment, reduced=(moment, kind) in REDUCED))
        for drive in range(15):
            name = f"{moment}_cable_break_{drive}"
            found.append(Slit(name, "cable_break", moment, (moment, drive) in REDUCED_BREAKS, drive=drive))
    for physics in ("worn", "ideal"):
        found.append(Slit(f"step4_{physics}", "nothing", "step4", physics == "worn", physics))
        found.append(Slit(f"step6_{physics}_cable_break", "cable_break", "step6", physics=physics))
    for kind in ("silent", "cable_slip", "cable_break"):
        found.append(Slit(f"second_fault_after_slip_{kind}", "cable_slip", "step4", kind == "silent", second=kind))
    for seed in (1, 2, 3):
        found.append(Slit(f"misregistered_{seed}", "nothing", "mouth", seed == 1, seed=seed, offset="10,1"))
    return found


def draw(kind, count, seed):
    """So many seeded moments of one kind: pose, drive and slot."""
    choice = random.Random(f"{kind} {seed}")
    for i in range(count):
        moment = choice.choice(sorted(set(MOMENTS) - {"mouth"}))
        drive = choice.randrange(15) if "drive" in FAULTS[kind] else None
        one = Slit(f"{kind}_{i}_{moment}_{drive}", kind, moment, drive=drive, seed=choice.randrange(1, 10**6))
        one.fault_slot += choice.randrange(-200, 400) if moment in ("step4", "step6") else choice.randrange(0, 100)
        yield one


def row_of(one):
    run = one.run()
    result = outcome(run)
    return {"name": one.name, **result, **(vars(run.aftermath) if run.aftermath else {})}


def print_rows(wanted, figures, heads):
    """Runs them side by side and prints what came of each as a line of a table; the rows."""
    rows = []
    print(f"| scenario | {' | '.join(heads)} | why it failed |\n" + "|---" * (len(heads) + 2) + "|")
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        for row in pool.map(row_of, wanted):
            rows.append(row)
            text = " | ".join(f"{row.get(name, math.nan):.1f}" for name in figures)
            print(f"| {row['name']} | {text} | {row['why']} |", flush=True)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kind", choices=sorted(FAULTS), action="append", help="only these kinds (all)")
    parser.add_argument("--count", type=int, default=20, help="moments of each (20)")
    parser.add_argument("--seed", type=int, default=1, help="what moments and drives are drawn from (1)")
    parser.add_argument("--json", help="write all rows here")
    options = parser.parse_args()
    wanted = [one for kind in options.kind or FAULTS for one in draw(kind, options.count, options.seed)]
    rows = print_rows(wanted, FIGURES, ("contact N", "clearance mm", "link mm", "tension N", "rest s"))
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    return 1 if any(row["why"] for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
