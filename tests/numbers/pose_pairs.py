"""Pairs of legal poses, each drawn from its seed: a cable arm on the bench is enabled in the first, moved to the second and
back again. A third of them have two angles or more at their limits. What is refused at the start is counted by its reason.

Alone: pose_pairs.py [--bin DIR] [--count PAIRS] [--first SEED] [--json].
"""
import collections
import json
import random

import seeds
from hands import ARMS, truth_of
from liana import System
from liana import system as tables
from liana.client import NotReached
from page import table

PAIRS = 60
FIRST_SEED = 310001
SPREAD = 0.35  # of an angle's limit, one standard deviation
SETTLE_S = 600.0
ARRIVED_DEG = 0.05


class Pair:
    """What a seed draws."""

    def __init__(self, seed):
        draw = random.Random(f"pair {seed}")
        self.seed, (self.robot, self.bus) = seed, draw.choice(ARMS)
        self.physics = draw.choice(("nominal", "worn"))
        self.at_limit = draw.random() < 1 / 3
        self.draw = draw

    def pose(self, segments):
        """Angles in their limits; of a corner, two of them or more are at theirs."""
        limits = [segment["theta_limit_deg"] for segment in segments for _ in range(2)]
        deg = [max(-limit, min(limit, self.draw.gauss(0, SPREAD * limit))) for limit in limits]
        if self.at_limit:
            for k in self.draw.sample(range(len(deg)), self.draw.randint(2, len(deg))):
                deg[k] = self.draw.choice((-1, 1)) * limits[k]
        return deg

    def legal_pose(self, robot):
        """The first of them at which the arm neither touches itself nor needs more tension than there is."""
        while True:
            deg = ",".join(f"{angle:.3f}" for angle in self.pose(robot["segments"]))
            words = ["--robot", self.robot, "--scene", "none", f"--from-deg={deg}", f"--to-deg={deg}", "--duration", 1]
            seen = json.loads(tables.run("liana", "verify", *words, "--json").stdout)
            if seen["accepted"] and not seen["touches_itself"]:
                return deg


def refusal(system):
    """The reason of the newest refusal, without its numbers: what is refused at the start names its limit there."""
    told = [event for event in system.events() if event.kind in ("path", "verdict")]
    return told[-1].text.split(":")[1].split(",")[0].strip() if told else ""


def move(system, client, goal_deg):
    """Whether the arm has come there, how far its command has moved, and why not."""
    start_deg = client.state["setpoint_js_deg"]
    before = client.state["refused_motions"]
    client.call("move_jp", goal_deg=goal_deg)
    client.go_on(0.1)
    ended = lambda state: state["state"] != "ENABLED" or not state["is_busy"] and state["at_rest"]
    try:
        client.until(ended, SETTLE_S)
    except NotReached:
        return {"outcome": "hang", "moved_deg": 0.0, "why": ""}
    now_deg = client.state["setpoint_js_deg"]
    moved_deg = max(abs(a - b) for a, b in zip(start_deg, now_deg))
    if max(abs(a - b) for a, b in zip(goal_deg, now_deg)) < ARRIVED_DEG and not client.state["faults"]:
        return {"outcome": "arrived", "moved_deg": moved_deg, "why": ""}
    refused = client.state["refused_motions"] > before
    outcome = "fault" if client.state["faults"] else "refused" if refused else "stopped"
    return {"outcome": outcome, "moved_deg": moved_deg, "why": refusal(system) if refused else ""}


def one_pair(seed):
    """The figures of one pair: there, and back."""
    pair = Pair(seed)
    robot = json.loads(tables.table("robot", pair.robot))
    first, second = pair.legal_pose(robot), pair.legal_pose(robot)
    physics = ["--physics", pair.physics]
    figures = {"seed": seed, "robot": pair.robot, "physics": pair.physics, "at_limit": pair.at_limit}
    with System(
        seed=seed,
        robot=pair.robot,
        bus=pair.bus,
        scene="none",
        lianad=physics,
        bench=[*physics, f"--start-pose={first}"],
    ) as system:
        client, ways = system.client(), []
        client.enable()
        begin = client.state["tick"]
        for goal in (second, first):
            if client.state["state"] == "ENABLED" and not client.state["faults"] and not client.state["is_busy"]:
                ways.append(move(system, client, [float(angle) for angle in goal.split(",")]))
        faults = sorted({number for number, _, _ in client.faults_told})
        end = client.state["tick"]
        system.shut_down(client)
        return {**figures, "ways": ways, "faults": faults, **truth_of(system.truth(), robot, slice(begin, end))}


def text_of(found):
    rows = []
    for at_limit in (False, True):
        for physics in ("nominal", "worn"):
            these = [one for one in found if one["at_limit"] == at_limit and one["physics"] == physics]
            if not these:
                continue
            outcomes = collections.Counter(way["outcome"] for one in these for way in one["ways"])
            least = min(these, key=lambda one: one["motor_tension"])
            fastest = max(these, key=lambda one: one["tip_speed"])
            rows.append(
                [
                    ("two angles or more at a limit, " if at_limit else "") + physics,
                    len(these),
                    *(outcomes[each] for each in ("arrived", "refused", "stopped", "fault", "hang")),
                    f"{least['motor_tension']:.2f} ({least['seed']})",
                    f"{fastest['tip_speed']:.2f} ({fastest['seed']})",
                ]
            )
    heads = ["pairs", "of them", "ways that arrive", "refused", "stopped", "fault", "hang"]
    text = table([*heads, "least tension at a motor, of the planned", "fastest tip, of its limit"], rows)
    reasons = collections.Counter(way["why"] for one in found for way in one["ways"] if way["why"])
    if reasons:
        text += "\n\n" + table(["refused for", "ways"], [[why, count] for why, count in reasons.most_common()])
    return text


def told_of(one):
    ways = ", ".join(f"{way['outcome']} {way['why']}".strip() for way in one["ways"])
    return f"{one['robot']}: {ways} {one['faults']}"


def measure(binaries, count=PAIRS, first=FIRST_SEED):
    found = seeds.found(one_pair, "pair", binaries, range(first, first + count), told_of)
    return found, text_of(found)


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__, first={"type": int, "help": "seed of the first pair"})
