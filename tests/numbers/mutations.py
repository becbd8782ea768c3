"""Planted bugs in detectors, watchdogs, supervisor and gate, one after the other: which scenario notices
(tests/mutation).
"""
import pathlib

from folders import ROOT
import mutation
from page import table


def measure(binaries, count=None):
    wanted = mutation.mutations()[:count]
    outcomes = mutation.run(wanted, binaries, ROOT / "build" / "mutation")
    caught = sum(killer is not None for killer, _ in outcomes.values())
    rows = [
        [one.name, f"`{pathlib.Path(one.edits[0].file).name}`", outcomes[one.name][0] or "**nothing**"]
        for one in wanted
    ]
    return outcomes, f"{caught} of {len(wanted)} planted bugs are noticed.\n\n" + table(
        ["planted bug", "in", "noticed by"], rows
    )


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
