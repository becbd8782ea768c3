"""What the sources leave to the bench, and what Liana does otherwise than they say: the crossing with a part of the
arm's weight, with uneven linkages, and with the missions that follow the source to the word, over seeds.

Alone: sources.py [--bin DIR] [--count SEEDS] [--json].
"""
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

FIRST_SEED = 30001
CROSSING = (folders.ROOT / "lua/missions/slit_crossing.lua").read_text()


def changed(*pairs):
    """The shipped mission with some of its words exchanged; each stands in it once."""
    text = CROSSING
    for old, new in pairs:
        if text.count(old) != 1:
            raise SystemExit(f"sources.py: {old!r} stands {text.count(old)} times in the crossing, expected once")
        text = text.replace(old, new)
    return text


KINDS = {
    "as shipped": {},
    "0.5 % of the weight left": {"words": ["--gravity", "0.005"]},
    "1 %": {"words": ["--gravity", "0.01"]},
    "2 %": {"words": ["--gravity", "0.02"]},
    "2 % of it in the table, any direction": {"declared": 0.02},
    "3 %": {"declared": 0.03},
    "5 %": {"declared": 0.05},
    "linkage uneven by 1 %": {"words": ["--linkage-error", "0.01"]},
    "by 5 %": {"words": ["--linkage-error", "0.05"]},
    "by 10 %": {"words": ["--linkage-error", "0.1"]},
    "A40: 8+2 when segment 4 begins to enter": {
        "mission": changed(
            ("exit = needs_planar(2),", "exit = liana.tip_past(2.55), -- the mouth at 1.75 m and segment 5's 0.8 m"),
        ),
    },
}
FIELDS = {
    "tip error mm": lambda r: 1e3 * r["tip_error_m"],
    "open loop mm": lambda r: 1e3 * r["open_loop_tip_error_m"],
    "slit clearance mm": lambda r: 1e3 * r["min_slit_clearance_m"],
    "least tension N": lambda r: r["cable_tension_N"]["min_motor"],
    "time s": lambda r: r["duration_s"],
}


def rig(directory, share, seed):
    """A table of zhu2022 that knows of this share of its weight, in a direction that the seed draws."""
    draw = random.Random(seed)
    towards = [draw.gauss(0, 1) for _ in range(3)]
    size = math.sqrt(sum(x * x for x in towards))
    gravity = ", ".join(f"{9.80665 * share * x / size:.6f}" for x in towards)
    file = directory / "rig.lua"
    file.write_text(f'local robot = require "robots.zhu2022"\nrobot.gravity_m_s2 = {{ {gravity} }}\nreturn robot\n')
    return file


def run_once(binaries, directory, kind, seed):
    folder = pathlib.Path(directory)
    file, what = folder / "report.json", KINDS[kind]
    file.unlink(missing_ok=True)
    words, mission = [*what.get("words", [])], "slit_crossing"
    if "declared" in what:
        words += ["--robot", str(rig(folder, what["declared"], seed))]
    if "mission" in what:
        mission = str(folder / "variant.lua")
        pathlib.Path(mission).write_text(what["mission"])
    done = subprocess.run(
        [str(binaries / "liana"), "run", mission, "--seed", str(seed), *words, "--json", str(file)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "TMPDIR": directory},
    )
    report = json.loads(file.read_text()) if file.exists() else {"outcome": "no report", "reason": done.stderr[-300:]}
    print(f"   {kind} {seed}: {report['outcome']} {report.get('reason', '')}", file=sys.stderr, flush=True)
    return {"kind": kind, "seed": seed, **report}


def spread(values):
    values = sorted(values)
    return " / ".join(f"{value:.1f}" for value in (values[0], values[len(values) // 2], values[-1])) if values else "-"


def row(kind, reports):
    crossed = [report for report in reports if report["outcome"] == "success"]
    others = sorted({report.get("reason", "")[:60] for report in reports if report["outcome"] != "success"})
    figures = [spread([field(report) for report in crossed]) for field in FIELDS.values()]
    return [kind, f"{len(crossed)} of {len(reports)}", *figures, "; ".join(others) or "-"]


def measure(binaries, count=3):
    seeds = range(FIRST_SEED, FIRST_SEED + count)
    with tempfile.TemporaryDirectory(prefix="liana-numbers-") as directory:
        reports = [run_once(binaries, directory, kind, seed) for kind in KINDS for seed in seeds]
    rows = [row(kind, [report for report in reports if report["kind"] == kind]) for kind in KINDS]
    text = (
        f"Seeds {FIRST_SEED} to {FIRST_SEED + count - 1} in each row; least / median / most of those that crossed. What"
        " the rows mean: [sources-and-assumptions.md](../explanation/sources-and-assumptions.md).\n\n"
    )
    return reports, text + table(["kind", "crossed", *FIELDS, "why the others did not"], rows)


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
