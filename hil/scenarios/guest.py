"""Runs on the machine that has CAN, often a guest (hil/vm): scenarios, or latency measurements.

    python3 guest.py RESULTS WORD...

A WORD is SCENARIO@KIND or RATE:LOAD, with RATE 250 or 500 and LOAD idle, loaded or console; one JSON row each in RESULTS.
"""
import json
import sys

import source_tree  # noqa: F401
from can import can_scenario, latency


def rows(words):
    """Of scenarios in bring-up order, of measurements in the order in which they are asked for."""
    yield from can_scenario.rows([word for word in words if "@" in word])
    yield from latency.rows([word for word in words if "@" not in word])


def main():
    with open(sys.argv[1], "w", encoding="utf-8") as results:
        for row in rows(sys.argv[2:]):
            results.write(json.dumps(row) + "\n")
            results.flush()


if __name__ == "__main__":
    main()
