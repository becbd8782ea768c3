#!/usr/bin/env python3
"""Writes micro.json: tip pose and Jacobian of the robot `micro` by the product of exponentials.

Nothing here knows a DH table: axes and the points they pass through were read off the arm at its zero pose (stretched along x).
Plain Python, so that it shares no library with what it checks. Usage: python3 make_micro.py > micro.json
"""

import json
import math
import random

# Joint axes and points of them in the base frame at the zero pose; roll-yaw-pitch-pitch-pitch-yaw-roll.
AXES = [
    ((0, 0, 1), (0, 0, 0)),
    ((0, -1, 0), (0, 0, 0.28)),
    ((0, 0, -1), (0, -0.22, 0.28)),
    ((0, 0, -1), (2.10, -0.22, 0.08)),
    ((0, 0, -1), (4.20, -0.22, 0.08)),
    ((0, 1, 0), (4.20, -0.22, -0.12)),
    ((0, 0, -1), (4.20, 0.0, -0.12)),
]
HOME = [[1, 0, 0, 4.20], [0, -1, 0, 0.0], [0, 0, -1, -0.40], [0, 0, 0, 1]]
RANGE_DEG = 270.0


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def times(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def turned(t, v):
    return [sum(t[i][k] * v[k] for k in range(3)) for i in range(3)]


def moved(t, p):
    return [turned(t, p)[i] + t[i][3] for i in range(3)]


def exponential(axis, point, angle):
    """Rotation by `angle` about the line through `point` (Rodrigues)."""
    x, y, z = axis
    c, s, v = math.cos(angle), math.sin(angle), 1 - math.cos(angle)
    r = [
        [c + x * x * v, x * y * v - z * s, x * z * v + y * s],
        [y * x * v + z * s, c + y * y * v, y * z * v - x * s],
        [z * x * v - y * s, z * y * v + x * s, c + z * z * v],
    ]
    shift = [point[i] - sum(r[i][k] * point[k] for k in range(3)) for i in range(3)]
    return [r[i] + [shift[i]] for i in range(3)] + [[0, 0, 0, 1]]


def solve(joint_rad):
    """Tip pose (4 x 4) and geometric Jacobian (6 x 7: velocity of the tip point, then angular velocity)."""
    before = [[float(i == j) for j in range(4)] for i in range(4)]
    lines = []
    for (axis, point), angle in zip(AXES, joint_rad):
        lines.append((turned(before, axis), moved(before, point)))
        before = times(before, exponential(axis, point, angle))
    tip = times(before, HOME)
    position = [tip[i][3] for i in range(3)]
    columns = [cross(axis, [position[i] - point[i] for i in range(3)]) + axis for axis, point in lines]
    return tip, [[column[row] for column in columns] for row in range(6)]


def cases():
    yield "zero", [0.0] * 7
    yield "payload study", [-77.0, -117.0, -97.0, 139.0, 125.0, 107.0, 46.0]
    yield "low ends", [-RANGE_DEG] * 7
    yield "high ends", [RANGE_DEG] * 7
    for i in range(7):
        yield f"joint {i + 1} alone", [30.0 if k == i else 0.0 for k in range(7)]
    rng = random.Random(2026)
    for i in range(40):
        yield f"random {i + 1}", [round(rng.uniform(-RANGE_DEG, RANGE_DEG), 6) for _ in range(7)]


def case(name, joint_deg):
    tip, jacobian = solve([math.radians(x) for x in joint_deg])
    return {"name": name, "joint_deg": joint_deg, "tip_pose": tip[:3], "tip_jacobian": jacobian}


def main():
    rows = ",\n ".join(json.dumps(case(*c)) for c in cases())
    print('{"made_by": "tests/golden/make_micro.py, product of exponentials",')
    print('"jacobian": "rows vx vy vz wx wy wz of the tip in the base frame, per rad",')
    print(f'"cases": [\n {rows}\n]}}')


if __name__ == "__main__":
    main()
