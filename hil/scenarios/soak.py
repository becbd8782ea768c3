#!/usr/bin/env python3
"""Hours of arm time in one system in lockstep: `./dev soak --hours H [--seed N] [--json FILE]`.

The seed draws what the operator does (moves, streams, stops, missions that end or are broken off), and when drives or
camera fail. The programs live for the whole time; a new system begins only where the arm cannot be enabled again. Each
arm minute the anonymous memory of each program is read. At the end the archive must be whole, and no file, socket or
process may be left.

Exit code 0: all of this holds; 1: it does not; 2: bad input; 130: interrupted.
"""
import argparse
import collections
import json
import math
import os
import pathlib
import random
import re
import shutil
import signal
import stat
import sys
import tempfile
import time

import source_tree  # noqa: F401
from liana.client import Client, LianaError, NotReached
from liana.system import System, lua, run

LONG_LIVED = ("lianad", "liana-bus", "liana-bench", "liana-archive")
MAX_SLOPE_KB_H = 1.0
MIN_SAMPLES = 10  # that a slope is judged by
MAX_HOURS = 1000.0
INTERRUPTED = 130  # exit code of every program that was
SETTLING_H, SETTLING_SHARE = 1.0, 0.25  # memory may grow this long; of soaks below two hours this share
MINUTE_S, HOUR_S = 60.0, 3600.0
PROGRESS_S = 20.0  # wall time
READY_S = 900.0  # arm time in which a stopped or faulty arm has to be enabled again
SLOTS_PER_S = 250
FAULT_EVERY_S = (120, 480)
FIRST_FAULT_S = 60

# Faults that end, or that a clear ends: kind -> (values to choose from, whether it has a drive).
FAULTS = {
    "silent": ({"for_slots": (1, 10, 100)}, True),
    "missing": ({"for_slots": (100, 1000)}, True),
    "late": ({"for_slots": (10, 100), "cycles": (1, 3)}, True),
    "stuck": ({"for_slots": (1, 3)}, True),
    "wrong_pdo_length": ({"for_slots": (1, 10), "bytes": (0, 6)}, True),
    "emcy": ({"code": (0x1000, 0x8110)}, True),
    "fault": ({"code": (0x2310, 0x7305)}, True),
    "reboot": ({}, True),
    "camera_dropped": ({"for_slots": (50, 500)}, False),
    "camera_frozen": ({"for_slots": (50, 500)}, False),
    "camera_late": ({"for_slots": (50, 500)}, False),
}
DRIVES = 15
ACTS = {"moves": 4, "stream": 3, "tracker_tour": 1, "slit_crossing": 2}  # with weights
# A crossing ends before its last step: the rod can be removed once only.
BREAK_OFF_S = {"tracker_tour": (20, 240), "slit_crossing": (10, 150)}
BREAKS = (("stop", {}), ("mission_control", {"command": "abort"}))
FIRST_ACTS = ("slit_crossing", "tracker_tour")  # as long as allowed: later ones should need no more memory


class TimeIsUp(Exception):
    """The hours are over."""


class CannotGoOn(Exception):
    """The arm could not be enabled again; the text says in which state it stayed."""


def fault_list(draw, seconds):
    """Faults over that much arm time."""
    faults, at_s = [], FIRST_FAULT_S + draw.uniform(*FAULT_EVERY_S) / 2
    while at_s < seconds:
        kind = draw.choice(sorted(FAULTS))
        values, has_drive = FAULTS[kind]
        fault = {"kind": kind, "at_slot": round(at_s * SLOTS_PER_S)}
        fault.update({name: draw.choice(of) for name, of in values.items()})
        faults.append({**fault, "drive": draw.randint(1, DRIVES)} if has_drive else fault)
        at_s += draw.uniform(*FAULT_EVERY_S)
    return faults


# ---- memory ----


def anonymous_kB(pid):
    """Memory of this process that belongs to no file, in RAM or swapped out; None where the process has ended."""
    try:
        text = pathlib.Path(f"/proc/{pid}/smaps_rollup").read_text()
    except OSError:
        return None
    return sum(int(kB) for kB in re.findall(r"^(?:Anonymous|Swap):\s+(\d+) kB", text, re.M))


def slope_of(points):
    """Least squares through (hours, kB): slope and its standard error [kB/h]; at least three points."""
    count = len(points)
    middle_h, middle_kB = (sum(point[i] for point in points) / count for i in (0, 1))
    spread = sum((hours - middle_h) ** 2 for hours, _ in points)
    slope = sum((hours - middle_h) * (kB - middle_kB) for hours, kB in points) / spread
    rest = sum((kB - middle_kB - slope * (hours - middle_h)) ** 2 for hours, kB in points)
    return slope, math.sqrt(rest / (count - 2) / spread)


def settled(points, asked_hours):
    """Those that count: after the first hour, or after the first quarter where less than two hours were asked for."""
    from_h = SETTLING_H if asked_hours >= 2 * SETTLING_H else SETTLING_SHARE * asked_hours
    return [point for point in points if point[0] >= from_h]


def judge_memory(points, asked_hours):
    """A program's row. It grows where the slope less two standard errors is over 1 kB/h."""
    counted = settled(points, asked_hours)
    row = {
        "samples": len(points),
        "first_kB": points[0][1],
        "last_kB": points[-1][1],
        "max_kB": max(kB for _, kB in points),
        "kB": [kB for _, kB in points],
    }
    if len(counted) < MIN_SAMPLES:
        return {**row, "slope_kB_h": None, "error_kB_h": None, "grows": None}
    slope, error = slope_of(counted)
    return {**row, "slope_kB_h": slope, "error_kB_h": error, "grows": slope - 2 * error > MAX_SLOPE_KB_H}


# ---- one life of a system ----


class SoakSystem(System):
    """Without what would fill a disk: traffic of the buses, truth and recording of every tick."""

    def traffic_of_bus(self):
        return []

    def reports_of_bench(self):
        return ["--summary", self.directory / "bench_summary.json"]

    def start_archive(self):
        self.start("liana-archive", "--api", self.api, "--archive", self.directory)


class Operator(Client):
    """Looks at the memory every arm minute, and ends when the time is up."""

    def watch(self, each_minute, end_s):
        self.each_minute, self.end_s, self.minute = each_minute, end_s, 0

    def _keep_state(self, state):
        super()._keep_state(state)
        del self.events[:-100]
        if not hasattr(self, "end_s"):
            return
        if state["time_s"] >= MINUTE_S * self.minute:
            self.minute += 1
            self.each_minute(state["time_s"])
        if state["time_s"] >= self.end_s:
            raise TimeIsUp


class Life:
    """One system from its start to its end, and what happened in it."""

    def __init__(self, number, seed, seconds, say):
        self.number, self.seconds, self.say = number, seconds, say
        self.draw = random.Random(f"{seed}.{number}")
        self.faults = fault_list(self.draw, seconds)
        self.seed = seed + number
        self.memory = collections.defaultdict(list)
        self.counts = collections.Counter()
        self.lived_s, self.why, self.problems, self.archive = 0.0, "", [], {}

    def live(self):
        with SoakSystem(expect="client,archive,camera", faults=self.faults, seed=self.seed) as self.system:
            self.system.start_archive()
            self.client = Operator(self.system.api, "soak", lockstep=True, check=self.system.check_refused)
            self.system.clients.append(self.client)
            self.client.watch(self.sample, self.seconds)
            try:
                self.operate()
            except TimeIsUp:
                self.why = "time is up"
            except CannotGoOn as error:
                self.why = str(error)
            self.lived_s = self.client.state["time_s"]
            self.end()

    def sample(self, time_s):
        for name in LONG_LIVED:
            kB = anonymous_kB(self.system.children[name].pid)
            if kB is None:
                raise LianaError(f"{name} has ended: {self.system.log(name)[-300:]}")
            self.memory[name].append((time_s / HOUR_S, kB))
        self.say(self, time_s)

    def end(self):
        """Ends the system; what is not as it should be then goes to `problems`."""
        self.client.end_s = math.inf
        codes = self.system.shut_down(self.client)
        codes["liana-archive"] = self.system.children["liana-archive"].returncode
        self.end_mission()
        self.problems += [f"{name} ended with {code}" for name, code in codes.items() if code != 0]
        done = run("liana", "log", "verify", self.system.directory, "--json", timeout=3600)
        self.archive = json.loads(done.stdout)
        if done.returncode != 0:
            self.problems.append(f"the archive is not whole: {self.archive.get('problems', self.archive)}")
        sockets = [path.name for path in self.system.directory.rglob("*") if stat.S_ISSOCK(path.lstat().st_mode)]
        self.problems += [f"socket {name} is left" for name in sockets]
        summary = self.system.json("bench_summary.json")
        self.counts["faults"] = sum(course["begun_slot"] is not None for course in summary["faults"])

    # ---- what the operator does ----

    def operate(self):
        first = list(FIRST_ACTS)
        while True:
            self.make_ready()
            act = first.pop(0) if first else self.draw.choices(list(ACTS), list(ACTS.values()))[0]
            self.counts[act] += 1
            if act in BREAK_OFF_S:
                self.mission(act)
            else:
                getattr(self, act)()

    def make_ready(self):
        """Clears, enables and leads the arm back to where it began."""
        end_s = (self.client.state or self.client.step())["time_s"] + READY_S
        came_back = False
        while True:
            state = self.client.state
            if state["time_s"] > end_s:
                raise CannotGoOn(f"{state['state']}, faults {sorted({f['number'] for f in state['faults']})}")
            if state["owner"] != "soak":
                self.client.ask("acquire")
            elif state["faults"] or state["stop"]:
                self.counts["clears"] += self.client.ask("state_command", command="clear")["op"] == "ok"
            elif state["state"] == "DISABLED":
                self.client.ask("state_command", command="enable" if state["is_homed"] else "home")
            elif state["state"] == "ENABLED" and state["at_rest"] and not state["is_busy"]:
                if came_back:
                    return
                came_back = self.come_back()
                continue
            self.client.go_on(0.5)

    def come_back(self):
        """Along the verified path; true where it has come back, or where there is no path."""
        if self.client.ask("retract")["op"] == "error":
            return True
        self.counts["retracts"] += 1
        self.client.step()
        try:
            state = self.client.until(lambda state: state["retract"]["phase"] in ("done", "ended"), READY_S)
        except NotReached:
            return False
        return state["retract"]["phase"] == "done"

    def rest(self, limit_s=60.0):
        """Until the arm is at rest, or no longer enabled."""
        try:
            self.client.go_on(0.1)
            self.client.until(lambda state: state["state"] != "ENABLED" or not state["is_busy"], limit_s)
        except NotReached:
            self.client.ask("hold")

    def moves(self):
        for _ in range(self.draw.randint(1, 6)):
            goal = list(self.client.state["setpoint_js_deg"])
            for theta in self.draw.sample(range(len(goal)), self.draw.randint(1, 3)):
                goal[theta] += self.draw.uniform(-3, 3)
            words = {"goal_deg": goal} if self.draw.random() < 0.8 else {"goal_deg": self.named_pose()}
            self.counts["refused moves"] += self.client.ask("move_jp", **words)["op"] == "error"
            if self.draw.random() < 0.1:
                self.client.go_on(self.draw.uniform(0.1, 3))
                self.counts["stops"] += self.client.ask("stop")["op"] == "ok"
                return
            self.rest()

    def named_pose(self):
        poses = self.system.robot_table["named_poses_deg"]
        return poses[self.draw.choice(sorted(poses))]

    def stream(self):
        """A stream of tip goals around where the tip is."""
        pose = list(self.client.state["setpoint_cp"])
        size_m, period_s = self.draw.uniform(0.005, 0.03), self.draw.uniform(8, 20)
        begin_s = self.client.state["time_s"]
        end_s = begin_s + self.draw.uniform(5, 40)
        while self.client.state["time_s"] < end_s and self.client.state["state"] == "ENABLED":
            angle = 2 * math.pi * (self.client.state["time_s"] - begin_s) / period_s
            goal = [pose[0], pose[1] + size_m * math.sin(angle), pose[2] + size_m * (1 - math.cos(angle)), *pose[3:]]
            self.client.ask("servo_cp", goal=goal)
            self.client.step()
        self.client.ask("hold")
        self.rest()

    def mission(self, name):
        """A mission that ships; a stop or the operator breaks it off, the arm wherever it is, if it still runs then."""
        self.client.ask("release")
        steers = name == "slit_crossing"
        if steers:
            self.system.start_operator()
        self.system.start_mission(lua() / "missions" / f"{name}.lua")
        ended = self.system.children["liana-mission"]
        low_s, high_s = BREAK_OFF_S[name]
        after_s = self.draw.uniform(low_s, high_s) if self.counts[name] > 1 else high_s
        break_s = self.client.state["time_s"] + after_s
        while ended.poll() is None:
            self.client.step()
            if self.client.state["time_s"] >= break_s:
                op, fields = self.draw.choice(BREAKS)
                self.client.ask(op, **fields)
                break_s = math.inf
        self.counts[f"{name}: {self.system.json('mission.json')['outcome']}"] += 1
        self.end_mission()

    def end_mission(self):
        """The person at the hand controllers leaves with the mission."""
        for name in ("liana-operator", "liana-mission"):
            child = self.system.children.pop(name, None)
            if child is not None and child.poll() is None:
                child.terminate()
            if child is not None:
                child.wait()


# ---- the whole ----


def left_behind(folder):
    """Files in the folder that everything ran in, and processes that know of it."""
    found = [f"file {path.relative_to(folder)}" for path in sorted(folder.rglob("*")) if not path.is_dir()]
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (process / "cmdline").read_bytes()
        except OSError:
            continue
        if os.fsencode(folder) in words and int(process.name) != os.getpid():
            found.append(f"process {process.name}: {words.split(bytes(1))[0].decode(errors='replace')}")
    return found + [f"shared memory {name}" for name in os.listdir("/dev/shm") if name.startswith("liana")]


class Soak:
    def __init__(self, hours, seed):
        self.hours, self.seed, self.lives = hours, seed, []
        self.begun, self.said = time.monotonic(), 0.0

    def say(self, life, time_s):
        """A line on standard error, at most one each 20 s."""
        now = time.monotonic()
        if now - self.said < PROGRESS_S:
            return
        self.said = now
        done_h = (sum(each.lived_s for each in self.lives) + time_s) / HOUR_S
        left_s = (now - self.begun) * (self.hours - done_h) / done_h if done_h > 0 else 0
        sizes = ", ".join(f"{name} {points[-1][1]} kB" for name, points in life.memory.items())
        rest = f"about {left_s / MINUTE_S:.0f} min left" if done_h > 0 else "it begins"
        print(f"soak: {done_h:.2f} of {self.hours:g} h, {rest}; {sizes}", file=sys.stderr, flush=True)

    def go(self, folder):
        """All lives, until the hours are over; the result as JSON."""
        left_s = self.hours * HOUR_S
        while left_s > 0:
            life = Life(len(self.lives), self.seed, left_s, self.say)
            life.live()
            self.lives.append(life)
            left_s -= max(life.lived_s, MINUTE_S)
        return self.result(left_behind(folder))

    def result(self, left):
        memory = [
            {"life": life.number, "program": name, **judge_memory(points, self.hours)}
            for life in self.lives
            for name, points in life.memory.items()
        ]
        problems = [problem for life in self.lives for problem in life.problems] + [f"left: {what}" for what in left]
        problems += [
            f"{row['program']} grows by {row['slope_kB_h']:.2f} +- {row['error_kB_h']:.2f} kB/h"
            for row in memory
            if row["grows"]
        ]
        return {
            "hours": self.hours,
            "seed": self.seed,
            "wall_s": time.monotonic() - self.begun,
            "lives": [{"hours": life.lived_s / HOUR_S, "ended_by": life.why} for life in self.lives],
            "counts": dict(sorted(sum((life.counts for life in self.lives), collections.Counter()).items())),
            "memory": memory,
            "archives": [{key: life.archive.get(key) for key in ("whole", "bytes", "lives")} for life in self.lives],
            "problems": problems,
            "passed": not problems,
        }


def in_words(result):
    lines = [f"{result['hours']:g} h of arm time in {result['wall_s']:.0f} s, {len(result['lives'])} system(s)"]
    lines += [f"  ended after {life['hours']:.2f} h: {life['ended_by']}" for life in result["lives"]]
    lines.append("counts: " + ", ".join(f"{name} {count}" for name, count in result["counts"].items()))
    for row in result["memory"]:
        slope = (
            "too short to judge" if row["grows"] is None else f"{row['slope_kB_h']:.2f} +- {row['error_kB_h']:.2f} kB/h"
        )
        lines.append(f"memory of {row['program']}: {row['first_kB']} to {row['last_kB']} kB, slope {slope}")
    lines += [f"FAILED: {problem}" for problem in result["problems"]]
    return "\n".join([*lines, "passed" if result["passed"] else "not passed"])


def hours_of(word):
    try:
        hours = float(word)
    except ValueError:
        hours = math.nan
    if not 0 < hours <= MAX_HOURS:
        raise argparse.ArgumentTypeError(f"'{word}': allowed is a number over 0, at most {MAX_HOURS:g} [h]")
    return hours


def refuse(text):
    """One line says what is wrong."""
    print(f"soak: {text}", file=sys.stderr)
    sys.exit(2)


def arguments():
    parser = argparse.ArgumentParser(
        prog="./dev soak", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.error = refuse
    parser.add_argument(
        "--hours", type=hours_of, required=True, metavar="H", help="arm time; 24 takes hours of wall time"
    )
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="what the operator does and what fails (1)")
    parser.add_argument("--json", metavar="FILE", help="also write the result there")
    parser.add_argument("--check", action="store_true", help="only look at these options")
    options = parser.parse_args()
    if options.json and not pathlib.Path(options.json).absolute().parent.is_dir():
        parser.error(f"--json: {options.json} cannot be written; give a file in a folder that exists")
    return options


def main():
    options = arguments()
    if options.check:
        return 0
    folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-soak-"))
    tempfile.tempdir = str(folder)
    for name in ("TMPDIR", "XDG_RUNTIME_DIR", "XDG_STATE_HOME"):
        os.environ[name] = str(folder)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        result = Soak(options.hours, options.seed).go(folder)
    except (LianaError, OSError) as error:
        print(f"soak: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("soak: interrupted; nothing was judged", file=sys.stderr)
        return INTERRUPTED
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(result, indent=1) + "\n")
    print(in_words(result))
    return 0 if result["passed"] else 1


if __name__ == "__main__":
    sys.exit(main())
