"""An arm that loses a cable in the slit, led out on the cables that are left (docs/how-to/a-cable-broke.md): every
cable, two moments, seeded arms, judged by the truth.

Alone: recover.py [--bin DIR] [--count SEEDS] [--json].
"""
import collections
import json
import subprocess

from page import table

HEAD = [
    "cable",
    "out",
    "at its path's beginning",
    "faults on the way",
    "contact N, worst",
    "pulled N, worst",
    "s, longest",
]


def row(cable, trials):
    faults = sorted({str(trial["fault"]) for trial in trials if trial["fault"]})
    return [
        cable,
        f"{sum(trial['out'] for trial in trials)} of {len(trials)}",
        f"{sum(trial['back'] for trial in trials)} of {len(trials)}",
        " ".join(faults) or "-",
        f"{max(trial['contact_N'] for trial in trials):.1f}",
        f"{max(trial['max_N'] for trial in trials):.0f}",
        f"{max(trial['seconds'] for trial in trials):.0f}",
    ]


def measure(binaries, count=2):
    call = [str(binaries / "recover"), "--count", str(count), "--json"]
    told = subprocess.run(call, capture_output=True, text=True, check=True).stdout
    trials = [json.loads(line) for line in told.splitlines()]
    groups = collections.defaultdict(list)
    for trial in trials:
        groups[trial["cable"]].append(trial)
    text = "Nominal friction, two moments in the slit for each seed. Out: the tip is before the slit's mouth.\n\n"
    return trials, text + table(HEAD, [row(cable, groups[cable]) for cable in sorted(groups)])


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
