"""Following curves by `liana plan --follow` from the panel edge pose, beside plans that only have to arrive there,
judged alike. Alone: planning_follow.py [--bin DIR] [--json]."""
import json
import math
import pathlib
import tempfile

from asking import ask, joined
from page import table
from planning_plans import PANEL_EDGE, POINTS_PER_LINK, PRESS_ROD, link_points, tip_of

LOOKS = 8  # at a step between waypoints


def ahead(length_m):
    """A straight curve from the tip along its own axis."""
    points, rotation = link_points(PANEL_EDGE)
    return [points[-1], [points[-1][i] + length_m * rotation[i][0] for i in range(3)]]


def curves():
    tip = tip_of(PANEL_EDGE)[:3]
    yield "straight ahead", ahead(0.001), False
    yield "straight ahead", ahead(0.3), False
    yield "straight to (1.2, 0.05, 0.3)", [tip, [1.2, 0.05, 0.3]], True
    yield "bend by (0.6, -0.15, 0.4), (1, -0.05, 0.35) to (1.4, 0, 0.4)", [
        tip,
        [0.6, -0.15, 0.4],
        [1.0, -0.05, 0.35],
        [1.4, 0.0, 0.4],
    ], True
    yield "`--follow=slit` to the press rod", None, True


def away(p, a, b):
    """Distance of a point from a straight piece."""
    piece = [y - x for x, y in zip(a, b)]
    square = sum(x * x for x in piece)
    share = min(1.0, max(0.0, sum((x - y) * z for x, y, z in zip(p, a, piece)) / square)) if square > 0 else 0.0
    return math.dist(p, [x + share * z for x, z in zip(a, piece)])


def body_off(waypoints):
    """Greatest and mean distance of the link ends from the arm's line at the start and the tip's path since."""
    ends = lambda theta: [[0.0, 0.0, 0.0], *link_points(theta)[0][POINTS_PER_LINK - 1 :: POINTS_PER_LINK]]  # noqa: E731
    line, offs = ends(waypoints[0]), []
    for before, after in zip(waypoints, waypoints[1:]):
        for look in range(1, LOOKS + 1):
            here = ends([x + (y - x) * look / LOOKS for x, y in zip(before, after)])
            line.append(here[-1])
            offs += [min(away(p, a, b) for a, b in zip(line, line[1:])) for p in here[1:-1]]
    return max(offs), sum(offs) / len(offs)


def plan(binaries, *options):
    answer = ask(binaries / "liana", "plan", f"--from-deg={joined(PANEL_EDGE)}", "--json", *options)
    if answer["outcome"] != "solved":
        raise RuntimeError(f"{options}: {answer['outcome']}: {answer['reason']}")
    return answer


def follow(binaries, points, folder):
    if points is None:
        return plan(binaries, "--follow=slit", f"--to-deg={joined(PRESS_ROD)}")
    file = pathlib.Path(folder) / "curve.json"
    file.write_text(json.dumps({"points_m": points}), encoding="utf-8")
    return plan(binaries, f"--follow={file}")


def study(binaries):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name, points, compared in curves():
            answer = follow(binaries, points, folder)
            row = {"curve": name, "waypoints": len(answer["waypoints_deg"]), **answer["follow"]}
            if compared:
                end = f"--to-deg={joined(answer['waypoints_deg'][-1])}"
                row["arriving_m"] = body_off(plan(binaries, end)["waypoints_deg"])
            rows.append(row)
    return rows


def measure(binaries):
    found = study(binaries)
    rows = [
        [
            r["curve"],
            f"{r['curve_length_m']:.3f} m",
            f"{1000 * r['tip_off_m']:.1f} mm",
            f"{1000 * r['body_off_m']:.1f} mm",
            f"{1000 * r['mean_body_off_m']:.1f} mm",
            r["waypoints"],
            ", ".join(f"{1000 * x:.0f} mm" for x in r.get("arriving_m", [])),
        ]
        for r in found
    ]
    return found, table(
        [
            "from the panel edge pose",
            "curve",
            "tip within",
            "body within",
            "on average",
            "waypoints",
            "a plan that only has to arrive there: body within, on average",
        ],
        rows,
    )


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
