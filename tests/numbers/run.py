"""Measures at full size and writes docs/measurements/figures.md: `./dev numbers [NAME]`. A section is replaced by the
newest measurement of its name; of the section fuzz single rows can be.
"""
import argparse
import importlib
import json
import pathlib
import sys
import time

from folders import ROOT
from page import Page, commit_of


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="+")
    parser.add_argument("--targets", nargs="+", default=[], help="of fuzz, these alone; the other rows stay")
    parser.add_argument("--json", action="store_true", help="also print what was measured as JSON")
    parser.add_argument("--bin", default=str(ROOT / "build/bin"), help="where the programs are")
    return parser.parse_args()


def main():
    options = arguments()
    page = Page(ROOT / "docs/measurements/figures.md")
    measured = {}
    for name in options.names:
        print(f"== numbers: {name}", file=sys.stderr, flush=True)
        start = time.monotonic()
        parts = {"only": options.targets} if name == "fuzz" else {}
        values, text = importlib.import_module(name).measure(pathlib.Path(options.bin), **parts)
        measured[name] = values
        page.put(name, text, commit_of(ROOT), time.monotonic() - start)
        page.write()
    if options.json:
        print(json.dumps(measured))


if __name__ == "__main__":
    main()
