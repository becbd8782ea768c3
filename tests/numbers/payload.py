"""The payload's installation: 500 pushes of the controller against the bench's arm in which everything differs that may,
as a servo leaves it, 100 more for each misalignment up to what the adapter's funnels take, whole flights with programs, buses and drives, and
flights that begin misaligned before the adapter, on the soft base and on the stiff one.

Alone: payload.py [--bin DIR] [--count PUSHES] [--flights N] [--misaligned SOFT STIFF] [--keep FOLDER] [--json]. --keep: reports of flights are left
in FOLDER, and those that are there already are not flown again.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

from folders import ROOT
from page import table

PUSHES = 500
FLIGHTS = 10
FIRST_FLIGHT = 192001
MISSION = "payload_install"
MISALIGNED = [8, 12]  # on the soft base, on the stiff one
FIRST_MISALIGNED = {"macro_micro": 193001, "macro_micro_stiff": 194001}
PUSH = "3 push"
HEAD = ["asked", "least", "median", "95 %", "most"]
# Name in the row, what is asked, field, factor.
PUSH_ROWS = [
    ("captured after, s", "7 to 8 (source)", "captured_s", 1.0),
    ("peak force, N", "60", "peak_N", 1.0),
    ("peak joint torque, N m", "100", "peak_Nm", 1.0),
    ("base gives way, mm", "", "base_m", 1e3),
    ("left 1 s after the capture, N", "5", "after_1s_N", 1.0),
    ("overcome at the capture, N", "30 are set", "resisted_N", 1.0),
    ("loaded, s", "", "loaded_s", 1.0),
    ("ticks from the message to no set force", "2", "unload_ticks", 1),
]
MISALIGNED_HEAD = [
    "up to",
    "captured",
    "with a fault",
    "after s, median",
    "95 %",
    "most",
    "peak N most",
    "peak N m most",
]
FROM_ADAPTER_ROWS = [
    ("arm time, s", "", "duration_s", 1.0),
    ("under load, s", "", "load_duration_s", 1.0),
    ("peak force, N", "60", "peak_force_N", 1.0),
    ("peak joint torque, N m", "100", "peak_joint_torque_Nm", 1.0),
    ("insertion, mm", "about 20 (source)", "insertion_m", 1e3),
    ("below 5 N after, s", "1", "unload_s", 1.0),
    ("base gives way, mm", "", "base_deflection_m", 1e3),
]
FLIGHT_ROWS = [
    ("arm time, s", "", "duration_s", 1.0),
    ("servo to the adapter: true error, mm", "1", "servo_error_m", 1e3),
    ("its attitude, deg", "0.5", "servo_error_deg", 1.0),
    ("its sway, mm", "15", "lateral_sway_m", 1e3),
    ("force rises in, s", "about 7 (source)", "force_rise_s", 1.0),
    ("force before the capture, N", "30 (source)", "force_N", 1.0),
    ("peak force, N", "60", "peak_force_N", 1.0),
    ("peak joint torque, N m", "100", "peak_joint_torque_Nm", 1.0),
    ("insertion, mm", "about 20 (source)", "insertion_m", 1e3),
    ("below 5 N after, s", "1", "unload_s", 1.0),
    ("base gives way, mm", "", "base_deflection_m", 1e3),
    ("overcome at the capture, N", "30 are set", "resisted_N", 1.0),
]


def pushes(program, count):
    done = subprocess.run([program, "--json", "--count", str(count)], capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def begun(one):
    return f"{one['most_aside_mm']:g} mm, {one['most_tilt_deg']:g} deg"


def misaligned_row(name, pushed):
    captured = [one for one in pushed if one["captured_s"] > 0]
    after = spread("", "", [one["captured_s"] for one in captured])
    row = [name, f"{len(captured)} of {len(pushed)}", sum(one["faults"] > 0 for one in pushed), *after[3:]]
    return row + [f"{max(one[key] for one in pushed):.1f}" for key in ("peak_N", "peak_Nm")]


def spread(name, asked, values):
    if not values:
        return [name, asked, "-", "-", "-", "-"]
    ordered = sorted(values)
    of = [ordered[0], statistics.median(ordered), ordered[min(len(ordered) - 1, int(0.95 * len(ordered)))], ordered[-1]]
    return [name, asked, *(f"{value:.3g}" for value in of)]


def flight(binaries, mission, seed, file, words):
    if not file.exists():
        call = [binaries / "liana", "run", mission, "--time", "fast", "--seed", seed, "--json", file, *words]
        subprocess.run([str(word) for word in call], capture_output=True, check=False)
    report = json.loads(file.read_text()) if file.exists() else {"outcome": "no report"}
    print(f"   flight {seed}: {report['outcome']}", file=sys.stderr, flush=True)
    return {"seed": seed, **report}


def flights(binaries, mission, cases, folder):
    """`cases`: (seed, name of its report, further words)."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [
            pool.submit(flight, binaries, mission, seed, folder / f"{name}.json", words) for seed, name, words in cases
        ]
        return [job.result() for job in jobs]


def whole_flights(binaries, count, folder):
    cases = [(seed, f"whole_{seed}", []) for seed in range(FIRST_FLIGHT, FIRST_FLIGHT + count)]
    return flights(binaries, MISSION, cases, folder)


def from_the_adapter(folder):
    """The mission without what the station does and what comes before the adapter: it begins with the payload on the arm."""
    missions = ROOT / "lua" / "missions"
    shutil.copytree(missions / MISSION, folder / MISSION, dirs_exist_ok=True)
    text = (missions / f"{MISSION}.lua").read_text(encoding="utf-8")
    head, *steps = re.split(r'(?m)^  (?=step "[1-4] )', text)
    named = {re.match(r'step "([^"]+)"', step)[1]: re.sub(r"(?m)^  --.*\n", "", step) for step in steps}
    names = list(named)
    kept = names[names.index("3 servo to the adapter") : names.index("3 out of the mode") + 1]
    kept.remove("3 mutual mode")
    ways = 'on_fail = "hold",\n    next = { { step = "3 push", at_most = 9 } },'
    begin = named["3 mutual mode"].replace('on_fail = "hold",', ways)
    rest = [
        named[name].replace('{ step = "3 mutual mode" }', '{ step = "3 mutual mode", at_most = 9 }') for name in kept
    ]
    head = head.replace(f'liana.mission "{MISSION}"', 'liana.mission "from_the_adapter"')
    file = folder / "from_the_adapter.lua"
    file.write_text(head + "".join(f"  {step}" for step in (begin, *rest)) + "}\n", encoding="utf-8")
    return file


def misaligned_flights(binaries, counts, folder):
    cases, mission = [], from_the_adapter(folder)
    for (robot, first), count in zip(FIRST_MISALIGNED.items(), counts):
        words = ["--scene", "payload_misaligned", "--bus", "embedded_payload", "--robot", robot]
        cases += [(seed, f"misaligned_{seed}", words) for seed in range(first, first + count)]
    return flights(binaries, mission, cases, folder)


def flight_rows(rows, good):
    return [spread(*row[:2], [row[3] * one[row[2]] for one in good if one.get(row[2]) is not None]) for row in rows]


def not_installed(flown):
    bad = [one for one in flown if one["outcome"] != "success"]
    return "".join(f"\n\nSeed {one['seed']}: {one.get('reason', one['outcome'])}." for one in bad)


def misaligned_text(flown):
    good = [one for one in flown if one["outcome"] == "success"]
    text = (
        "\n\nThe same mission without the station's steps. The payload begins before the adapter, off its axis by up to 28 mm"
        " (20 mm in x and in y) and turned by up to 1 deg (scene `payload_misaligned`). If an insertion jams, the mission backs"
        f" off, servos and inserts again. {len(good)} of {len(flown)} installed.\n\n"
    )
    for robot, first in FIRST_MISALIGNED.items():
        there = [one for one in good if 0 <= one["seed"] - first < 1000]
        pushes_of = [sum(step["name"] == PUSH for step in one["steps"]) for one in there]
        counts = ", ".join(f"{pushes_of.count(n)} at insertion {n}" for n in sorted(set(pushes_of)))
        over = sum(one["peak_force_N"] > 60 for one in there)
        text += f"`{robot}`, seeds {first} on: {len(there)}, {counts}; {over} met more than 60 N.\n\n"
        text += table([f"of {len(there)} flights", *HEAD], flight_rows(FROM_ADAPTER_ROWS, there)) + "\n\n"
    return text.rstrip("\n") + not_installed(flown)


def measure(binaries, count=PUSHES, flown=FLIGHTS, misaligned=MISALIGNED, keep=None):
    every = pushes(binaries / "pushes", count)
    groups = {name: [one for one in every if begun(one) == name] for name in dict.fromkeys(map(begun, every))}
    pushed = groups[begun(every[0])]
    with tempfile.TemporaryDirectory() as folder:
        reports = pathlib.Path(keep or folder)
        reports.mkdir(parents=True, exist_ok=True)
        whole = whole_flights(binaries, flown, reports)
        begun_aside = misaligned_flights(binaries, misaligned, reports)
    captured = [one for one in pushed if one["captured_s"] > 0]
    rows = [spread(name, asked, [f * one[key] for one in captured]) for name, asked, key, f in PUSH_ROWS]
    text = (
        f"{len(captured)} of {len(pushed)} insertions captured, {sum(one['faults'] > 0 for one in pushed)} with a fault. Seeds"
        f" from {every[0]['seed']} draw the payload (300 to 1000 kg), the stiffness of base and gears, friction, the sensor's"
        " noise and offset, and the pins' stiffness.\n\n"
    )
    text += table([f"of {len(captured)} insertions", *HEAD], rows)
    text += "\n\nInsertions that begin off the axis and turned, in any direction, by at most the first column. The pins begin"
    text += " outside of their funnels (30 mm wide, the source's tolerance). Each has 40 s:\n\n"
    text += table(MISALIGNED_HEAD, [misaligned_row(name, group) for name, group in groups.items()])
    good = [one for one in whole if one["outcome"] == "success"]
    text += f"\n\n`liana run payload_install --time fast`, seeds {FIRST_FLIGHT} on: {len(good)} of {len(whole)} installed.\n\n"
    text += table([f"of {len(good)} flights", *HEAD], flight_rows(FLIGHT_ROWS, good)) + not_installed(whole)
    text += misaligned_text(begun_aside)
    keys = ["seed", "outcome", *(row[2] for row in FLIGHT_ROWS), "load_duration_s"]
    rows = [{key: one.get(key) for key in keys} for one in whole + begun_aside]
    return {"pushes": every, "flights": rows}, text


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/bin")
    parser.add_argument("--count", type=int, default=PUSHES)
    parser.add_argument("--flights", type=int, default=FLIGHTS)
    parser.add_argument("--misaligned", type=int, nargs=2, metavar=("SOFT", "STIFF"), default=MISALIGNED)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    values, text = measure(options.bin, options.count, options.flights, options.misaligned, options.keep)
    print(json.dumps(values) if options.json else text)


if __name__ == "__main__":
    main()
