"""Ours against the peers on the same arm: `./dev benchmark [--json FILE]`. Writes docs/measurements/benchmarks.md and shows
its tables.
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys
import time

import callgrind
from gate import LIMITS

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/numbers"))
from page import commit_of  # noqa: E402

PROGRAMS = ("bench_core", "bench_distances", "bench_kdl", "bench_collision", "bench_plan")
MEANING = {
    "fk_jacobian": "tip pose, nodes and 6x10 Jacobian, random poses within +-15 deg",
    "ik_step": "one damped step with limits, goal 10 mm away",
    "ik_near": "goal 10 mm away, to 1e-6 m and rad",
    "ik_random": "tip of a random pose within +-15 deg, from the straight arm",
    "cable_jacobian": "trigonometry, 15 cable lengths and their 15x10 Jacobian",
    "arm_clearance": "a whole arm of 40 links from two plates and a ball, half of the poses in the slit between them",
    "self_clearance": "the same arms from themselves",
    "clearance": "one link against one box; mean of 40 links and 6 boxes",
    "plan_edge": "whole plan of 12 waypoints past the scene's bodies, prepare to panel edge",
    "plan_ball": "the same past a ball that stands in the middle of the straight line in theta",
    "plan_slit": "the same through the slit, panel edge to press rod",
}
HEAD = """# Instructions and times beside peers

Written by `./dev benchmark`; do not edit by hand. {date}, commit {commit}, {compiler} at plain -O2 throughout, {machine},
took {seconds:.0f} s.

Callgrind (valgrind) counts the instructions of each call; a row shows the median over all calls. They repeat to within a
few instructions, and tests hold them below limits (`tests/benchmarks/gate.py`). Times are of one run on a machine with
other work, so they show an order of magnitude only. First the same program checks that ours and the peer agree: poses, Jacobians and cable lengths to 1e-9, solved goals to 1e-5 or better, FCL's
distances to 2 mm.
"""
TAIL = """## What the peers are

- `kdl`: Orocos KDL with 80 joints from the D-H rows of the source, columns summed to 6x10. It knows no coupled
  joints, so its inverse problems are easier than ours and its solutions are not for this arm.
- Pinocchio is not in Debian and not measured here. Version 3.7 at -O2 on the same 80 joints, summed to 6x10, once
  took 50,644 instructions for `fk_jacobian`.
- `own_80`: our own loop over 80 hinges, without waste; for inverse problems all 80 are free and have no limits.
- `every_pair`: our own distances without leaving anything out.
- `textbook`: every hole of every disc, hole to hole; derivative by central differences.
- `fcl`, `libccd`: no broad phase anywhere. All but `fcl` only say whether two bodies touch.
- `ipopt_straight`: Ipopt with our problem, derivatives and rounds, but from the straight line in theta instead of
  our start paths. One call each, the final check included, counted to within 0.01 %; the remark says how it ended.

Ticks are whole calls of `Controller::tick` with ideal drives, 100 in each phase. The median is over the phases in
which the controller holds or moves the arm (all but disabled and fault), the worst over every tick.
"""


def arguments():
    parser = argparse.ArgumentParser(prog="./dev benchmark", description=__doc__)
    parser.add_argument(
        "--json", type=argparse.FileType("w"), metavar="FILE", help="also write what was measured as JSON"
    )
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/bin", help="where the programs are")
    return parser.parse_args()


def table(head, rows):
    """A Markdown table with straight columns; numbers to the right."""
    lines = [[str(cell) for cell in line] for line in [head, *rows]]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    numeric = [all(line[i][:1].isdigit() for line in lines[1:]) for i in range(len(head))]
    rule = ["-" * (width - 1) + (":" if right else "-") for width, right in zip(widths, numeric)]
    padded = [
        [cell.rjust(width) if right else cell.ljust(width) for cell, width, right in zip(line, widths, numeric)]
        for line in lines
    ]
    return "\n".join("| " + " | ".join(line) + " |" for line in [padded[0], rule, *padded[1:]])


def compared(measured):
    """One entry for each operation and peer."""
    entries = []
    for (operation, version), peer in measured.items():
        if version == "ours" or operation == "tick":
            continue
        ours = measured[operation, "ours"]
        entries.append(
            {
                "name": operation,
                "ours_instructions": ours["instructions"],
                "peer": version,
                "peer_instructions": peer["instructions"],
                "ratio": round(peer["instructions"] / ours["instructions"], 2),
                "ours_worst_instructions": ours["worst_instructions"],
                "ours_ns": round(ours["ns"], 1),
                "peer_ns": round(peer["ns"], 1),
                "ours_note": ours["note"],
                "peer_note": peer["note"],
            }
        )
    return sorted(entries, key=lambda entry: (list(MEANING).index(entry["name"]), entry["peer"]))


def tick_entries(measured):
    """Median and worst tick; they have no peer."""
    nothing = {"peer": None, "peer_instructions": None, "ratio": None}
    median, worst = callgrind.ticks(
        {phase: entry["counts"] for (operation, phase), entry in measured.items() if operation == "tick"}
    )
    return [
        {"name": name, "ours_instructions": value, **nothing}
        for name, value in (("tick", median), ("tick_median", median), ("tick_worst", worst))
    ]


def phases(measured):
    return [
        {
            "phase": phase,
            "median_instructions": entry["instructions"],
            "worst_instructions": entry["worst_instructions"],
            "median_ns": round(entry["ns"], 1),
        }
        for (operation, phase), entry in measured.items()
        if operation == "tick"
    ]


def page_text(report):
    rows = [
        [
            e["name"],
            f"{e['ours_instructions']:,}",
            e["peer"],
            f"{e['peer_instructions']:,}",
            f"{e['ratio']:.1f}",
            f"{e['ours_ns']:,.0f}",
            f"{e['peer_ns']:,.0f}",
            e["peer_note"],
        ]
        for e in report["operations"]
        if e["peer"]
    ]
    notes = {(e["name"], e["ours_note"]) for e in report["operations"] if e.get("ours_note")}
    ticks = [
        [t["phase"], f"{t['median_instructions']:,}", f"{t['worst_instructions']:,}", f"{t['median_ns']:,.0f}"]
        for t in report["ticks"]
    ]
    value = {e["name"]: e["ours_instructions"] for e in report["operations"]}
    limits = [[name, f"{value[name]:,}", f"{limit:,}"] for name, limit in LIMITS.items() if name in value]
    return "\n".join(
        [
            "## Operations\n",
            table(
                [
                    "operation",
                    "instructions, ours",
                    "peer",
                    "instructions, peer",
                    "ratio",
                    "ns, ours",
                    "ns, peer",
                    "remark",
                ],
                rows,
            ),
            "",
            *[f"- `{name}`: {meaning}." for name, meaning in MEANING.items()],
            *[f"- `{name}`, ours: {note}." for name, note in sorted(notes)],
            "\n## Ticks\n",
            table(["phase", "instructions, median", "worst", "ns, median"], ticks),
            "\n## Limits held by the tests\n",
            table(["operation", "instructions", "limit"], limits),
            "",
            TAIL,
        ]
    )


def main():
    options = arguments()
    start = time.monotonic()
    measured = {}
    for program in PROGRAMS:
        print(f"== bench: {program}", file=sys.stderr, flush=True)
        measured.update(callgrind.measure(options.bin / program))
    report = {
        "commit": commit_of(ROOT),
        "operations": compared(measured) + tick_entries(measured),
        "ticks": phases(measured),
    }
    compiler = subprocess.run(["g++", "-dumpfullversion"], capture_output=True, text=True, check=False).stdout.strip()
    head = HEAD.format(
        date=datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
        commit=report["commit"],
        compiler=f"g++ {compiler}",
        machine=f"{os.cpu_count()} processors, {platform.machine()}",
        seconds=time.monotonic() - start,
    )
    text = page_text(report)
    (ROOT / "docs/measurements/benchmarks.md").write_text(f"{head}\n{text.rstrip()}\n")
    print(text)
    if options.json:
        print(json.dumps(report, indent=1), file=options.json)


if __name__ == "__main__":
    try:
        main()
    except callgrind.Failed as reason:
        sys.exit(f"bench: {reason}")
