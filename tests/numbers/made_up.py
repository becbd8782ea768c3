"""Arms that nobody has looked at, made up by seed (tests/host/apps/cli/made_up_arms.py): kinematics against one written once
more, goals that are surely reachable, a mission on the bench with its replay, and the bits of its ticks elsewhere.

Alone: made_up.py [--bin DIR] [--count ARMS] [--first SEED] [--weight] [--json]. With --weight they are mounted in any
direction, with masses up to what `liana robot check` lets them have.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

import folders
from asking import ask, joined, quaternion_of
from page import table

sys.path[:0] = [str(folders.ROOT / "tests/host/apps/cli"), str(folders.ROOT / "tests/bits")]
from made_up_arms import TOUR, angles_of, loaded, table_of, tip_of  # noqa: E402 (found through the line above)
import run as bits  # noqa: E402

ARMS = 100
FIRST_SEED = 5000
GOALS = 20  # of each arm
ANGLES_FOR_A_POSE = 6  # with fewer, a tip's pose has no freedom to be asked for
ELSEWHERE = ("clang_O2", "aarch64_O2")
TICKS = 3000  # of each mission are played elsewhere


def kinematics_error(binaries, robot, arm, draw):
    """The largest difference of an element of the tip's pose, m or 1."""
    theta_deg = angles_of(arm, draw)
    words = ("pose", "--robot", robot, f"--theta-deg={joined(theta_deg)}", "--json")
    told, expected = ask(binaries / "liana", *words)["tip_pose"], tip_of(arm, theta_deg)
    return max(abs(told[i][j] - expected[i][j]) for i in range(4) for j in range(4))


def goal_found(binaries, robot, arm, draw):
    """From zero, a pose that the arm has at angles within its limits: converged, and whether that was true."""
    pose = tip_of(arm, angles_of(arm, draw))
    tip = [row[3] for row in pose[:3]] + quaternion_of(pose)
    zero = joined([0.0] * 2 * len(arm["segments"]))
    answer = ask(binaries / "liana", "ik", "--robot", robot, f"--from-deg={zero}", f"--tip={joined(tip)}", "--json")
    told = tip_of(arm, answer["theta_deg"])
    off = max(abs(told[i][j] - pose[i][j]) for i in range(4) for j in range(4))
    return {"converged": answer["converged"], "wrong": answer["converged"] and off > 1e-6}


def mission(binaries, robot, folder):
    """What `liana run` reports of a tour through two poses, and how many ticks of its replay differ."""
    (folder / "tour.lua").write_text(TOUR)
    words = ["run", folder / "tour.lua", "--robot", robot, "--scene", "none", "--record", folder / "record"]
    done = subprocess.run(
        [str(word) for word in (binaries / "liana", *words, "--json", folder / "report.json")],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "XDG_RUNTIME_DIR": str(folder)},
    )
    if done.returncode != 0:
        return {"outcome": done.stderr.strip().splitlines()[-1:]}
    report = json.loads((folder / "report.json").read_text())
    replayed = ask(binaries / "liana", "replay", folder / "record", "--json")
    return {"outcome": "success", "replay": replayed["differing_ticks"], "duration_s": report["duration_s"]}


def problems_of(binaries, robot, arm):
    robot.write_text(json.dumps(arm))
    return ask(binaries / "liana", "robot", "check", robot, "--json")["problems"]


def one_arm(binaries, players, seed, has_weight):
    arm, draw = table_of(seed), random.Random(f"study {seed}")
    with tempfile.TemporaryDirectory(prefix="liana-arms-") as place:
        folder = pathlib.Path(place)
        robot = folder / "robot.json"
        if has_weight:
            light = problems_of(binaries, robot, arm)
            arm = loaded(arm, seed, lambda heavy: problems_of(binaries, robot, heavy) == light)
        found = {
            "seed": seed,
            "angles": 2 * len(arm["segments"]),
            "drives": len(arm["drives"]["direction"]),
            "problems": problems_of(binaries, robot, arm),
            "kinematics": max(kinematics_error(binaries, robot, arm, draw) for _ in range(GOALS)),
            "goals": [],
        }
        if found["angles"] >= ANGLES_FOR_A_POSE:
            found["goals"] = [goal_found(binaries, robot, arm, draw) for _ in range(GOALS)]
        found["mission"] = mission(binaries, robot, folder)
        if found["mission"]["outcome"] == "success":
            tape = bits.Tape(binaries, folder, "tour", "make", [folder / "record"], "--limit", TICKS)
            plays = [target.play(built, tape) for target, built in players]
            found["bits"] = {each["name"]: [each["ticks"], each["differing_ticks"]] for each in plays}
    return found


def study(binaries, first, count, has_weight):
    work = folders.ROOT / "build/bits"
    work.mkdir(parents=True, exist_ok=True)
    players = [(target, target.build(work)) for target in bits.ALL_TARGETS if target.name in ELSEWHERE]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        arms = []
        for arm in pool.map(lambda seed: one_arm(binaries, players, seed, has_weight), range(first, first + count)):
            arms.append(arm)
            print(f"   arm {len(arms)} of {count}: {arm['mission']['outcome']}", file=sys.stderr, flush=True)
    return arms


def summary(arms):
    goals = [(arm["seed"], goal) for arm in arms for goal in arm["goals"]]
    done = [arm for arm in arms if arm["mission"]["outcome"] == "success"]
    return {
        "arms": len(arms),
        "first_seed": arms[0]["seed"],
        "worst_kinematics": max(arm["kinematics"] for arm in arms),
        "goals": len(goals),
        "converged": sum(goal["converged"] for _, goal in goals),
        "wrong": sum(goal["wrong"] for _, goal in goals),
        "goals_missed_by_seed": sorted(seed for seed, goal in goals if not goal["converged"]),
        "missions": len(done),
        "missions_failed": {arm["seed"]: arm["mission"]["outcome"] for arm in arms if arm not in done},
        "replays_that_differ": sum(arm["mission"]["replay"] > 0 for arm in done),
        "problems": {arm["seed"]: arm["problems"] for arm in arms if arm["problems"]},
        "ticks_elsewhere": {name: sum(arm["bits"][name][0] for arm in done) for name in ELSEWHERE},
        "ticks_that_differ": {name: sum(arm["bits"][name][1] for arm in done) for name in ELSEWHERE},
        "duration_s": sorted(arm["mission"]["duration_s"] for arm in done),
    }


def measure(binaries, first=FIRST_SEED, count=ARMS, has_weight=False):
    arms = study(binaries, first, count, has_weight)
    found = summary(arms)
    elsewhere = ", ".join(
        f"{name} {found['ticks_that_differ'][name]} of {found['ticks_elsewhere'][name]}" for name in ELSEWHERE
    )
    rows = [
        ["arms, seeds", f"{found['arms']}, from {found['first_seed']}"],
        ["that `liana robot check` finds something wrong with", len(found["problems"])],
        ["kinematics: worst difference to that written once more", f"{found['worst_kinematics']:.1e}"],
        [
            f"goals found, arms of {ANGLES_FOR_A_POSE} angles or more",
            f"{found['converged']} of {found['goals']} ({100 * found['converged'] / max(1, found['goals']):.2f} %)",
        ],
        ["wrongly called converged", found["wrong"]],
        ["missions carried out", f"{found['missions']} of {found['arms']}"],
        ["replays that differ", found["replays_that_differ"]],
        ["ticks that differ elsewhere", elsewhere],
    ]
    return found, table(["what", "figure"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, default=folders.ROOT / "build/bin")
    parser.add_argument("--count", type=int, default=ARMS)
    parser.add_argument("--first", type=int, default=FIRST_SEED)
    parser.add_argument("--weight", action="store_true")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    values, text = measure(options.bin.resolve(), options.first, options.count, options.weight)
    print(json.dumps(values) if options.json else text)


if __name__ == "__main__":
    main()
