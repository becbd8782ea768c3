"""20,000 random reachable goals of each kind by the goal IK, from the zero pose. Alone: planning_goals.py [--bin DIR]
[--count N] [--json].
"""

from asking import counted
from page import table

HEAD = ["held at 0", "theta within", "goals", "converged", "wrong", "iterations median", "p99", "most"]


def row(kind):
    iterations = kind["iterations"]
    return [
        kind["held"],
        f"{kind['range_deg']} deg",
        kind["goals"],
        f"{100 * kind['converged'] / kind['goals']:.3f} %",
        kind["wrong"],
        iterations["median"],
        iterations["p99"],
        iterations["most"],
    ]


def measure(binaries, count=20000):
    kinds = counted(binaries / "planning_goals", count)
    return kinds, table(HEAD, [row(kind) for kind in kinds])


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
