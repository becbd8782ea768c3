"""500 random tip poses with random node targets: the tick's shape against the best of 50 offline solves.

Alone: planning_shape.py [--bin DIR] [--count N] [--json]. What is measured: docs/explanation/shape.md.
"""

from asking import counted
from page import table


def share(part, whole):
    return f"{part} of {whole} ({100 * part / whole:.1f} %)" if whole else "none"


def rows(found):
    cases = found["cases"]
    return [
        ["tick meets the offline solve from the same start", share(found["tick_same_branch"], cases)],
        ["tick meets the best, left to itself", share(found["tick_best"], cases)],
        ["tick meets the best, led to the goal IK's shape first", share(found["guided_best"], cases)],
        ["goal IK meets the best", share(found["goal_best"], cases)],
        ["with thresholds, led: meets the best", share(found["thresholds_best"], found["with_thresholds"])],
        ["four times the weight: the node came no farther", share(found["heavier_closer"], found["with_rivals"])],
        ["worst tip error after a tick, m and rad", f"{found['worst_tip_error']:.1e}"],
        [
            "largest joint rate, acceleration",
            f"{found['worst_rate_deg_s']:.2f} deg/s, {found['worst_accel_deg_s2']:.2f} deg/s2",
        ],
    ]


def measure(binaries, count=500):
    found = counted(binaries / "planning_shape", count)
    return found, table(["what", "measured"], rows(found))


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
