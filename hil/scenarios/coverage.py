#!/usr/bin/env python3
"""Which scenario or test shows each fault number: the second table of docs/reference/faults.md. `--measured FILE` adds
the ticks of a `./dev hil --json FILE`.
"""
import argparse
import collections
import json
import pathlib
import re
import subprocess
import sys

import source_tree  # noqa: F401
import scenario

SHOWN = 2  # scenarios named for each number, the first in bring-up order

# What no scenario can bring about: the test that does, by the file that holds it.
TESTS = {
    1001: (
        "Controller.ATelecommandThatIsNotANumberIsFault1001AndNeverFollowed",
        "tests/firmware_like/controller_test.cpp",
    ),
    2002: ("SerialController.AJointPushedOutOfItsRangeIsAFault", "tests/firmware_like/serial_controller_test.cpp"),
    2004: ("Force.WhateverTheWristSensorSaysOrDoesNotThePushEndsByNameAndTheForceGoes", "tests/serial/force_test.cpp"),
    2005: ("Force.ABlowAtTheTipEndsThePushAsOverload", "tests/serial/force_test.cpp"),
    5009: (
        "FrictionWatch.ThePlanFollowsSlowlyAndNeverBeyondWhatTensionsCanCarry",
        "tests/firmware_like/friction_estimator_test.cpp",
    ),
    5010: (
        "LoadCell.OneThatIsLostIsFault5010AfterTwentyFiveTicksUnlessTheTableGoesOnByTorque",
        "tests/firmware_like/load_cell_test.cpp",
    ),
    6001: ("Gate.ARefusalBecomesAFaultThatNamesDriveAndCheck", "tests/firmware_like/gate_test.cpp"),
}


def shown_by():
    """Fault number -> scenarios that expect it, in bring-up order."""
    found = collections.defaultdict(list)
    for one in scenario.all_scenarios():
        for number in filter(None, [one.expect.get("fault"), *one.expect.get("also", [])]):
            found[number].append(one.name)
    return found


def measured_ticks(path):
    """Fault number -> ticks after which it was latched, over the notes of all scenarios."""
    found = {}
    for row in json.loads(path.read_text())["scenarios"]:
        for note in row["notes"]:
            match = re.fullmatch(r"(\d{4}) after (\d+) ticks", note)
            if match and row["outcome"] == "passed" and re.match(r"[1-5]\d_", row["name"]):
                found.setdefault(int(match[1]), []).append(int(match[2]))
    return found


def row(number, scenarios, measured):
    test, names = TESTS.get(number), ", ".join(f"`{name}`" for name in scenarios[:SHOWN])
    by = names or f"test `{test[0]}`"
    ticks = measured.get(number, [])
    return f"| {number} | {by} |" + (f" {min(ticks)} to {max(ticks)} |" if ticks else "  |" if measured else "")


def table(numbers, measured):
    head = [
        "| number | shown by |" + (" measured ticks |" if measured else ""),
        "|---|---|" + ("---|" if measured else ""),
    ]
    shown = shown_by()
    return "\n".join(head + [row(number, shown.get(number, []), measured) for number in numbers]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--liana", default="build/bin/liana", help="the program that knows the numbers")
    parser.add_argument("--measured", type=pathlib.Path, help="results of ./dev hil --json")
    options = parser.parse_args()
    known = json.loads(
        subprocess.run([options.liana, "faults", "--json"], capture_output=True, text=True, check=True).stdout
    )
    print(
        table([fault["number"] for fault in known], measured_ticks(options.measured) if options.measured else {}),
        end="",
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
