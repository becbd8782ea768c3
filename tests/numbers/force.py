"""How well the force at the tip is estimated (docs/explanation/contact-force.md): 20 configurations of 10 forces on the
bench's own processes, nominal and worn, and what friction costs in the closed loop.

Alone: force.py [--bin DIR] [--count PUSHES] [--json].
"""
from asking import ask, counted
from page import table

HEAD = ["state", "force N", "forces", "bias N", "RMS N", "largest N", "within 95 %", "axes seen"]
FRICTION_HEAD = ["subtracted friction", "at rest N", "moving N", "after a dither N", "free, moving N"]
STATES = {"still": "at rest", "dithered": "after a dither", "resting": "at rest"}
FRICTIONS = {"as felt": "as measured"}
CONFIGURATIONS = 20
SEED = 63001  # nothing was tuned with it


def figure(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def error_row(row):
    return [
        STATES.get(row["state"], row["state"]),
        "all" if row["size_N"] is None else f"{row['size_N']:.0f}",
        row["count"],
        figure(row["bias_N"]),
        figure(row["rms_N"]),
        figure(row["largest_N"]),
        figure(row["within_95"], 3),
        figure(row["seen"]),
    ]


def text_of(test):
    found_from = f"A force is found once {test['found_from_N']:.1f} N are published."
    lines = [f"{test['physics']}. {found_from}\n", table(HEAD, [error_row(row) for row in test["errors"]]), ""]
    for row in test["found"]:
        after = (
            f", after {row['median_s']:.2f} s in the median, {row['latest_s']:.2f} s at most" if row["found"] else ""
        )
        state = STATES.get(row["state"], row["state"])
        lines.append(f"- {row['size_N']:.0f} N, {state}: found {100 * row['found']:.1f} % of {row['count']}{after}")
    for how, row in test["free"].items():
        lines.append(
            f"- no force, {STATES.get(how, how)}: {row['median_N']:.2f} N are published in the median, {row['p99_N']:.2f} N at 99 %,"
            f" {row['largest_N']:.2f} N at most; {row['found']} of {row['looks']} rounds find a force"
        )
    body = test["body"]
    lines.append(
        f"- forces on the body: {body['count']}, detected {body['felt']}, on the right segment {body['right']}"
    )
    faults = ", ".join(f"{fault['number']} at {fault['pushed_N']:.1f} N" for fault in test["watchdogs"]) or "none"
    lines.append(f"- forces that ended in a fault: {faults}")
    return "\n".join(lines)


def friction_row(row):
    return [FRICTIONS.get(row["friction"], row["friction"])] + [
        figure(row[key]) for key in ("still_N", "moving_N", "dithered_N", "free_moving_N")
    ]


def measure(binaries, count=200):
    pushes = max(1, count // CONFIGURATIONS)
    words = ["force", "--self-test", "--configurations", CONFIGURATIONS, "--pushes", pushes, "--seed", SEED, "--json"]
    tests = [ask(binaries / "liana", *words, f"--physics={physics}") for physics in ("nominal", "worn")]
    friction = counted(binaries / "force_friction", max(1, count // 3))
    text = "\n\n".join(text_of(test) for test in tests)
    text += "\n\nRMS of the error, closed loop of core and physics, nominal, other seeds:\n\n"
    text += table(FRICTION_HEAD, [friction_row(row) for row in friction["rows"]])
    return {"tests": tests, "friction": friction}, text


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
