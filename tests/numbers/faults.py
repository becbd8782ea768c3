"""The campaign: random sequences of faults and operator's actions in lockstep, every tick judged by the safety rules
(hil/scenarios/recorded_rules.py).
"""
import os

import folders  # noqa: F401
import campaign
from page import table

FIRST_SEED = 41001  # after every change of what it judges: seeds that nobody has looked at


def listed(counts, kind):
    """ "name count" of every counter of a kind, most first."""
    found = {name.removeprefix(kind): count for name, count in counts.items() if name.startswith(kind)}
    return ", ".join(f"{name} {count}" for name, count in sorted(found.items(), key=lambda item: (-item[1], item[0])))


def rows(counts, failed):
    begun = sum(count for name, count in counts.items() if name.startswith("begun: "))
    return [
        ["sequences", counts["sequences"]],
        ["sequences that broke a rule", len(failed)],
        ["sequences that failed once and not again (the machine stalled)", counts["failed once, not again"]],
        ["ticks judged", counts["ticks"]],
        ["faults begun", f"{begun}: {listed(counts, 'begun: ')}"],
        ["sequences in which a fault was latched", listed(counts, "latched: ")],
        ["times the arm was enabled", counts["enabled"]],
        ["operator's requests, refused of them", f"{counts['requests']}, {counts['refused requests']}"],
        ["recordings replayed, all the same bit for bit" if not failed else "recordings replayed", counts["replayed"]],
    ]


def measure(binaries, count=500):
    os.environ["LIANA_BIN"] = str(binaries)
    counts, failed = campaign.campaign(range(FIRST_SEED, FIRST_SEED + count))
    text = f"Seeds {FIRST_SEED} to {FIRST_SEED + count - 1}.\n\n" + table(["what", "measured"], rows(counts, failed))
    for seed, why in failed.items():
        text += f"\n\nSeed {seed}: {why}"
    return {"counts": counts, "failed": failed}, text


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
