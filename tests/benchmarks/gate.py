"""ctest bench.instructions: the core's operations stay within their limits of instructions (plain -O2, callgrind: the
same on every day; req:A10 req:A36 req:A37).

gate.py BENCH_CORE BENCH_WORST CASES BENCH_VERIFY BENCH_DISTANCES: the worst tick is that of the bench's phases, of the
stored cases and of some random ones; BENCH_VERIFY is what one command costs, with its whole stop.
"""
import pathlib
import statistics
import sys

import callgrind

LIMITS = {
    "fk_jacobian": 8_000,
    "ik_step": 12_000,
    "cable_jacobian": 6_000,
    "arm_clearance": 28_000,
    "self_clearance": 36_000,
    "tick": 39_600,  # median; 36 000 without mass
    "tick_worst": 68_250,  # the stored cases; 15 times kTickInstructionsPerDrive of host/control/verification
    "verify": 4_888_000,  # median over the motions of tests/benchmarks/verify.cpp that move the tip or a joint
    "verify_worst": 6_490_000,  # a tip at full speed takes 0.85 s to brake
    "simulate": 1_440_000,  # the simulation end on the same commands, median
}
RANDOM_CASES = (3, 1)  # how many, and their seed
LEAST_OWN_80 = {"fk_jacobian": 2.5, "ik_near": 5.0}  # own_80 over ours


def worst_of(counts):
    return max(max(calls) for calls in counts.values())


def verdicts(counts, worst_cases, verified):
    """(what, holds, text) for every limit; `counts`: label -> instructions of each call, `worst_cases`: name -> the
    same, `verified`: motion -> instructions of each command.
    """

    def at_most(what, value, limit):
        return what, value <= limit, f"{value:,} instructions, at most {limit:,}"

    for operation in ("fk_jacobian", "ik_step", "cable_jacobian", "arm_clearance", "self_clearance"):
        yield at_most(operation, max(counts[f"{operation} ours"]), LIMITS[operation])
    median, worst = callgrind.ticks(
        {label.removeprefix("tick "): calls for label, calls in counts.items() if label.startswith("tick ")}
    )
    yield at_most("tick", median, LIMITS["tick"])
    yield at_most("tick_worst", worst, LIMITS["tick_worst"])
    for name, cases in worst_cases.items():
        yield at_most(name, worst_of(cases), LIMITS["tick_worst"])
    for end in ("verify", "simulate"):
        moving = [
            count
            for label, calls in verified.items()
            if label.startswith(f"{end} ") and label != f"{end} standing"
            for count in calls
        ]
        yield at_most(end, round(statistics.median(moving)), LIMITS[end])
    twins = {label: calls for label, calls in verified.items() if label.startswith("verify ")}
    yield at_most("verify_worst", worst_of(twins), LIMITS["verify_worst"])
    for operation, least in LEAST_OWN_80.items():
        ratio = statistics.median(counts[f"{operation} own_80"]) / statistics.median(counts[f"{operation} ours"])
        yield f"{operation} own_80", ratio >= least, f"{ratio:.2f} times ours, at least {least}"


def main():
    core, worst, cases, verify, distances = map(pathlib.Path, sys.argv[1:])
    worst_cases = {
        "stored_cases": callgrind.instructions(worst, "stored", cases),
        "random_cases": callgrind.instructions(worst, "random", *RANDOM_CASES),
    }
    counts = callgrind.instructions(core) | callgrind.instructions(distances)
    results = list(verdicts(counts, worst_cases, callgrind.instructions(verify)))
    for what, holds, text in results:
        print(f"{'held' if holds else 'BROKEN':6} {what:20} {text}")
    return 0 if all(holds for _, holds, _ in results) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except callgrind.Failed as reason:
        sys.exit(f"bench: {reason}")
