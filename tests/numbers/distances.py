"""100,000 pairs of a link and a body: distances of host/model/clearance against an exact reference (exact_distance.hpp).

Alone: distances.py [--bin DIR] [--count PAIRS] [--json].
"""

from asking import counted
from page import table

HEAD = ["body", "placed", "pairs", "touching", "of them free", "off by over 1 um", "worst below", "worst above"]


def row(kind):
    return [
        kind["body"],
        "aligned, on a grid" if kind["aligned"] else "at random",
        kind["pairs"],
        kind["touching"],
        kind["free"],
        kind["off"],
        f"{kind['below_m']:.1e} m",
        f"{kind['above_m']:.1e} m",
    ]


def measure(binaries, count=100000):
    kinds = counted(binaries / "distances", count)
    return kinds, table(HEAD, [row(kind) for kind in kinds])


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
