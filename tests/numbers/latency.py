"""lianad's real-time thread in the virtual machine whose clock counts instructions: 250 and 500 Hz, idle and under
load, each so often in turn.
"""
import os

import folders  # noqa: F401
from can import latency_verdict, machine
from page import table


def times(row):
    return [
        " / ".join(str(row[time][figure]) for figure in ("median", "p99", "worst")) for time in ("wakeup_us", "tick_us")
    ]


def lines(cell):
    """One line of the table per run, and one for all of them."""
    name = [f"{cell['rate_hz']:g} Hz", {"idle": "nothing", "loaded": "load", "console": "console"}[cell["load"]]]
    runs = [
        [*name, number, *times(run), run["overruns"], "", run["verdict"]] for number, run in enumerate(cell["runs"], 1)
    ]
    return [
        *runs,
        [
            *name,
            "worst of all",
            *times(cell),
            cell["overruns"],
            cell["difference_us"],
            "holds" if cell["holds"] else "fails",
        ],
    ]


def measure(binaries, count=3):
    os.environ["LIANA_BIN"] = str(binaries)
    _, cells = machine.run_all(
        [item for item in machine.all_items() if item.is_latency()], lambda row: None, {"250": count, "500": count}
    )
    broken = [run["error"] for cell in cells for run in cell["runs"] if "error" in run]
    if broken:
        raise SystemExit(f"latency: {broken[0]}")
    cells = [{**cell, "holds": not latency_verdict.judge(cell)} for cell in cells]
    text = (
        "Microseconds, median / 99 % / worst, in a guest of 500 MIPS"
        " ([real-time-latency.md](../explanation/real-time-latency.md)); the last column but"
        " one is the largest difference between runs in any figure.\n\n"
    )
    text += table(
        ["ticks", "beside it", "run", "wake-up", "tick", "overruns", "difference", "verdict"],
        [line for cell in cells for line in lines(cell)],
    )
    return {"cells": cells}, text


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
