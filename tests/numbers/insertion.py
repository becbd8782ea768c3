"""How quick a push may be, and what it leaves of the base: slower and slower ways in on the soft base and on one 20 times
as stiff (insertion_speeds.cpp); draws docs/pictures/push.svg.

Alone: insertion.py [--bin DIR] [--json].
"""
import json
import statistics
import subprocess

from folders import ROOT
from page import table

PICTURE = ROOT / "docs/pictures/push.svg"
FORCE_N, APPROACH_SHARE = 30.0, 0.3  # push.hpp
BASES = {1: "soft", 20: "stiff"}
HEAD = ["base", "K_D, N s/m", "speed, mm/s", "captured", "after s: median, most", "hardest N", "a ton at a wall, N"]
HEAD += ["base sways within 5 s, mm: median, most", "20 to 30 s later"]


def middle_and_most(values, factor, form):
    return ", ".join(format(factor * of(values), form) for of in (statistics.median, max)) if values else "-"


def row(share, damping, found):
    pushed = [one for one in found if "seed" in one]
    captured = [one for one in pushed if one["captured_s"] > 0]
    return [
        BASES[share],
        f"{damping:g}",
        f"{1e3 * APPROACH_SHARE * FORCE_N / damping:.2f}",
        f"{len(captured)} of {len(pushed)}",
        middle_and_most([one["captured_s"] for one in captured], 1.0, ".1f"),
        f"{max(one['peak_N'] for one in pushed):.0f}",
        f"{next(one['wall_N'] for one in found if 'wall_N' in one):.0f}",
        middle_and_most([one["swing_5s_m"] for one in captured], 1e3, ".1f"),
        middle_and_most([one["swing_30s_m"] for one in captured], 1e3, ".2f"),
    ]


def measure(binaries):
    done = subprocess.run([binaries / "insertion_speeds"], capture_output=True, text=True, check=True)
    subprocess.run([binaries / "insertion_speeds", "--svg", PICTURE], check=True)
    found = [json.loads(line) for line in done.stdout.splitlines()]
    cases = {(one["base_share"], one["damping_Ns_m"]): [] for one in found}
    for one in found:
        cases[one["base_share"], one["damping_Ns_m"]].append(one)
    text = (
        "Insertions with 30 N, each row with a larger K_D, which makes them slower. Payloads, friction, gears and walls are"
        ' drawn, 8 seeds a row. "A ton at a wall": a payload of a ton misses its holes by 1.5 mm and meets pins of'
        " 200 kN/m, the hardest of four directions. Sway is half the distance between its two ends.\n\n"
    )
    return found, text + table(HEAD, [row(*case, ones) for case, ones in cases.items()])


if __name__ == "__main__":
    import argparse
    import pathlib

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/bin")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    values, text = measure(options.bin)
    print(json.dumps(values) if options.json else text)
