"""Where this tree is. Importing it makes the tree's Python client importable (docs/getting-started/python.md): programs
do it first.
"""
import pathlib
import sys

SCENARIOS = pathlib.Path(__file__).resolve().parent
SOURCE = SCENARIOS.parents[1]
sys.path.insert(0, str(SOURCE / "host" / "api" / "python"))
