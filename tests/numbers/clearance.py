"""The verified clearance against the truth, over seeds: nominal, worn and undeclared, the scene beside its drawing.

Alone: clearance.py [--bin DIR] [--count CASES] [--json]; a fourth of the cases is worn, a fourth misregistered.
"""
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import folders  # noqa: F401
from page import table

FIRST_SEED = 30001
KINDS = {
    "nominal": [],
    "worn, undeclared": ["--true-physics", "worn"],
    "scene 10 mm, 1 deg off": ["--scene-offset", "10,1"],
}
SHARES = ["nominal", "nominal", "worn, undeclared", "scene 10 mm, 1 deg off"]


def run_once(binaries, directory, kind, seed):
    file = pathlib.Path(directory) / f"{seed}.json"
    words = ["--seed", str(seed), "--json", str(file), *KINDS[kind]]
    done = subprocess.run(
        [str(binaries / "liana"), "run", "slit_crossing", *words],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "TMPDIR": directory},
    )
    report = json.loads(file.read_text()) if file.exists() else {"outcome": "no report", "reason": done.stderr[-300:]}
    report.update(kind=kind, seed=seed)
    claim = report.get("verified_clearance_m", {})
    print(
        f"   {kind} {seed}: {report['outcome']} {report.get('reason', '')}, claim above the truth in"
        f" {claim.get('ticks_above_truth', '-')} of {report.get('ticks', '-')} ticks",
        file=sys.stderr,
        flush=True,
    )
    return report


def claims(reports):
    return [(report["verified_clearance_m"], report["ticks"]) for report in reports if "verified_clearance_m" in report]


def milli(value):
    return f"{1e3 * value:.1f}"


def spread(values):
    """Least, median and most of some numbers."""
    values = sorted(values)
    return f"{milli(values[0])} / {milli(values[len(values) // 2])} / {milli(values[-1])}" if values else "-"


def row(kind, reports):
    held = claims(reports)
    above = sum(claim["ticks_above_truth"] for claim, _ in held)
    ticks = sum(ticks for _, ticks in held)
    crossed = [report for report in reports if report["outcome"] == "success"]
    return [
        kind,
        f"{len(crossed)} of {len(reports)}",
        f"{above} of {ticks}",
        milli(max((claim["most_above_truth_m"] for claim, _ in held), default=0.0)),
        spread([claim["min"] for claim, _ in held]),
        spread([claim["truth_min"] for claim, _ in held]),
        f"{max((report['duration_s'] for report in crossed), default=0.0):.1f}",
        spread([report["max_tip_speed_slit_m_s"] for report in reports if "max_tip_speed_slit_m_s" in report]),
    ]


HEAD = [
    "kind",
    "crossed",
    "ticks with a bound above the truth",
    "by mm at most",
    "least bound mm (least / median / most)",
    "least true clearance mm",
    "longest s",
    "true tip in the slit mm/s",
]


def measure(binaries, count=200):
    cases = [(SHARES[i % len(SHARES)], FIRST_SEED + i) for i in range(count)]
    with tempfile.TemporaryDirectory(prefix="liana-numbers-") as directory:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            reports = list(pool.map(lambda case: run_once(binaries, directory, *case), cases))
    rows = [row(kind, [report for report in reports if report["kind"] == kind]) for kind in KINDS]
    text = (
        f"Seeds {FIRST_SEED} to {FIRST_SEED + count - 1}, the kinds in turn. Each clearance bound is compared with the truth"
        " of every tick until the next bound.\n\n"
    )
    whys = [
        f"- {report['kind']} {report['seed']}: {report.get('reason', '')}\n"
        for report in reports
        if report["outcome"] != "success"
    ]
    return reports, text + table(HEAD, rows) + ("\n" + "".join(whys) if whys else "")


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
