"""Offline plans: the two legs of the slit crossing and random scenes in which a path is known to exist, by `liana
plan`; beside them the same problems with nothing but the straight line in theta to start from. Can be run alone:
planning_plans.py [--count N] [--json] [--bin DIR]."""
import collections
import json
import math
import pathlib
import random
import statistics
import sys
import tempfile

from asking import ask, joined, quaternion_of
from page import table

PROBLEMS = 100
MARGIN_M = 0.005
KNOWN_CLEARANCE_M = 0.02  # of the path that obstacles are placed beside
RADIUS_M = 0.03  # of a link
PATH_POSES = 120
POINTS_PER_LINK = 3
PREPARE = [-8.5, 0, -12, 0, 8, -2, 13, 0, 12, -2]
# Not inside the slit of the scene: docs/explanation/sources-and-assumptions.md.
SEGMENT_5_IN_SLIT = [-2.79, -6.63, -1.75, -6.31, 5.03, 11.6, 1.87, 9.68, 0, -4.64]
PANEL_EDGE = [-6.14, -15, -3.29, -8.72, 7.2, 15, 5.55, 15, 1, -2.8]
PRESS_ROD = [-2.641, -2.064, -1.81, -4.64, 4.777, 5.87, 0, 4.764, 0, -0.543]


def link_points(theta_deg):
    """Points along the axis of every link, by the plain product of joints, and the rotation of the tip."""
    rotation, end, points = [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]], [0.0, 0.0, 0.0], []
    for m in range(5):
        ca, sa = math.cos(math.radians(theta_deg[2 * m])), math.sin(math.radians(theta_deg[2 * m]))
        cb, sb = math.cos(math.radians(theta_deg[2 * m + 1])), math.sin(math.radians(theta_deg[2 * m + 1]))
        pitch, yaw = [[ca, -sa, 0], [sa, ca, 0], [0, 0, 1]], [[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]]
        for k in range(8):
            for turn in (pitch, yaw) if k % 2 == 0 else (yaw, pitch):
                rotation = [[sum(row[i] * turn[i][j] for i in range(3)) for j in range(3)] for row in rotation]
            for i in range(1, POINTS_PER_LINK + 1):
                points.append([end[x] + 0.1 * i / POINTS_PER_LINK * rotation[x][0] for x in range(3)])
            end = points[-1]
    return points, rotation


def tip_of(theta_deg):
    points, rotation = link_points(theta_deg)
    return points[-1] + quaternion_of(rotation)


def unit(vector):
    return [x / math.hypot(*vector) for x in vector]


def random_axes(draw):
    """Three orthonormal right-handed rows."""
    a, b = unit([draw.gauss(0, 1) for _ in range(3)]), [draw.gauss(0, 1) for _ in range(3)]
    b = unit([b[i] - sum(x * y for x, y in zip(a, b)) * a[i] for i in range(3)])
    return [a, b, [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]]


def distance(obstacle, p):
    if "radius_m" in obstacle:
        return math.dist(p, obstacle["center_m"]) - obstacle["radius_m"]
    away = [p[i] - obstacle["center_m"][i] for i in range(3)]
    over = [
        abs(sum(x * y for x, y in zip(row, away))) - half
        for row, half in zip(obstacle["rotation"], obstacle["half_extent_m"])
    ]
    return math.hypot(*[max(0.0, x) for x in over]) + min(0.0, max(over))


def obstacle_beside(draw, path_points, line_points, name):
    """A sphere or box at least KNOWN_CLEARANCE_M from all of the known path; None when it is in its way. With
    `line_points`, the arm half way on the straight line in theta, it stands in the way of that; else near a point of
    the arm on the known path."""
    size, direction = draw.uniform(0.05, 0.25), unit([draw.gauss(0, 1) for _ in range(3)])
    if line_points:
        center = draw.choice(line_points[len(line_points) // 5 :])
    else:
        near = draw.choice(draw.choice(path_points)[len(path_points[0]) // 5 :])
        center = [near[i] + (RADIUS_M + size + draw.uniform(0.03, 0.20)) * direction[i] for i in range(3)]
    if draw.random() < 0.5:
        obstacle = {"name": name, "center_m": center, "radius_m": size}
    else:
        obstacle = {
            "name": name,
            "center_m": center,
            "half_extent_m": [size * draw.uniform(0.2, 1.0) for _ in range(3)],
            "rotation": random_axes(draw),
        }
    spare = RADIUS_M + KNOWN_CLEARANCE_M
    return obstacle if all(distance(obstacle, p) > spare for points in path_points for p in points) else None


def random_problem(index, base_scene):
    """A smooth path bent to one side, 1 to 5 obstacles beside it, the first of them across the straight line in theta,
    and the ends of the path; every second goal is given as a tip pose."""
    draw = random.Random(index)
    a, b, bend = ([draw.uniform(-limit, limit) for _ in range(10)] for limit in (10, 10, 6))
    poses = [
        [a[k] + (b[k] - a[k]) * s / PATH_POSES + bend[k] * math.sin(math.pi * s / PATH_POSES) for k in range(10)]
        for s in range(PATH_POSES + 1)
    ]
    path_points = [link_points(pose)[0] for pose in poses]
    middle, _ = link_points([(x + y) / 2 for x, y in zip(a, b)])
    wanted, obstacles = draw.randint(1, 5), []
    while len(obstacles) < wanted:
        obstacle = obstacle_beside(draw, path_points, [] if obstacles else middle, f"obstacle_{len(obstacles) + 1}")
        if obstacle is not None:
            obstacles.append(obstacle)
    scene = dict(
        base_scene,
        name=f"random_{index}",
        spheres=[o for o in obstacles if "radius_m" in o],
        boxes=[o for o in obstacles if "rotation" in o],
    )
    goal = {"tip": tip_of(b)} if index % 2 else {"to_deg": b}
    return {"name": f"random {index}", "scene": scene, "from_deg": a, **goal}


def problems(tables, count):
    scene = tables["scene"]
    yield {"name": "prepare to panel edge", "scene": scene, "from_deg": PREPARE, "to_deg": PANEL_EDGE}
    yield {"name": "panel edge to press rod", "scene": scene, "from_deg": PANEL_EDGE, "to_deg": PRESS_ROD}
    yield {"name": "panel edge to press rod, tip", "scene": scene, "from_deg": PANEL_EDGE, "tip": tip_of(PRESS_ROD)}
    for index in range(count):
        yield random_problem(index, scene)


def end_off(binaries, from_deg, to_deg, scene, *options):
    """Largest and rms difference [deg] between the last pose of a plan to the tip of `to_deg` and `to_deg` itself."""
    ends = [f"--from-deg={joined(from_deg)}", f"--tip={joined(tip_of(to_deg))}"]
    answer = ask(binaries / "liana", "plan", f"--scene={scene}", *ends, "--json", *options)
    if answer["outcome"] != "solved":
        raise RuntimeError(f"{answer['outcome']}: {answer['reason']}")
    off = [a - b for a, b in zip(answer["waypoints_deg"][-1], to_deg)]
    return max(map(abs, off)), math.sqrt(statistics.fmean(x * x for x in off))


def published(binaries):
    """The published poses beside ours for the same tips: the shortest way there, the same with what the source holds
    planar, and the pose with the published nodes as control points."""
    rows = []
    for name, from_deg, to_deg, scene, planar in (
        ("prepare", [0] * 10, PREPARE, "none", None),
        ("panel edge", PREPARE, PANEL_EDGE, "panel_slit", None),
        ("segment 5 in slit", PANEL_EDGE, SEGMENT_5_IN_SLIT, "none", "5@0.4"),
        ("press rod", PANEL_EDGE, PRESS_ROD, "panel_slit", "5@0.4,4@0.7"),
    ):
        points, _ = link_points(to_deg)
        nodes = [f"--control-point={m}:{joined(points[8 * POINTS_PER_LINK * m - 1])}:10" for m in (1, 2, 3, 4)]
        cells = [
            end_off(binaries, from_deg, to_deg, scene),
            end_off(binaries, from_deg, to_deg, scene, f"--planar={planar}") if planar else None,
            end_off(binaries, from_deg, to_deg, scene, "--waypoints=1", *nodes),
        ]
        rows.append([name, *(f"{cell[0]:.3f} ({cell[1]:.3f})" if cell else "-" for cell in cells)])
    return rows


def solve(binaries, problem, folder):
    """The plan, and whether the check's figures bear it out."""
    file = pathlib.Path(folder) / "scene.json"
    file.write_text(json.dumps(problem["scene"]), encoding="utf-8")
    goal = f"--tip={joined(problem['tip'])}" if "tip" in problem else f"--to-deg={joined(problem['to_deg'])}"
    ends = [f"--from-deg={joined(problem['from_deg'])}", goal]
    answer = ask(binaries / "liana", "plan", f"--scene={file}", *ends, f"--margin={MARGIN_M}", "--json")
    checked = answer["checked"]
    answer["good"] = (
        answer["outcome"] == "solved"
        and checked["min_clearance_m"] >= MARGIN_M
        and checked["tip_error_m"] < 1e-6
        and checked["max_joint_deg"] <= 20.0 + 1e-9
    )
    return answer


def from_straight(binaries, problem, tables):
    text = json.dumps({**problem, "robot": tables["robot"], "buses": tables["buses"]})
    return ask(binaries / "plan_from_straight", text=text)


def load_tables(binaries):
    names = {"robot": "zhu2022", "buses": "embedded", "scene": "panel_slit"}
    return {kind: ask(binaries / "liana-mission", "eval", kind, name) for kind, name in names.items()}


def causes(answers):
    """Failures by outcome and constraint."""
    failed = collections.Counter(f"{a['outcome']}: {a['constraint']}" for a in answers if a["outcome"] != "solved")
    return ", ".join(f"{cause} {n}" for cause, n in sorted(failed.items())) or "none"


def summary(answers):
    solved = [a for a in answers if a["outcome"] == "solved"]
    return {
        "problems": len(answers),
        "solved": len(solved),
        "median_s": statistics.median(a["time_s"] for a in solved) if solved else None,
        "median_iterations": statistics.median(a["iterations"] for a in solved) if solved else None,
        "failures": causes(answers),
    }


def study(binaries, count):
    tables = load_tables(binaries)
    ours, straight, rows = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for problem in problems(tables, count):
            answer, other = solve(binaries, problem, folder), from_straight(binaries, problem, tables)
            print(
                f"{problem['name']}: {answer['outcome']} ({answer['start']}) {answer['time_s']:.2f} s,"
                f" {answer['iterations']} iterations; from the straight line {other['outcome']},"
                f" {other['iterations']} iterations {answer.get('reason', '')}",
                file=sys.stderr,
                flush=True,
            )
            if problem["name"].startswith("random"):
                ours.append(answer)
                straight.append(other)
            else:
                clearance = f"{1000 * answer['checked']['min_clearance_m']:.1f} mm" if answer["checked"] else "-"
                rows.append(
                    [
                        problem["name"],
                        answer["outcome"],
                        answer["start"],
                        f"{answer['time_s']:.2f} s",
                        answer["iterations"],
                        clearance,
                        other["outcome"],
                    ]
                )
    wrong = sum(a["outcome"] == "solved" and not a["good"] for a in ours)
    settled = sum(a["outcome"] == "solved" and a["settled"] for a in ours)
    starts = collections.Counter(a["start"] for a in ours if a["outcome"] == "solved")
    return {
        "random": summary(ours),
        "from_straight": summary(straight),
        "wrong": wrong,
        "settled": settled,
        "starts": dict(starts),
        "legs": rows,
        "published": published(binaries),
    }


def measure(binaries, count=PROBLEMS):
    found = study(binaries, count)
    ours, straight = found["random"], found["from_straight"]
    rows = [
        [
            "own start paths",
            ours["problems"],
            ours["solved"],
            f"{ours['median_s']:.2f} s",
            ours["median_iterations"],
            ours["failures"],
        ],
        [
            "straight line in theta",
            straight["problems"],
            straight["solved"],
            f"{straight['median_s']:.2f} s",
            straight["median_iterations"],
            straight["failures"],
        ],
    ]
    text = (
        f"Random scenes, 20 waypoints, margin {1000 * MARGIN_M:.0f} mm; {found['wrong']} solved plans fail the"
        f" independent check; {found['settled']} settled; starts {found['starts']}.\n\n"
    )
    text += table(["start", "problems", "solved", "median time", "median iterations", "failures"], rows) + "\n\n"
    text += (
        table(
            [
                "published pose",
                "our end, deg largest (rms) off",
                "planar as published",
                "with the published nodes as control points",
            ],
            found["published"],
        )
        + "\n\n"
    )
    return found, text + table(
        ["leg", "outcome", "start", "time", "iterations", "clearance", "from the straight line"], found["legs"]
    )


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
