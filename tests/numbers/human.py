"""The slit crossing flown by the simulated human through simulated devices: seeds that nobody looked at, with force
feedback and without, and behind 0.5 s + 0.5 s.

Alone: human.py [--bin DIR] [--runs N]
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

FIRST_SEED = 60001
CASES = [
    ("aligned", ["--feedback", "aligned"], 20),
    ("off", ["--feedback", "off"], 20),
    ("aligned, 0.5 s + 0.5 s", ["--feedback", "aligned", "--delay", "0.5,0.5"], 10),
]
HEAD = ["feedback", "success", "contacts", "peak N", "arm time s median", "worst", "tip mm median", "worst"]
HEAD += ["slit mm least", "hand N most", "energy J least", "lag s median", "prediction mm median"]


def run_once(binaries, words, seed):
    """The report of one run."""
    with tempfile.TemporaryDirectory(prefix="liana-numbers-") as folder:
        file = pathlib.Path(folder) / "report.json"
        call = [str(binaries / "liana"), "run", "slit_crossing", "--operator", "human", "--seed", str(seed)]
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
        sum(numbers(reports, "contacts")),
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


def measure(binaries, most=None):
    seeds = {name: range(FIRST_SEED, FIRST_SEED + min(count, most or count)) for name, _, count in CASES}
    runs = {name: [run_once(binaries, words, seed) for seed in seeds[name]] for name, words, _ in CASES}
    whys = [
        f"\n- {name}, seed {report['seed']}: {report.get('reason', 'no report')}"
        for name, reports in runs.items()
        for report in reports
        if report["outcome"] != "success"
    ]
    text = f"Seeds from {FIRST_SEED} on, which nothing was tuned with.\n\n"
    text += table(HEAD, [row(name, reports) for name, reports in runs.items()])
    return runs, text + ("\n" + "".join(whys) if whys else "")


def main():
    line = argparse.ArgumentParser(description=__doc__)
    line.add_argument("--bin", default=str(ROOT / "build/bin"))
    line.add_argument("--runs", type=int)
    options = line.parse_args()
    print(measure(pathlib.Path(options.bin), options.runs)[1])


if __name__ == "__main__":
    main()
