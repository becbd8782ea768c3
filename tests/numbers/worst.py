"""The hunt for the most expensive tick at full size (docs/explanation/determinism.md): led by time, judged by counts of
callgrind.

Alone: worst.py [--bin DIR] [--count CASES] [--json].
"""
import subprocess
import tempfile

from folders import BENCH
import callgrind
from page import table

STORED = BENCH / "worst_cases.txt"
SEED = 1
COUNTED = 12  # of those that were found: time is no more than a guide


def searched(program, cases):
    """What was tried, and the worst cases in order of their time."""
    lines = subprocess.run(
        [program, "search", str(cases), str(SEED), STORED], capture_output=True, text=True, check=True
    ).stdout.splitlines()
    return lines[0].removeprefix("# "), [line for line in lines if not line.startswith("#")]


def worst_of(counts):
    return max(max(calls) for calls in counts.values())


def measure(binaries, count=20000):
    program = binaries / "bench_worst"
    phases = {
        label.removeprefix("tick "): calls
        for label, calls in callgrind.instructions(binaries / "bench_core").items()
        if label.startswith("tick ")
    }
    median, phases_worst = callgrind.ticks(phases)
    tried, found = searched(program, count)
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.write("\n".join(found[:COUNTED]) + "\n")
        file.flush()
        worst = {
            "phases of the bench": phases_worst,
            "stored cases": worst_of(callgrind.instructions(program, "stored", STORED)),
            "found now": worst_of(callgrind.instructions(program, "stored", file.name)),
        }
    rows = [[name, f"{value:,}", f"{value / median:.2f}"] for name, value in worst.items()]
    text = (
        f"Median of an enabled arm's ticks: {median:,} instructions. Search with seed {SEED}: {count} cases,"
        f" {tried}.\n\n"
    )
    return {"median": median, "worst": worst, "cases": count, "found": found[:COUNTED]}, text + table(
        ["worst of", "instructions", "times the median"], rows
    )


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
