"""`liana pose` against tests/golden/arm.json: the largest difference of every quantity."""
import json

from asking import ask, joined
from folders import ROOT
from page import table

CASES = json.loads((ROOT / "tests/golden/arm.json").read_text())["cases"]
KEYS = ["tip_pose", "segment_ends_m", "jacobian", "cable_length_m", "cable_length_change_m"]


def largest_difference(a, b):
    if isinstance(a, list):
        return max(largest_difference(x, y) for x, y in zip(a, b, strict=True))
    return abs(a - b)


def measure(binaries):
    worst = dict.fromkeys(KEYS, 0.0)
    for case in CASES:
        answer = ask(binaries / "liana", "pose", f"--theta-deg={joined(case['theta_deg'])}", "--json")
        for key in KEYS:
            worst[key] = max(worst[key], largest_difference(answer[key], case[key]))
    return worst, table(
        ["quantity", f"largest difference over {len(CASES)} poses"], [[key, f"{worst[key]:.1e}"] for key in KEYS]
    )
