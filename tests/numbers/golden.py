"""`liana pose` against tests/golden/arm.json: the largest difference of every quantity."""
import json
import pathlib
import subprocess

from page import table

CASES = json.loads((pathlib.Path(__file__).resolve().parents[1] / "golden/arm.json").read_text())["cases"]
KEYS = ["tip_pose", "segment_ends_m", "jacobian", "cable_length_m", "cable_length_change_m"]


def largest_difference(a, b):
    if isinstance(a, list):
        return max(largest_difference(x, y) for x, y in zip(a, b, strict=True))
    return abs(a - b)


def pose(binaries, theta_deg):
    call = [str(binaries / "liana"), "pose", "--theta-deg=" + ",".join(map(repr, theta_deg)), "--json"]
    return json.loads(subprocess.run(call, capture_output=True, text=True, check=True).stdout)


def measure(binaries):
    worst = dict.fromkeys(KEYS, 0.0)
    for case in CASES:
        answer = pose(binaries, case["theta_deg"])
        for key in KEYS:
            worst[key] = max(worst[key], largest_difference(answer[key], case[key]))
    return worst, table(
        ["quantity", f"largest difference over {len(CASES)} poses"], [[key, f"{worst[key]:.1e}"] for key in KEYS]
    )
