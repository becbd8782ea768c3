"""Says which measured figures have expired: those of commits since which the measured sources have changed.

    python3 docs/check_figures.py [--json]   a line for each expired section of the measured pages; exit code 0

A figure that has expired may still be right; `./dev numbers NAME` or `./dev benchmark` measures it again.
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
CORE, ARM = ["firmware_like"], ["firmware_like", "host/control", "host/model", "hil", "lua"]
SIMULATOR = [f"hil/{room}" for room in ("arm", "bench", "bus", "config", "drive", "math", "payload", "serial")]
PLANS = ["firmware_like", "host/planning", "host/model"]
# Section: the sources that its figures are of; any other section is of ARM.
SOURCES = {
    "acceptance": [path for path in ARM if path != "hil"] + SIMULATOR + ["host/operator", "host/planning"],
    "archive": ["host/storage/archive"],
    "benchmarks": CORE,
    "clearance": ["host/model/clearance", "host/control/clearance_bound"],
    "filter": ["firmware_like/operator_input"],
    "frames": ["host/apps/web", "host/apps/gateway"],
    "fuzz": ["host", "tests/fuzz"],
    "gateway": ["host/apps/gateway"],
    "golden": ["firmware_like/cable", "firmware_like/math"],
    "ik": ["firmware_like/cable", "firmware_like/math", "host/model/inverse_kinematics"],
    "install": ["host", "firmware_like", "hil"],
    "latency": ["firmware_like", "host/control/realtime", "host/drives"],
    "payload": ["firmware_like/serial", "host/control", "lua"],
    "insertion": ["firmware_like/serial", "host/control/force_control"],
    "planning": PLANS,
    "distances": ["host/model/clearance", "host/planning"],
    "replay": ["firmware_like", "host/storage/recording"],
    "stability": ["host/operator/haptics"],
    "verdicts": ["host/control/verification", "host/model/simulation"],
    "worst": CORE,
}


def git(*words):
    """What git prints, or nothing where it does not know of it."""
    done = subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else None


def sections():
    """The sections of the measured pages, by name."""
    figures = (ROOT / "docs/measurements/figures.md").read_text()
    found = dict(re.findall(r"^## (\w+)\n(.*?)(?=^## |\Z)", figures, re.M | re.S))
    return {**found, "benchmarks": (ROOT / "docs/measurements/benchmarks.md").read_text()}


def changes_since(text, paths):
    """How many commits changed these paths since the oldest that the text names; None where none is in the history."""
    counts = []
    for commit in set(re.findall(r"\b(?=[0-9a-f]*\d)[0-9a-f]{7,12}\b", text)):
        if git("cat-file", "-t", commit) == "commit":
            counts.append(int(git("rev-list", "--count", f"{commit}..HEAD", "--", *paths)))
    return max(counts, default=None)


def expired_of(found):
    """Those sections that have expired, with the commits since; None where no commit of theirs is in the history."""
    counts = {name: changes_since(text, SOURCES.get(name, ARM)) for name, text in sorted(found.items())}
    return {name: count for name, count in counts.items() if count != 0}


def main(words):
    found = sections()
    expired = expired_of(found)
    if words == ["--json"]:
        print(json.dumps({"sections": len(found), "expired": expired}))
        return
    for name, count in expired.items():
        since = f"{count} commits changed what it measures" if count else "of a commit that this history does not have"
        print(f"expired: {name}: {since}")
    print(f"{len(expired)} of {len(found)} sections of figures have expired")


if __name__ == "__main__":
    main(sys.argv[1:])
