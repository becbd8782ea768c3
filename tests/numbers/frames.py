"""What a picture of the console costs while a paced mission runs and everything is shown, in Chromium without a graphics
card (docs/getting-started/tour-of-the-console.md).

Alone: frames.py [--bin DIR] [--json].
"""
import json
import os
import subprocess

from folders import ROOT
from page import table


def measure(binaries):
    environment = {**os.environ, "LIANA_BIN": str(binaries)}
    command = ["node", "tests/page/run.mjs", "frames", "--judge-times"]
    ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    figures = json.loads((ROOT / "build/page/screens/frames.json").read_text())
    interval, age = figures["interval_ms"], figures["age_ms"]
    rows = [
        ["pictures a second", f"{figures['frames_per_s']:.1f}", ""],
        ["CPU time of one, all browser processes", f"{figures['cpu_ms_per_frame']:.1f} ms", "33 ms"],
        [
            "interval median, p90, p99",
            " / ".join(f"{interval[name]:.1f}" for name in ("median", "p90", "p99")),
            "p99 40 ms",
        ],
        ["age of the shown state, median, p99", f"{age['median']:.1f} / {age['p99']:.1f}", "40 / 100 ms"],
        ["other programs", f"{figures['others_cores']:.2f} cores", "0.3"],
        ["held", "yes" if ended.returncode == 0 else "NO", ""],
    ]
    return {**figures, "holds": ended.returncode == 0}, table(["what", "measured", "at most"], rows)


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
