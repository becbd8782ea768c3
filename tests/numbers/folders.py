"""Folders of the tree; importing it makes what measurements use from them importable."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BENCH = ROOT / "tests" / "benchmarks"
sys.path[:0] = [
    str(ROOT / folder)
    for folder in (
        "host/api/python",
        "hil/scenarios",
        "tests/benchmarks",
        "tests/mutation",
        "tests/fuzz",
        "tests/structure",
    )
]
