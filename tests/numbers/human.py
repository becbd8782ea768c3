"""The slit crossing flown by the simulated human through simulated devices: seeds that nobody looked at, with force
feedback and fixtures and without, behind 0.5 s + 0.5 s, and by lively hands.

Alone: human.py [--bin DIR] [--runs N] [--full] [--keep FOLDER]. --full: 100 runs, 20 without, 50 behind the delay, 100
lively; --keep: reports are left in FOLDER, and those that are there already are not run again.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

from folders import ROOT
from page import table

FIRST_SEED = 170001
# Name, words of `liana run`, runs, and runs of --full.
CASES = [
    ("aligned", ["--feedback", "aligned"], 20, 100),
    ("no feedback, no fixtures", ["--feedback", "off", "--fixtures", "off"], 20, 20),
    ("aligned, 0.5 s + 0.5 s", ["--feedback", "aligned", "--delay", "0.5,0.5"], 10, 50),
    ("aligned, lively", ["--feedback", "aligned", "--temper", "lively"], 20, 100),
]
HEAD = ["feedback", "success", "held", "contacts", "peak N", "arm time s median", "worst", "tip mm median", "worst"]
SAMPLES_HEAD = [
    "samples of",
    "runs",
    "apart ms, least",
    "most",
    "to release ms, median",
    "worst",
    "in force ms, median",
]
SAMPLES_HEAD += ["worst"]
HEAD += ["slit mm least", "hand N most", "energy J least", "lag s median", "prediction mm median"]


def run_once(binaries, words, seed, folder):
    """The report of one run, kept in `folder`; of that which is there already."""
    file = folder / f"{'_'.join(words).strip('-')}_{seed}.json"
    if not file.exists():
        call = [str(binaries / "liana"), "run", "slit_crossing", "--operator", "model", "--seed", str(seed)]
        subprocess.run([*call, *words, "--json", str(file)], capture_output=True, text=True, check=False)
    report = json.loads(file.read_text()) if file.exists() else {"outcome": "no report"}
    report["seed"] = seed
    print(f"   {' '.join(words)} {seed}: {report['outcome']}", file=sys.stderr, flush=True)
    return report


def numbers(reports, key, factor=1.0):
    return [factor * report[key] for report in reports if report.get(key) is not None]


def told(values, of, digits):
    return f"{of(values):.{digits}f}" if values else "-"


def row(name, reports):
    good = [report for report in reports if report["outcome"] == "success"]
    lags = [report.get("hand_to_tip_lag_s", {}).get("commanded") for report in reports]
    errors = [report.get("prediction_error_m") for report in reports]
    return [
        name,
        f"{len(good)} of {len(reports)}",
        sum(report["outcome"] != "success" and report.get("faults") == [] for report in reports),
        int(sum(numbers(reports, "contacts"))),
        told(numbers(reports, "peak_force_N"), max, 2),
        told(numbers(good, "duration_s"), statistics.median, 0),
        told(numbers(good, "duration_s"), max, 0),
        told(numbers(good, "tip_error_m", 1e3), statistics.median, 2),
        told(numbers(good, "tip_error_m", 1e3), max, 2),
        told(numbers(reports, "min_slit_clearance_m", 1e3), min, 1),
        told(numbers(reports, "peak_hand_force_N"), max, 1),
        told(numbers(reports, "min_port_energy_J"), min, 4),
        told([lag["median"] for lag in lags if lag], statistics.median, 2),
        told([1e3 * error["median"] for error in errors if error], statistics.median, 1),
    ]


def spread(values):
    return ", ".join(f"{value:.0f}" for value in sorted(values))


def samples_row(device, of_device):
    """Of all runs without a delay: worst of the worst, median of the medians."""
    median = {key: [one[key]["median"] for one in of_device] for key in ("to_release_s", "in_force_s")}
    worst = {key: [one[key]["worst"] for one in of_device] for key in ("to_release_s", "in_force_s")}
    apart = [one["interval_s"] for one in of_device]
    cells = [device, len(of_device)]
    cells += [f"{1e3 * min(one['least'] for one in apart):.2f}", f"{1e3 * max(one['most'] for one in apart):.2f}"]
    for key in median:
        cells += [f"{1e3 * statistics.median(median[key]):.1f}", f"{1e3 * max(worst[key]):.1f}"]
    return cells


def samples_text(runs):
    told = [one["operator_samples"] for name, _, _, _ in CASES[:2] for one in runs[name] if "operator_samples" in one]
    rows = [samples_row(name, [one[name] for one in told if one.get(name)]) for name in ("vr", "hand") if told]
    return "\n\nTimes of samples in arm time, without a delay and without the time of verification:\n\n" + table(
        SAMPLES_HEAD, rows
    )


def text_of(runs):
    """What the page says of reports, by name of the case."""
    whys = [
        f"\n- {name}, seed {report['seed']}: {report.get('reason', 'no report')}"
        for name, reports in runs.items()
        for report in reports
        if report["outcome"] != "success"
    ]
    text = f"Seeds from {FIRST_SEED} on, which nothing was tuned with. Held: without a fault, the arm holds and can go on.\n\n"
    text += table(HEAD, [row(name, reports) for name, reports in runs.items()])
    text += "\n\nArm times of the successful ones, s:\n"
    for name, reports in runs.items():
        good = [report for report in reports if report["outcome"] == "success"]
        text += f"\n- {name}: {spread(numbers(good, 'duration_s'))}"
    return text + ("\n\nWhat failed:\n" + "".join(whys) if whys else "") + samples_text(runs)


def measure(binaries, most=None, full=False, keep=None):
    with tempfile.TemporaryDirectory(prefix="liana-numbers-") as scratch:
        folder = pathlib.Path(keep or scratch)
        folder.mkdir(parents=True, exist_ok=True)
        runs = {}
        for name, words, some, many in CASES:
            count = min(many if full else some, many if most is None else most)
            seeds = range(FIRST_SEED, FIRST_SEED + count)
            runs[name] = [run_once(binaries, words, seed, folder) for seed in seeds]
    return runs, text_of(runs)


def main():
    line = argparse.ArgumentParser(description=__doc__)
    line.add_argument("--bin", default=str(ROOT / "build/bin"))
    line.add_argument("--runs", type=int)
    line.add_argument("--full", action="store_true")
    line.add_argument("--keep")
    options = line.parse_args()
    print(measure(pathlib.Path(options.bin), options.runs, options.full, options.keep)[1])


if __name__ == "__main__":
    main()
