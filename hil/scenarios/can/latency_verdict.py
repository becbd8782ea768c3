"""What measurements of lianad's thread at one rate and load say together: verdict of each run, how far runs differ,
the worst of all.
"""

WORST_WAKEUP_US = {"idle": 25, "loaded": 50, "console": 50}
MIN_MOVING = 0.5  # share of the time; the tip turns round now and then
AGREE_US = 10  # between any two runs, in every figure
TIMES = ("wakeup_us", "tick_us")
FIGURES = ("median", "p99", "worst")


def judge_run(run):
    """What is wrong with one measurement; empty when it holds."""
    if "error" in run:
        return run["error"]
    half_us = 5e5 / run["rate_hz"]
    wrong = [] if run["enabled"] else [f"the arm was not enabled all the time; faults: {run.get('faults', [])}"]
    if run["moving"] < MIN_MOVING:
        wrong.append(f"the arm moved for {100 * run['moving']:.0f} % of the time, asked for are {100 * MIN_MOVING:.0f}")
    for value, allowed, words in (
        (run["overruns"], 0, "overruns"),
        (run["wakeup_us"]["worst"], WORST_WAKEUP_US[run["load"]], "us worst wake-up"),
        (run["tick_us"]["worst"], half_us, "us longest tick"),
    ):
        if value > allowed:
            wrong.append(f"{value} {words}, allowed are {allowed:g}")
    return "; ".join(wrong)


def over_runs(runs, choose):
    return {time: {figure: choose([run[time][figure] for run in runs]) for figure in FIGURES} for time in TIMES}


def cell(rate_hz, load, runs):
    """One row of the report: the largest of all runs in each figure, all overruns, the largest difference, and the
    runs with their verdicts.
    """
    runs = [{**run, "verdict": judge_run(run) or "holds"} for run in runs]
    row = {"rate_hz": rate_hz, "load": load, "runs": runs}
    measured = [run for run in runs if "error" not in run]
    if measured:
        spread = over_runs(measured, lambda values: max(values) - min(values))
        row |= over_runs(measured, max) | {
            "overruns": sum(run["overruns"] for run in measured),
            "difference_us": max(value for time in TIMES for value in spread[time].values()),
        }
    return row


def judge(row):
    """What is wrong with a cell; empty when every run holds and they agree."""
    wrong = [
        f"run {number}: {run['verdict']}" for number, run in enumerate(row["runs"], 1) if run["verdict"] != "holds"
    ]
    if row.get("difference_us", 0) > AGREE_US:
        wrong.append(f"runs differ by {row['difference_us']} us, allowed are {AGREE_US}")
    return "; ".join(wrong)


def notes(row):
    if "wakeup_us" not in row:
        return []
    wakeup, tick = ("/".join(str(row[time][figure]) for figure in FIGURES) for time in TIMES)
    return [
        f"wake-up {wakeup} us, tick {tick} us (median/p99/worst of {len(row['runs'])} runs),"
        f" {row['overruns']} overruns, difference {row['difference_us']} us"
    ]
