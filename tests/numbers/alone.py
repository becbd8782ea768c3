"""Runs one measurement without the page: a table, or JSON."""
import argparse
import json
import pathlib

from folders import ROOT


def run(measure, description, **more):
    """`more`: further options, by the parameters of `measure` that they set, and what argparse is told of them."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/bin", help="where the programs are")
    parser.add_argument("--count", type=int, help="cases; full size without")
    for name, told in more.items():
        parser.add_argument(f"--{name}", **told)
    parser.add_argument("--json", action="store_true")
    options = vars(parser.parse_args())
    given = {name: options[name] for name in ("count", *more) if options[name] is not None}
    values, text = measure(options["bin"], **given)
    print(json.dumps(values) if options["json"] else text)
