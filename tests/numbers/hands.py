"""Hands that nobody has looked at, each drawn from its seed, lead a cable arm on the bench for 10 s: waves, chirps, steps,
walks and tempers (to and fro, with tremor, letting go and gripping in motion), along and about any axis, asking the tip for
up to 3 times the speeds of the robot's table and up to 10 times its accelerations. They begin at the poses that the robot's
table names, or with --corners where all of its angles are bent at 0.6 of their limits and more.

Alone: hands.py [--bin DIR] [--count HANDS] [--first SEED] [--corners] [--json].
"""
import functools
import json
import math
import random

import folders  # makes what follows importable
import seeds
from liana import System
from liana import system as tables
from liana.devices import Device
from page import table

HANDS = 120
FIRST_SEED = 210001
ARMS = (("zhu2022", "embedded"), ("three_segment_lab", "embedded_three_segment_lab"))  # whose tips have six freedoms
KINDS = ("wave", "chirp", "steps", "walk", "temper")
MOVES_S, RETURNS_S, ENDS_S = 6.5, 8.0, 10.0  # then back to where the hand began, then still
FASTER, HARDER = 3.0, 10.0  # than the table, at most
REACH = 0.06  # of the arm's length, to either side
REACH_DEG = 30.0
TREMOR_M, TREMOR_HZ = 0.0005, (8.0, 12.0)
INTERVAL_S, STEP_S = 0.02, 0.001
AFTER_FAULT_S = 1.0
CORNER_SHARE = 0.6
LAG_MOST_S, LAG_LEAST_WAY_M = 2.0, 0.01
STILL_M = 1e-4  # in ten intervals


class Follower:
    """One coordinate that goes to where it is told within a speed and an acceleration."""

    def __init__(self, speed, accel):
        self.x = self.v = 0.0
        self.speed, self.accel = speed, accel

    def step(self, target):
        off = target - self.x
        wish = math.copysign(min(self.speed, math.sqrt(2 * self.accel * abs(off)), abs(off) / STEP_S), off)
        change = self.accel * STEP_S
        self.v += max(-change, min(change, wish - self.v))
        self.x += self.v * STEP_S
        return self.x


def oscillation(kind, speed, accel, reach):
    """A function of time that stays within all three; a chirp comes to its fastest at the end of its motion."""
    reach = min(reach, speed * speed / accel)
    rate = min(speed / reach, math.sqrt(accel / reach))
    phase = (lambda t: rate * t) if kind == "wave" else (lambda t: rate * (0.2 * t + 0.4 * t * t / MOVES_S))
    return lambda t: reach * (1 - math.cos(phase(t)))


def way_of(kind, draw, speed, accel, reach):
    """The coordinate for every millisecond of ENDS_S."""
    follower = Follower(speed, accel)
    told = oscillation(kind, speed, accel, reach / 2) if kind in ("wave", "chirp") else None
    target, until_s, way = 0.0, 0.0, []
    for k in range(round(ENDS_S / STEP_S)):
        t = k * STEP_S
        if t >= MOVES_S:
            target = 0.0
        elif told:
            target = told(t)
        elif t >= until_s:
            target = draw.uniform(-reach, reach) if kind == "walk" else math.copysign(reach, -target or 1.0)
            until_s = t + (draw.uniform(0.1, 0.8) if kind != "steps" else draw.uniform(0.5, 2.0))
        way.append(round(follower.step(target), 9))
    return way


def direction(draw):
    v = [draw.gauss(0, 1) for _ in range(3)]
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def let_go_times(draw):
    """Half of the tempers let go once in motion, for 0.05 to 0.6 s."""
    if draw.random() < 0.5:
        return (0.0, 0.0)
    start = draw.uniform(1.0, MOVES_S - 1.5)
    return (start, start + draw.uniform(0.05, 0.6))


class Hand:
    """What a seed draws: the arm, where it begins, and what the hand does."""

    def __init__(self, seed, in_corner=False):
        draw = random.Random(f"hand {seed}")
        self.in_corner = in_corner
        self.seed, self.kind = seed, draw.choice(KINDS)
        self.robot, self.bus = draw.choice(ARMS)
        self.physics = draw.choice(("nominal", "worn"))
        self.pose_share, self.scale = draw.random(), draw.choice((1.0, 2.0, 4.0))
        self.hz = draw.choice((90, 250, 1000))
        self.faster, self.harder = draw.uniform(0.3, FASTER), math.exp(draw.uniform(math.log(0.5), math.log(HARDER)))
        self.moves = draw.choice(("way", "way", "turn", "both"))
        self.axis, self.turn_axis = direction(draw), direction(draw)
        self.open_s = let_go_times(draw) if self.kind == "temper" else (0.0, 0.0)
        self.tremor = [(draw.uniform(*TREMOR_HZ), draw.uniform(0, 2 * math.pi)) for _ in range(3)]
        self.draw = draw

    def plan(self, robot):
        """The ways that are asked of the tip, m and deg, within so many times what the table allows."""
        limits, segments = robot["limits"], robot["segments"]
        length_m = sum(segment["modules"] * segment["module_length_m"] for segment in segments)
        self.way_m, self.way_deg = [0.0] * round(ENDS_S / STEP_S), [0.0] * round(ENDS_S / STEP_S)
        if self.moves != "turn":
            speed, accel = self.faster * limits["tip_speed_m_s"], self.harder * limits["tip_accel_m_s2"]
            self.way_m = way_of(self.kind, self.draw, speed, accel, REACH * length_m)
        if self.moves != "way":
            speed, accel = self.faster * limits["tip_rate_deg_s"], self.harder * limits["tip_angular_accel_deg_s2"]
            self.way_deg = way_of(self.kind, self.draw, speed, accel, REACH_DEG)

    def pose_of(self, robot):
        if self.in_corner:
            return ",".join(f"{deg:.1f}" for deg in self.corner(robot["segments"]))
        poses = sorted(robot["named_poses_deg"])
        return poses[int(self.pose_share * len(poses))]

    def corner(self, segments):
        """Neighbouring segments bend to opposite sides, so that the arm does not meet itself."""
        draw, sides = random.Random(f"corner {self.seed}"), [1, 1]
        for segment in segments:
            for k in range(2):
                sides[k] = -sides[k] if draw.random() < 0.8 else sides[k]
                yield sides[k] * draw.uniform(CORNER_SHARE, 1.0) * segment["theta_limit_deg"]

    def has_grip(self, t):
        return not self.open_s[0] <= t < self.open_s[1]

    def pose(self, t):
        """Of the hand, t seconds after it began; it trembles while a temper moves."""
        k = min(len(self.way_m) - 1, max(0, round(t / STEP_S)))
        place = [self.way_m[k] / self.scale * a for a in self.axis]
        if self.kind == "temper" and 0 < t < MOVES_S:
            place = [x + TREMOR_M * math.sin(2 * math.pi * hz * t + p) for x, (hz, p) in zip(place, self.tremor)]
        half = math.radians(self.way_deg[k]) / 2
        return [*place, math.cos(half), *(math.sin(half) * a for a in self.turn_axis)]


class Session:
    """One hand at one arm, in lockstep."""

    def __init__(self, system, hand):
        self.hand, self.client = hand, system.client()
        self.client.enable()
        self.device = Device(f"{system.api}.devices", "drawn", "hand", hand.hz, self.now_us())
        self.client.step()
        self.device.receive(self.now_us())
        self.client.call("use_device", device="hand", scale=hand.scale)
        self.from_s, self.sent = self.client.state["time_s"] + 0.4, 0
        self.states = []

    def now_us(self):
        return round(1e6 * self.client.state["time_s"])

    def interval(self):
        """Open for 0.2 s, then gripped; the motion begins 0.4 s after the device is in use."""
        end_s = self.client.state["time_s"] - self.from_s + INTERVAL_S
        while self.sent / self.hand.hz - 0.4 < end_s - 1e-9:
            t = self.sent / self.hand.hz - 0.4
            self.device.send(round(1e6 * (self.from_s + t)), self.hand.pose(t), t >= -0.2 and self.hand.has_grip(t))
            self.sent += 1
        self.client.step()
        self.device.receive(self.now_us())
        state = self.client.state
        keys = ("setpoint_cp", "refusals", "guidance")
        self.states.append((state["time_s"] - self.from_s, {key: state[key] for key in keys}))  # before any fault

    def run(self):
        """To the end of the hand's motion, or a second on from a fault: how the arm stops belongs to it."""
        until_s = self.from_s + ENDS_S
        while self.client.state["time_s"] < until_s and self.client.state["state"] == "ENABLED":
            self.interval()
            if self.client.state["faults"]:
                until_s = min(until_s, self.client.state["time_s"] + AFTER_FAULT_S)
                self.states.pop()
        self.was_stopped = self.client.state["state"] != "ENABLED"


def held_way(hand):
    """What the hand did while it had its grip: m along its axis times the scale, and deg."""
    steps = [k for k in range(1, len(hand.way_m)) if hand.has_grip(k * STEP_S) and hand.has_grip((k - 1) * STEP_S)]
    return tuple(sum(way[k] - way[k - 1] for k in steps) for way in (hand.way_m, hand.way_deg))


def drift(hand, states):
    """How far the commanded tip ends beside where the mapping has it, mm and deg; nothing of a hand that let go, at
    which the arm stops where it is, and of a tip that is on its way still.
    """
    if not states or states[-1][0] < ENDS_S - 0.1 or hand.open_s[1] > 0:
        return None, None
    first, before, last = (states[i][1]["setpoint_cp"] for i in (0, -10, -1))
    if math.dist(before, last) > STILL_M:
        return None, None
    way_m, turn_deg = held_way(hand)
    beside = [b - a - way_m * axis for a, b, axis in zip(first, last, hand.axis)]
    half = math.radians(turn_deg) / 2
    turned = product([math.cos(half), *(math.sin(half) * a for a in hand.turn_axis)], first[3:7])
    cosine = min(1.0, abs(sum(a * b for a, b in zip(turned, last[3:7]))))
    return 1e3 * math.sqrt(sum(x * x for x in beside)), math.degrees(2 * math.acos(cosine))


def product(a, b):
    return [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]


def lag_s(hand, states):
    """The delay at which the hand explains the commanded tip's way along its axis best; nothing for little motion."""
    origin = states[0][1]["setpoint_cp"]
    tip = [(t, sum((b - a) * c for a, b, c in zip(origin, s["setpoint_cp"], hand.axis))) for t, s in states if t > 0]
    if max(hand.way_m) - min(hand.way_m) < LAG_LEAST_WAY_M or len(tip) < 50 or hand.open_s[1] > 0:
        return None
    asked = [hand.way_m[min(len(hand.way_m) - 1, max(0, round(t / STEP_S)))] for t, _ in tip]
    best = (math.inf, 0)
    for late in range(round(LAG_MOST_S / INTERVAL_S)):
        error = sum((x - (asked[i - late] if i >= late else 0.0)) ** 2 for i, (_, x) in enumerate(tip)) / len(tip)
        best = min(best, (error, late))
    whole = sum(x * x for x in asked) / len(asked)
    return best[1] * INTERVAL_S if whole > 0 and best[0] < 0.2**2 * whole else None


def truth_of(truth, robot, rows):
    """Least tensions as shares of the planned one, and the fastest tip as a share of what the table allows."""
    names = ("tension_min_N", "tension_motor_min_N", "tip_speed_m_s", "enabled")
    columns = [truth.columns.index(name) for name in names]
    seen = [[row[i] for i in columns] for row in truth.rows[rows] if row[columns[3]]]
    if not seen:
        return {"tension": None, "motor_tension": None, "tip_speed": None}
    least_N, motor_N, speed_m_s, _ = zip(*seen)
    plan_N, allowed_m_s = robot["tension"]["plan_N"], robot["limits"]["tip_speed_m_s"]
    return {
        "tension": min(least_N) / plan_N,
        "motor_tension": min(motor_N) / plan_N,
        "tip_speed": max(speed_m_s) / allowed_m_s,
    }


def told(hand, session):
    """What lianad's states say of it."""
    states, faults = session.states, session.client.faults_told
    refused = states[-1][1]["refusals"] - states[0][1]["refusals"]
    beside_mm, beside_deg = drift(hand, states)
    return {
        "faults": sorted({number for number, _, _ in faults}),
        "stopped": session.was_stopped,
        "refusals": 10 * refused / max(INTERVAL_S, min(states[-1][0], RETURNS_S)),
        "least_share": min((state["guidance"] or {}).get("speed_share", 1.0) for _, state in states),
        "lag_s": lag_s(hand, states) if refused == 0 else None,
        "drift_mm": beside_mm,
        "drift_deg": beside_deg,
    }


def one_hand(seed, in_corner):
    """The figures of one hand."""
    hand = Hand(seed, in_corner)
    robot = json.loads(tables.table("robot", hand.robot))
    hand.plan(robot)
    physics = ["--physics", hand.physics]
    bench = [*physics, f"--start-pose={hand.pose_of(robot)}"]
    figures = {"seed": seed, "robot": hand.robot, "kind": hand.kind, "moves": hand.moves, "physics": hand.physics}
    with System(seed=seed, robot=hand.robot, bus=hand.bus, scene="none", lianad=physics, bench=bench) as system:
        session = Session(system, hand)
        session.run()
        period_s = session.client.welcome["period_s"]
        system.shut_down(session.client)
        rows = slice(round(session.from_s / period_s), round((session.from_s + ENDS_S) / period_s))
        return {**figures, **told(hand, session), **truth_of(system.truth(), robot, rows)}


# Key, heading, whether more is worse, digits.
FIGURES = [
    ("refusals", "refusals in 10 s of motion", True, 1),
    ("tension", "least true tension anywhere, of the planned", False, 2),
    ("motor_tension", "least true tension at a motor, of the planned", False, 2),
    ("tip_speed", "true tip speed, of the table's", True, 2),
    ("least_share", "least share of its speed that the hand was left", False, 2),
    ("lag_s", "lag of the commanded tip where nothing was refused, s", True, 2),
    ("drift_mm", "mapping beside the hand at the end, mm", True, 1),
    ("drift_deg", "the same, deg", True, 2),
]


def row(found, key, heading, more_is_worse, digits):
    """Median, the tenth that is worst, the worst and its seed."""
    values = sorted(((one[key], one["seed"]) for one in found if one[key] is not None), reverse=not more_is_worse)
    if not values:
        return [heading, 0, "-", "-", "-", "-"]
    places = (len(values) // 2, min(len(values) - 1, len(values) * 9 // 10), len(values) - 1)
    cells = [f"{values[place][0]:.{digits}f}" for place in places]
    return [heading, len(values), *cells, values[-1][1]]


def faults_text(found):
    rows = []
    for field in ("robot", "kind", "moves", "physics"):
        for value in sorted({one[field] for one in found}):
            these = [one for one in found if one[field] == value]
            faulted = [one for one in these if one["faults"]]
            numbers = sorted({number for one in faulted for number in one["faults"]})
            quiet = sum(not one["faults"] and one["refusals"] == 0 for one in these)
            rows.append([value, len(these), quiet, len(faulted), ", ".join(map(str, numbers)) or "-"])
    return table(["of", "hands", "without refusal and fault", "with a fault", "which"], rows)


def text_of(found):
    heads = ["figure", "hands", "median", "nine of ten are better than", "worst", "its seed"]
    faulted = [one["seed"] for one in found if one["faults"]]
    stopped = [one["seed"] for one in found if one["stopped"]]
    text = f"{len(found)} hands, seeds from {found[0]['seed']}; {len(faulted)} ended in a fault"
    text += f" ({', '.join(map(str, faulted[:12]))}{', ...' if len(faulted) > 12 else ''})." if faulted else "."
    text += (
        f" {len(stopped)} had the arm stopped and disabled{': ' if stopped else ''}{', '.join(map(str, stopped[:12]))}."
    )
    text += "\n\n" + table(heads, [row(found, *figure) for figure in FIGURES])
    return text + "\n\n" + faults_text(found)


def told_of(one):
    return f"{one['robot']} {one['kind']}: faults {one['faults']}, {one['refusals']:.1f} refusals in 10 s"


def measure(binaries, count=HANDS, first=FIRST_SEED, corners=False):
    one = functools.partial(one_hand, in_corner=corners)
    found = seeds.found(one, "hand", binaries, range(first, first + count), told_of)
    return found, text_of(found)


if __name__ == "__main__":
    import alone

    alone.run(
        measure,
        __doc__,
        first={"type": int, "help": "seed of the first hand"},
        corners={"action": "store_true", "help": "begin where all angles are bent far"},
    )
