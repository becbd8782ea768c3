"""Small bugs that rules make in the rooms where a bug moves an arm, drawn by a seed: how many of them the unit tests notice
(tests/mutation/plant.py).
"""
from folders import ROOT
import plant
from page import table

ROOMS = """firmware_like host/control/arbiter host/control/realtime host/control/server host/control/verification
host/drives/canopen host/storage/recording""".split()
COUNT = 300


def measure(_, count=COUNT):
    outcomes = plant.run(plant.sources_of(ROOMS), count)
    noticed = sum(what == "noticed" for _, what in outcomes)
    kinds = [[kind, planted, found] for kind, (planted, found) in plant.summary(outcomes).items()]
    survivors = [
        [f"`{mutant.file}` {mutant.line}", mutant.kind, f"`{mutant.was}`", f"`{mutant.becomes or ' '}`", what]
        for mutant, what in outcomes
        if what != "noticed"
    ]
    return {"planted": len(outcomes), "noticed": noticed}, (
        f"{noticed} of {len(outcomes)} bugs that a seed drew in {', '.join(ROOMS)} are noticed by unit tests.\n\n"
        + table(["kind", "planted", "noticed"], kinds)
        + "\n\nNot noticed, the equivalent ones among them:\n\n"
        + table(["where", "kind", "was", "becomes", "why"], survivors)
    )


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
