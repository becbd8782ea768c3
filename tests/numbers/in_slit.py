"""Faults and kills inside the slit at seeded moments, judged by the truth (hil/scenarios/slit.py, slit_kills.py)."""
import concurrent.futures
import os
import sys

import folders  # noqa: F401
import slit
import slit_kills
from page import table

SEED = 424242  # of the draw; no other program uses it
FIGURES = ("contact_N", "clearance_mm", "link_mm", "rest_s")


def rows_of(wanted):
    """What came of each, one after the other on standard error."""
    found = []
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        for row in pool.map(slit.row_of, wanted):
            print(f"   {row['name']}: {row['why'] or 'as targeted'}", file=sys.stderr, flush=True)
            found.append(row)
    return found


def spread(rows, name):
    """Least, median and most of a figure."""
    values = sorted(row[name] for row in rows if name in row)
    return f"{values[0]:.1f} / {values[len(values) // 2]:.1f} / {values[-1]:.1f}" if values else "-"


def lines(groups, figures):
    return [
        [name, f"{sum(not row['why'] for row in rows)} of {len(rows)}", *(spread(rows, figure) for figure in figures)]
        for name, rows in groups.items()
    ]


def failures(rows):
    lines_of = [f"- {row['name']}: {row['why']}" for row in rows if row["why"]]
    return "\n".join(["", "Outside its targets (figures are rounded):", "", *lines_of]) if lines_of else ""


def measure(binaries, count=20):
    os.environ["LIANA_BIN"] = str(binaries)
    wanted = {kind: list(slit.draw(kind, count, SEED)) for kind in slit.FAULTS}
    faults = rows_of([one for ones in wanted.values() for one in ones])
    by_kind = {kind: [faults.pop(0) for _ in ones] for kind, ones in wanted.items()}
    strikes = [slit_kills.Kill(i, one, False) for i, one in enumerate(slit_kills.draw(10 * count, SEED))]
    kills = rows_of(strikes)
    by_victim = {}
    for kill, row in zip(strikes, kills):
        by_victim.setdefault(kill.strike.victim, []).append(row)
    everything = [row for rows in by_kind.values() for row in rows] + kills
    head = ["within its targets", "contact N", "clearance mm", "link mm", "rest s"]
    text = "Least / median / most; targets are in `hil/scenarios/slit/targets.json`.\n\n"
    text += table(["fault", *head], lines(by_kind, FIGURES))
    text += "\n\n" + table(["killed", *head, "off its path mm"], lines(by_victim, (*FIGURES, "tube_mm")))
    return {"faults": by_kind, "kills": by_victim}, text + "\n" + failures(everything)


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
