"""The arm on a base that feeds: the mission feeder_box by seeds, and drawn curves followed by the simulated arm, with the
true body's distance from them. Alone: feeding.py [--bin DIR] [--first SEED] [--count MISSIONS] [--curves CURVES]
[--jobs N] [--json].
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

import folders
from page import table
from planning_follow import away

sys.path.append(str(folders.ROOT / "hil/scenarios"))
from liana.recordings import Truth  # noqa: E402
from slit_truth import joint_centres_m  # noqa: E402 (found through the line above)

MISSIONS, CURVES, FIRST_SEED = 10, 5, 36000
START_M = 0.375  # the tip of the pose `back`
POINT_M = 0.01
EVERY = 50  # ticks from one look at the body to the next
MISSION = """
local liana = require "liana"
local way = { points = %s }
return liana.mission "drawn" {
  robot = "feeder", bus = "embedded_feeder", scene = "none",
  liana.step "to its begin" {
    device = "none", run = liana.move_to "back", exit = liana.all { liana.at_pose "back", liana.at_rest() },
    time_limit_s = 120, on_fail = "hold",
  },
  liana.step "along" {
    device = "none", enter = liana.at_rest(), run = liana.follow_curve(way), exit = liana.curve_followed(),
    time_limit_s = 600, on_fail = "hold",
  },
}
"""


def drawn_curve(seed):
    """Straight, a bend, straight, a bend in any other plane: radii from 0.25 to 0.4 m, turns of 20 to 60 deg."""
    draw = random.Random(f"curve {seed}")
    points, along, side = [[START_M, 0.0, 0.0]], [1.0, 0.0, 0.0], None

    def on(length_m, turn_rad=0.0):
        count = math.ceil(length_m / POINT_M)
        for _ in range(count):
            half = turn_rad / count / 2
            for k in (0, 1):
                if turn_rad:
                    turned = [math.cos(half) * a + math.sin(half) * s for a, s in zip(along, side)]
                    side[:] = [math.cos(half) * s - math.sin(half) * a for a, s in zip(along, side)]
                    along[:] = turned
                if k == 0:
                    points.append([p + length_m / count * a for p, a in zip(points[-1], along)])

    on(draw.uniform(0.05, 0.2))
    for _ in range(2):
        roll = draw.uniform(0.0, 2.0 * math.pi)
        some = [0.0, math.cos(roll), math.sin(roll)]
        inner = sum(a * s for a, s in zip(along, some))
        side = [s - inner * a for a, s in zip(along, some)]
        size = math.sqrt(sum(s * s for s in side))
        side = [s / size for s in side]
        turn = math.radians(draw.uniform(20.0, 60.0))
        on(draw.uniform(0.25, 0.4) * turn, turn)
        on(draw.uniform(0.02, 0.06))
    return points


def true_body_off_m(recording, points):
    """Greatest distance of the true joint centres from the slide's axis and the curve, while the arm follows; of the tip."""
    truth = Truth(recording / "truth.bin")
    robot = json.loads((recording / "robot.json").read_text())
    line = [[-2.0, 0.0, 0.0], *points]
    pieces = list(zip(line, line[1:]))
    along = json.loads((recording / "mission.json").read_text())["steps"][-1]
    body_m = tip_m = 0.0
    for row in range(along["start_tick"], min(along["end_tick"], len(truth.rows)), EVERY):
        centres = joint_centres_m(robot, truth.theta_deg(row))
        offs = [min(away(p, a, b) for a, b in pieces) for p in centres]
        body_m, tip_m = max(body_m, *offs[:-1]), max(tip_m, offs[-1])
    return body_m, tip_m


def run_once(binaries, mission, seed, points=None):
    with tempfile.TemporaryDirectory(prefix="liana-feeding-") as place:
        folder = pathlib.Path(place)
        if points is not None:
            mission = folder / "drawn.lua"
            mission.write_text(MISSION % ("{" + ", ".join("{%.9f, %.9f, %.9f}" % tuple(p) for p in points) + "}"))
        words = ["run", mission, "--seed", seed, "--json", folder / "report.json", "--record", folder / "record"]
        done = subprocess.run(
            [str(word) for word in (binaries / "liana", *words)],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "XDG_RUNTIME_DIR": str(folder)},
        )
        if done.returncode != 0:
            return {"seed": seed, "outcome": (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1]}
        report = json.loads((folder / "report.json").read_text())
        row = {"seed": seed, "outcome": report["outcome"], "duration_s": report["duration_s"]}
        row["min_motor_N"] = report["cable_tension_N"]["min_motor"]
        row["contact_N"] = report["max_contact_force_N"]
        if points is None:
            row["clearance_m"] = report["min_clearance_m"]
        else:
            row["body_off_m"], row["tip_off_m"] = true_body_off_m(folder / "record", points)
        return row


def study(binaries, first=FIRST_SEED, missions=MISSIONS, curves=CURVES, jobs=None):
    with concurrent.futures.ThreadPoolExecutor(jobs or os.cpu_count()) as pool:
        boxes = [pool.submit(run_once, binaries, "feeder_box", first + i) for i in range(missions)]
        drawn = [pool.submit(run_once, binaries, None, first + i, drawn_curve(first + i)) for i in range(curves)]
        out = {"missions": [], "curves": []}
        for name, jobs_of in (("missions", boxes), ("curves", drawn)):
            for job in jobs_of:
                out[name].append(job.result())
                print(f"   {name} {len(out[name])} of {len(jobs_of)}: {out[name][-1]}", file=sys.stderr, flush=True)
    return out


def row_of(name, rows, offs):
    done = [row for row in rows if row["outcome"] == "success"]
    worst = lambda key, of=max: of((row[key] for row in done), default=math.nan)  # noqa: E731
    return [
        name,
        f"{len(done)} of {len(rows)}",
        f"{worst('min_motor_N', min):.1f}",
        f"{worst('contact_N'):.2f}",
        *offs(worst),
    ]


def text_of(found):
    head = [
        "what",
        "success",
        "least tension at a motor N",
        "contact N",
        "least clearance mm",
        "true body off mm",
        "tip",
    ]
    box = row_of("`feeder_box`", found["missions"], lambda of: (f"{1e3 * of('clearance_m', min):.1f}", "", ""))
    along = lambda of: ("", f"{1e3 * of('body_off_m'):.1f}", f"{1e3 * of('tip_off_m'):.1f}")  # noqa: E731
    rows = [box, row_of("drawn curves", found["curves"], along)] if found["curves"] else [box]
    return table(head, rows)


def measure(binaries):
    found = study(binaries)
    return found, text_of(found)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, default=folders.ROOT / "build/bin")
    parser.add_argument("--first", type=int, default=FIRST_SEED)
    parser.add_argument("--count", type=int, default=MISSIONS)
    parser.add_argument("--curves", type=int, default=CURVES)
    parser.add_argument("--jobs", type=int)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    found = study(options.bin, options.first, options.count, options.curves, options.jobs)
    print(json.dumps(found) if options.json else text_of(found))


if __name__ == "__main__":
    main()
