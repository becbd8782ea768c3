"""How small a cable's fault is found, and how soon (docs/explanation/fault-detection.md): closed loop of core and arm,
one cable of every segment, two seeds.

Alone: detectors.py [--bin DIR] [--count SEEDS] [--json].
"""
import collections
import statistics

from asking import counted
from page import table

HEAD = [
    "fault",
    "physics",
    "found as",
    "of the right cable",
    "size: segment 1",
    "2",
    "3",
    "4",
    "5",
    "ticks: median, worst",
    "travel deg: median, worst",
]
SEGMENTS, CABLES_EACH = 5, 3


def spread(found, key, digits):
    """Median and worst."""
    values = [trial[key] for trial in found]
    return f"{statistics.median(values):.{digits}f}, {max(values):.{digits}f}" if values else "-"


def row(kind, physics, trials):
    found = [trial for trial in trials if trial["number"]]
    numbers = collections.Counter(trial["number"] for trial in found)
    named = " ".join(f"{number} x {count}" for number, count in sorted(numbers.items())) + (
        f", {len(trials) - len(found)} not" if len(found) < len(trials) else ""
    )
    right = sum(trial["index"] == trial["cable"] for trial in found)
    sizes = []
    for segment in range(SEGMENTS):
        own = [trial["size"] for trial in found if trial["cable"] // CABLES_EACH == segment]
        sizes.append(f"{max(own):.0f} {trials[0]['unit']}" if own and trials[0]["unit"] else "-")
    return [
        kind,
        physics,
        named,
        f"{right} of {len(found)}",
        *sizes,
        spread(found, "ticks", 0),
        spread(found, "travel_deg", 2),
    ]


def measure(binaries, count=2):
    trials = counted(binaries / "detectors", count)
    groups = collections.defaultdict(list)
    for trial in trials:
        groups[trial["kind"], trial["physics"]].append(trial)
    text = table(HEAD, [row(*key, group) for key, group in groups.items()])
    text = (
        "The size of a fault grows by 15 % until the fault is found; each row has the worst of a segment's seeds."
        f" Faults of missions without an injected fault are in [mission](#mission).\n\n{text}"
    )
    return trials, text


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
