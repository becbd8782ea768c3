"""Runs one measurement without the page: a table, or JSON."""
import argparse
import json
import pathlib

from folders import ROOT


def run(measure, description):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/bin", help="where the programs are")
    parser.add_argument("--count", type=int, help="cases; full size without")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    values, text = measure(options.bin, **({"count": options.count} if options.count is not None else {}))
    print(json.dumps(values) if options.json else text)
