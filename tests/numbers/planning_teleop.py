"""1000 random hand motions of 10 s at 250 Hz, judged tick by tick. Alone: planning_teleop.py [--bin DIR] [--count N]
[--json].
"""
import collections

from asking import ask
from page import table

HEAD = [
    "hand",
    "motions",
    "with a failed check",
    "largest step of a theta, deg a tick",
    "deg per mm",
    "returned after s, mean",
    "most",
]


def row(kind):
    return [
        kind["hand"],
        kind["motions"],
        kind["broken"],
        f"{kind['step_deg']:.3f}",
        f"{kind['step_deg_per_mm']:.2f}",
        f"{kind['back_mean_s']:.1f}",
        f"{kind['back_s']:.1f}",
    ]


def measure(binaries, count=1000):
    found = ask(binaries / "planning_teleop", "--count", count, "--json")
    causes = collections.Counter(violation["cause"] for violation in found["violations"])
    text = (
        "Failed checks by cause: "
        + (", ".join(f"{cause} {number}" for cause, number in causes.most_common()) or "none")
        + ".\n\n"
    )
    return found, text + table(HEAD, [row(kind) for kind in found["hands"]])


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
