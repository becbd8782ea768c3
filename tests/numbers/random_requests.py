"""Random valid requests, each sequence of them drawn from its seed, to `zhu2022` on the bench, judged by its truth: moves,
lines, streams, held angles, shapes, retracts, devices that lead the tip and die, holds and emergency stops. They come at
any moment, from five start poses, with the scene as drawn or 10 mm and 1 degree beside.

Alone: random_requests.py [--bin DIR] [--count SEQUENCES] [--first SEED] [--jobs N] [--json].
"""
import collections
import functools
import json
import math
import random
import resource

import folders
import seeds
from hands import direction, product
from liana import System
from liana import system as tables
from liana.client import Client, LianaError, NotReached, RequestRefused
from liana.devices import Device
from page import table

SEQUENCES = 40
FIRST_SEED = 610001
REQUESTS = 100  # in a sequence
ROBOT = folders.ROOT / "hil/scenarios/slit/zhu2022_in_slit.lua"  # zhu2022 with poses inside the slit
POSES = ("zero", "prepare", "panel_edge", "mouth", "entering")
IN_SLIT = POSES[3:]  # there the arm begins exactly in its pose
BESIDE = "10,1"  # mm, deg
WAITS_S = (0.02, 3.0)  # from one request to the next, evenly in the logarithm
INTERVAL_S, SAMPLES = 0.02, 2  # of the device in an interval
SETTLE_S = 60.0
LET_GO_S = 0.1
FALSE_BREAK = 5006
REST_DEG_S = 0.1
STOP_TENSION_N = 5.0
FREE_SHARE, SLACK_N = 1.05, 0.01
STEP_M = 0.06  # of a device that jumps, at least: no hand makes such a step
KINDS = {
    "move_jp": 4,
    "move_path": 1,
    "move_cp": 4,
    "stream": 3,
    "lead": 3,
    "hold_theta": 2,
    "shape": 2,
    "retract": 1,
    "hold": 3,
    "stop": 1,
}
OFTEN = 12  # the weight of stops in every fourth sequence
MOTIONS = ("move_jp", "move_path", "move_cp", "stream", "lead")
DEATHS = ("opens", "silent", "gone", "jumps", "stale", "not a number", "clock", "stuck")


class Hand:
    """A device whose hand goes on one way, slower and faster, until it dies in one of several ways."""

    def __init__(self, path, draw, time_s, speed_m_s):
        self.death, self.dies_s = draw.choice(DEATHS), time_s + draw.uniform(1.0, 2.5)
        self.away, self.speed_m_s = direction(draw), speed_m_s * draw.uniform(0.5, 2.0)
        self.from_s, self.jump = time_s, [x * draw.uniform(STEP_M, 0.4) for x in direction(draw)]
        self.way_m, self.turn_deg_s, self.is_gone = 0.0, draw.uniform(-30, 30), False
        self.turn_axis = direction(draw)
        self.device = Device(path, "drawn", "hand", SAMPLES / INTERVAL_S, round(1e6 * time_s))

    def pose(self, t):
        rate = 1 + 0.5 * math.sin(4 * (t - self.from_s))
        self.way_m += 0.0 if t < self.from_s + 0.4 else self.speed_m_s * rate * INTERVAL_S / SAMPLES
        half = math.radians(self.turn_deg_s * max(0.0, t - self.from_s - 0.4)) / 2
        attitude = [math.cos(half), *(math.sin(half) * a for a in self.turn_axis)]
        return [*(self.way_m * a for a in self.away), *attitude]

    def send(self, time_s):
        """The samples of one interval; open for 0.2 s, then gripped."""
        self.device.receive(round(1e6 * time_s))
        dead = time_s >= self.dies_s
        for k in range(SAMPLES):
            t = time_s + k * INTERVAL_S / SAMPLES
            if dead and self.death in ("silent", "gone") or self.device.problem:
                break
            pose, us = self.last if dead and self.death == "stuck" else self.pose(t), round(1e6 * t)
            self.last = pose
            if dead and self.death == "jumps":
                pose = [*(a + b for a, b in zip(pose, self.jump)), *pose[3:]]
            if dead and self.death == "not a number":
                pose = [math.nan, *pose[1:]]
            us += 300_000 if dead and self.death == "clock" else 0
            grips = t >= self.from_s + 0.2 and not (dead and self.death == "opens")
            self.device.send(us, pose, grips, stale=dead and self.death == "stale")
        if dead and self.death == "gone":
            self.close()

    def close(self):
        self.is_gone = True
        self.device.close()


class Arm(Client):
    """A client with a device whose samples go with its own intervals; keeps what led on after it had died."""

    def __init__(self, path, **options):
        self.hand, self.late = None, {}
        super().__init__(path, "drawn", "client", True, **options)

    def step(self):
        hand = self.hand
        if hand and not hand.is_gone:
            try:
                hand.send(self.state["time_s"])
            except LianaError:  # lianad has let the device go
                hand.close()
        state = super().step()
        if hand and state["device_engaged"] and state["time_s"] > hand.dies_s + LET_GO_S + INTERVAL_S:
            self.late.setdefault(hand.death, state["tick"])
        return state


class Sequence:
    """What a seed draws, and the arm that is asked for it."""

    def __init__(self, seed):
        self.draw = random.Random(f"requests {seed}")
        self.seed, self.pose = seed, self.draw.choice(POSES)
        self.physics = self.draw.choice(("nominal", "worn"))
        self.is_beside = self.pose != "entering" and self.draw.random() < 0.5  # there it would begin in contact
        self.refused, self.asked, self.setpoints = collections.Counter(), collections.Counter(), 0
        self.stops, self.trail, self.hang = [], [], ""
        self.from_tick = 0

    def system(self):
        physics = ["--physics", self.physics]
        bench = [*physics, "--start-pose", self.pose] + ["--jig"] * (self.pose in IN_SLIT)
        bench += ["--scene-offset", BESIDE] if self.is_beside else []
        return System(seed=self.seed, robot=str(ROBOT), scene="panel_slit", lianad=physics, bench=bench)

    def ask(self, op, **fields):
        """A refusal is an answer as good as any."""
        answer = self.client.ask(op, **fields)
        if answer["op"] != "ok":
            self.refused[answer["code"]] += 1
        self.trail.append((self.client.state["tick"], op, fields, answer.get("code", "")))
        return answer["op"] == "ok"

    def make_room(self):
        """A motion that is asked for during another is refused; half of them therefore come after a hold."""
        if self.client.state["is_busy"] and self.draw.random() < 0.6:
            self.ask("hold")
            self.client.until(lambda state: not state["is_busy"] or state["state"] != "ENABLED", SETTLE_S)

    def goal_beside(self, pose, way_m, turn_deg):
        place = [x + way_m * a for x, a in zip(pose, direction(self.draw))]
        half = math.radians(turn_deg) / 2
        turn = [math.cos(half), *(math.sin(half) * a for a in direction(self.draw))]
        return [*place, *product(turn, pose[3:7])]

    def joints_beside(self, from_deg, off_deg):
        limits_deg = [segment["theta_limit_deg"] for segment in self.robot["segments"] for _ in range(2)]
        return [max(-l, min(l, x + self.draw.gauss(0, off_deg))) for x, l in zip(from_deg, limits_deg)]

    def move_jp(self):
        off_deg = self.draw.choice((1.0, 4.0, 12.0))
        self.ask("move_jp", goal_deg=self.joints_beside(self.client.state["setpoint_js_deg"], off_deg))

    def move_path(self):
        points = [self.client.state["setpoint_js_deg"]]
        for _ in range(self.draw.randint(1, 6)):
            points.append(self.joints_beside(points[-1], 2.0))
        self.ask("move_path", points_deg=points)

    def move_cp(self):
        way_m, turn_deg = abs(self.draw.gauss(0, 0.1)), abs(self.draw.gauss(0, 10.0))
        self.ask("move_cp", goal=self.goal_beside(self.client.state["setpoint_cp"], way_m, turn_deg))

    def stream(self):
        """Goals that go on one way at up to the tip's speed, until one is refused."""
        away = direction(self.draw)
        step_m = self.draw.uniform(0.2, 1.0) * self.robot["limits"]["tip_speed_m_s"] * INTERVAL_S
        goal = list(self.client.state["setpoint_cp"])
        for _ in range(self.draw.randint(10, 80)):
            goal = [*(x + step_m * a for x, a in zip(goal, away)), *goal[3:7]]
            self.setpoints += 1
            if not self.ask("servo_cp", goal=goal):
                break

    def lead(self):
        """A device leads the tip and dies; whatever comes next comes a second later."""
        client = self.client
        client.hand = Hand(f"{self.system_api}.devices", self.draw, client.state["time_s"], 0.1)
        client.step()
        client.step()
        scale = self.draw.choice((0.5, 1.0, 2.0))
        if self.ask("use_device", device="drawn", scale=scale):
            client.hand.from_s = client.state["time_s"]
            client.go_on(max(0.0, client.hand.dies_s - client.state["time_s"]) + self.draw.uniform(0.0, 0.6))
        if client.hand:
            client.hand.close()
            client.hand = None

    def hold_theta(self):
        now_deg = self.client.state["setpoint_js_deg"]
        thetas = self.draw.sample(range(len(now_deg)), self.draw.randint(0, 2))
        held = [{"theta": k + 1, "target_deg": now_deg[k] + self.draw.uniform(-1, 1)} for k in thetas]
        self.ask("hold_theta", held=held)

    def shape(self):
        nodes = self.client.state["node_m"][:-1]
        k = self.draw.randrange(len(nodes))
        place = [x + self.draw.gauss(0, 0.05) for x in nodes[k]]
        self.ask("shape", nodes=[{"node": k + 1, "position_m": place}] if self.draw.random() < 0.7 else [])

    def retract(self):
        self.ask("retract")

    def hold(self):
        self.ask("hold")

    def stop(self):
        """And on: an arm that stopped is cleared and enabled again."""
        begin = self.client.state["tick"]
        before = set(self.client.faults_told)
        self.ask("stop", reason="drawn")
        self.client.until(lambda state: state["state"] in ("DISABLED", "FAULT") and state["at_rest"], SETTLE_S)
        self.client.go_on(self.draw.uniform(0.0, 1.0))
        caused = sorted(number for number, _, _ in self.client.faults_told - before)
        self.stops.append((begin, self.client.state["tick"], caused))

    def recover(self):
        """Clears and enables an arm that stopped, whatever stopped it; whether it could."""
        self.client.ask("acquire")
        for command in ("disable", "clear", "enable"):
            self.ask("state_command", command=command)
            self.client.go_on(0.1)
            if command == "disable":
                self.client.until(lambda state: state["state"] in ("DISABLED", "FAULT"), SETTLE_S)
        self.client.until(lambda state: state["state"] not in ("ENABLING", "BOOTING"), SETTLE_S)
        return self.client.state["state"] == "ENABLED"

    def run(self, system, robot):
        self.robot, self.system_api = robot, system.api
        self.client = Arm(system.api, check=system.check_refused)
        system.clients.append(self.client)
        self.client.enable()
        self.from_tick = self.client.state["tick"]
        kinds = {**KINDS, "stop": OFTEN} if self.seed % 4 == 0 else KINDS
        low, high = map(math.log, WAITS_S)
        for _ in range(REQUESTS):
            if (self.client.state["state"] != "ENABLED" or self.client.state["faults"]) and not self.recover():
                break
            kind = self.draw.choices(list(kinds), list(kinds.values()))[0]
            self.asked[kind] += 1
            if kind in MOTIONS:
                self.make_room()
            getattr(self, kind)()
            self.client.go_on(round(math.exp(self.draw.uniform(low, high)) / INTERVAL_S) * INTERVAL_S)
        self.ask("hold")
        self.client.until(lambda state: state["at_rest"] or state["state"] != "ENABLED", SETTLE_S)


@functools.cache
def drawn_slit():
    return json.loads(tables.table("scene", "panel_slit"))["slit"]


def is_in_slit(place_m):
    slit = drawn_slit()
    along, across = (sum(a * x for a, x in zip(slit[axis], place_m)) for axis in ("u_axis", "normal"))
    return slit["mouth_u_m"] <= along <= slit["end_u_m"] and abs(across - slit["offset_m"]) <= slit["half_gap_m"]


class Judged:
    """What the truth says of a sequence from when the arm was enabled; nothing of an arm that began in a plate of a scene
    beside its drawing.
    """

    def __init__(self, truth, robot, sequence):
        self.wrong, self.truth = [], truth
        begin = sequence.from_tick
        limits = robot["limits"]
        at = truth.columns.index
        force, clear, speed, tip = map(at, ("contact_force_N", "clearance_m", "tip_speed_m_s", "tip_x_m"))
        anywhere, motor = at("tension_min_N"), at("tension_motor_min_N")
        self.is_free = all(truth.rows[k][force] == 0.0 and truth.rows[k][clear] > 0.0 for k in (0, begin))
        slots = range(begin, len(truth.rows)) if self.is_free and begin else range(0)
        inside = [k for k in slots if is_in_slit(truth.rows[k][tip : tip + 3])]
        outside = sorted(set(slots).difference(inside))
        tip_m_s, slit_m_s = limits["tip_speed_m_s"], limits["tip_speed_slit_m_s"]
        too_fast = lambda share: share > FREE_SHARE
        self.motor_N = self.worst("", slots, lambda row: row[motor], min)
        self.tension_N = self.worst("slack", slots, lambda row: row[anywhere], min, lambda N: N < SLACK_N)
        self.speed = self.worst("tip speed", outside, lambda row: row[speed] / tip_m_s, max, too_fast)
        self.slit_speed = self.worst("tip speed in the slit", inside, lambda row: row[speed] / slit_m_s, max, too_fast)
        self.contact_N = self.worst("contact", slots, lambda row: row[force], max, lambda N: N > 0)
        self.stops = [self.stop(truth, *stop) for stop in sequence.stops]

    def worst(self, name, slots, value, pick, is_wrong=lambda _: False):
        """The worst of these slots; the first that is wrong is kept."""
        if not slots:
            return None
        rows = self.truth.rows
        first = next((k for k in slots if is_wrong(value(rows[k]))), None)
        worst = pick(value(rows[k]) for k in slots)
        if first is not None:
            self.wrong.append((first, name, worst))
        return worst

    def stop(self, truth, begin, end, caused):
        """Least tension at a motor until the arm is at rest, when that is, and what faults came."""
        motor, rate = map(truth.columns.index, ("tension_motor_min_N", "fastest_deg_s"))
        rows = truth.rows[begin:end]
        least_N = min(row[motor] for row in rows)
        rest_s = 0.004 * max((k + 1 for k, row in enumerate(rows) if row[rate] > REST_DEG_S), default=0)
        if least_N < STOP_TENSION_N:
            self.wrong.append((begin, "tension in a stop", least_N))
        if caused:
            self.wrong.append((begin, f"fault in a stop {caused}", 0))
        return {"least_N": least_N, "rest_s": rest_s, "faults": caused}


def one_sequence(seed):
    """The figures of one sequence."""
    sequence = Sequence(seed)
    robot = json.loads(tables.table("robot", str(ROBOT)))
    figures = {"seed": seed, "pose": sequence.pose, "physics": sequence.physics, "beside": sequence.is_beside}
    before = processor_s()
    with sequence.system() as system:
        try:
            sequence.run(system, robot)
        except NotReached as error:
            sequence.hang = str(error)
        client = sequence.client
        faults = sorted((tick, number, index) for number, index, tick in client.faults_told)
        ended = client.state["state"]
        system.shut_down(client)
        truth = system.truth()
    judged = Judged(truth, robot, sequence)
    wrong = judged.wrong + [(tick, "false break", index) for tick, number, index in faults if number == FALSE_BREAK]
    if sequence.hang and (judged.is_free or sequence.from_tick):  # an arm in the wall may not be enabled
        wrong.append((client.state["tick"], "hang", sequence.hang))
    wrong += [(tick, f"{death} led on", 0) for death, tick in client.late.items()]
    return {
        **figures,
        "asked": sum(sequence.asked.values()),
        "setpoints": sequence.setpoints,
        "refused": dict(sequence.refused),
        "verdicts": client.state["refusals"],
        "faults": faults,
        "ended": ended,
        "arm_s": 0.004 * len(truth.rows),
        "processor_s": processor_s() - before,
        "free": judged.is_free,
        "stops": judged.stops,
        "wrong": sorted(wrong, key=lambda each: each[0]),
        **{key: getattr(judged, key) for key in ("motor_N", "tension_N", "speed", "slit_speed", "contact_N")},
    }


def processor_s():
    """Of this process and of those that it has started and waited for."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


# Key, heading, which is the worst.
FIGURES = [
    ("motor_N", "least true tension at a motor, N", min),
    ("tension_N", "least true tension anywhere, N", min),
    ("speed", "true tip speed, of the limit", max),
    ("slit_speed", "true tip speed in the slit, of the limit there", max),
    ("contact_N", "touch of an arm that began free, N", max),
]
STOP_FIGURES = [("least_N", "least true tension in a stop, N", min), ("rest_s", "time to rest of a stop, s", max)]


def worst_rows(found, figures):
    for key, heading, worst in figures:
        seen = [one for one in found if one[key] is not None]
        if seen:
            one = worst(seen, key=lambda one: one[key])
            yield [heading, f"{one[key]:.2f}", f"seed {one['seed']}"]


def text_of(found):
    asked, used_s = (sum(one[key] for one in found) for key in ("asked", "processor_s"))
    stops = [{**stop, "seed": one["seed"]} for one in found for stop in one["stops"]]
    wrong = collections.Counter(name for one in found for _, name, _ in one["wrong"])
    first = {name: one["seed"] for one in reversed(found) for _, name, _ in one["wrong"]}
    faults = collections.Counter(
        number for one in found for number in sorted({number for _, number, _ in one["faults"]})
    )
    rows = [
        ["requests", asked, f"and {sum(one['setpoints'] for one in found)} setpoints of streams"],
        ["refused", sum(sum(one["refused"].values()) for one in found), ""],
        ["refused commands", sum(one["verdicts"] for one in found), ""],
        ["stops", len(stops), ""],
        ["sequences that began in contact", sum(not one["free"] for one in found), "of them, no contact is judged"],
        ["sequences with a fault", sum(bool(one["faults"]) for one in found), dict(faults) or ""],
        *worst_rows(found, FIGURES),
        *worst_rows(stops, STOP_FIGURES),
    ]
    text = (
        f"{len(found)} sequences, seeds from {found[0]['seed']}: {sum(one['arm_s'] for one in found) / 60:.0f} min of"
    )
    text += f" the arm, {used_s:.0f} s of a processor, {asked / used_s:.1f} requests a second of it.\n\n"
    text += table(["of all", "value", "which"], rows)
    return (
        text
        + "\n\n"
        + table(["wrong", "sequences", "first"], [[name, count, first[name]] for name, count in wrong.items()])
    )


def told_of(one):
    return f"{one['pose']} {one['physics']}{' beside' * one['beside']}: faults {one['faults']}, {one['wrong']}"


def measure(binaries, count=SEQUENCES, first=FIRST_SEED, jobs=None):
    found = seeds.found(one_sequence, "sequence", binaries, range(first, first + count), told_of, jobs)
    return found, text_of(found)


if __name__ == "__main__":
    import alone

    alone.run(
        measure,
        __doc__,
        first={"type": int, "help": "seed of the first sequence"},
        jobs={"type": int, "help": "sequences at once; as many as processors without"},
    )
