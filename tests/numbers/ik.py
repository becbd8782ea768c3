"""2000 random reachable goals (theta within +-15 deg) by `liana ik`, from zero and from nearby, free and with held
pitches.
"""
import concurrent.futures
import math
import os
import random

from asking import ask, joined, quaternion_of
from page import table

GOALS = 2000
NEAR_DEG = 3.0
HELD = {"free": [], "X5 held": [9], "X4 and X5 held": [7, 9]}


def tip_of(binaries, theta_deg):
    pose = ask(binaries / "liana", "pose", f"--theta-deg={joined(theta_deg)}", "--json")["tip_pose"]
    return [row[3] for row in pose[:3]], quaternion_of(pose)


def errors(a, b):
    """Distance and angle between two poses."""
    sign = math.copysign(1.0, sum(x * y for x, y in zip(a[1], b[1])))
    return math.dist(a[0], b[0]), 2 * math.dist([sign * x for x in a[1]], b[1])


def one_goal(binaries, index):
    """Kind of the goal, whether it converged, whether that claim was wrong, and the iterations."""
    draw = random.Random(index)
    held = list(HELD)[index % 3]
    near = index // 3 % 2 == 1
    goal = [draw.uniform(-15, 15) for _ in range(10)]
    start = [x + draw.uniform(-NEAR_DEG, NEAR_DEG) for x in goal] if near else [0.0] * 10
    for theta in HELD[held]:
        goal[theta - 1] = start[theta - 1] = 0.0
    tip = tip_of(binaries, goal)
    options = [f"--from-deg={joined(start)}", f"--tip={joined(tip[0] + tip[1])}"]
    if HELD[held]:
        options.append("--hold=" + ",".join(map(str, HELD[held])))
    answer = ask(binaries / "liana", "ik", *options, "--json")
    wrong = answer["converged"] and max(errors(tip_of(binaries, answer["theta_deg"]), tip)) > 1e-6
    return (held, "nearby" if near else "zero"), answer["converged"], wrong, answer["iterations"]


def measure(binaries):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(lambda index: one_goal(binaries, index), range(GOALS)))
    rows = []
    for kind in sorted({result[0] for result in results}):
        mine = [result for result in results if result[0] == kind]
        iterations = sorted(result[3] for result in mine)
        rows.append(
            [
                kind[0],
                kind[1],
                len(mine),
                f"{100 * sum(r[1] for r in mine) / len(mine):.1f} %",
                sum(r[2] for r in mine),
                iterations[len(iterations) // 2],
                iterations[-1],
            ]
        )
    total = sum(result[1] for result in results)
    wrong = sum(result[2] for result in results)
    text = f"{total} of {GOALS} goals found ({100 * total / GOALS:.2f} %); {wrong} wrongly called converged.\n\n"
    head = ["held", "from", "goals", "converged", "wrong", "iterations median", "most"]
    return {"goals": GOALS, "converged": total, "wrong": wrong}, text + table(head, rows)
