"""ctest bench.instructions: the core's operations stay within their limits of instructions (plain -O2, callgrind: the same on every day)."""
import pathlib
import sys

import callgrind

LIMITS = {
    "fk_jacobian": 8_000,
    "ik_step": 12_000,
    "cable_jacobian": 6_000,
    "tick": 70_000,  # median; aim 40,000
}
WORST_TICK = 1.5  # times the median


def verdicts(counts):
    """(what, value, limit) for every limit; `counts`: label -> instructions of each call."""
    for operation in ("fk_jacobian", "ik_step", "cable_jacobian"):
        yield operation, max(counts[f"{operation} ours"]), LIMITS[operation]
    median, worst = callgrind.ticks({label.removeprefix("tick "): calls for label, calls in counts.items() if label.startswith("tick ")})
    yield "tick", median, LIMITS["tick"]
    yield "tick_worst", worst, round(WORST_TICK * median)


def main():
    counts = callgrind.instructions(pathlib.Path(sys.argv[1]))
    exceeded = 0
    for what, value, limit in verdicts(counts):
        exceeded += value > limit
        print(f"{what:16} {value:9,} of {limit:9,} instructions{'  EXCEEDED' if value > limit else ''}")
    return 1 if exceeded else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except callgrind.Failed as reason:
        sys.exit(f"bench: {reason}")
