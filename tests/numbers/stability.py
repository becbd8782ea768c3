"""Force feedback under delay: hand x wall x delay for every law, without and with the layer that keeps it passive
(stability_map.hpp), beside the prototype of docs/explanation/force-feedback.md; draws
docs/pictures/force_stability.svg.

Alone: stability.py [--bin DIR] [--count CELLS] [--json]; fewer than 192 cells draw nothing.
"""
import json
import subprocess

from folders import ROOT
from page import table

PICTURE = ROOT / "docs/pictures/force_stability.svg"
ALL = 192
LAYERS = ("none", "tank", "tank and damping")
# Cells still moving, in the prototype: other code, other small choices, judged by 3 mm from peak to peak.
PROTOTYPE = {
    ("claim", "none"): "20, -11 J",
    ("claim", "tank"): "4, -0.008 J",
    ("claim", "tank and damping"): "4, 0 J",
    ("abstract", "none"): "76, -2870 J",
    ("abstract", "tank"): "0, -0.010 J",
    ("abstract", "tank and damping"): "3, 0 J",
    ("aligned", "none"): "45, -2750 J",
    ("aligned", "tank"): "0, -0.010 J",
    ("aligned", "tank and damping"): "0, 0 J",
}
HEAD = ["law", "layer", "unstable", "still moving", "gave over 0.1 J", "least energy J", "fastest mm/s", "drift mm"]
HEAD += ["still moving by delay 0 / 0.1 / 0.5 / 1 / 2 / 4 s", "by hand 0 / 100 / 300 / 1000 N/m", "prototype"]
FELT = ["law", "layer", "in free motion, by delay 0 / 0.1 / 0.5 / 1 / 2 / 4 s (N)", "pressing (N)"]
FELT += ["removed pressing (N)", "removed withdrawing (N)"]


def measured(program, count):
    """All cells; the program's exit code 1 says that one with the layer is unstable, which the table shows."""
    call = [str(program), "--json", "--count", str(count)] + (["--svg", str(PICTURE)] if count >= ALL else [])
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    if done.returncode > 1:
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout)


def counts(cells, field, values):
    return " / ".join(str(sum(cell[field] == value for cell in cells)) for value in values)


def row(law, layer, cells):
    moving = [cell for cell in cells if cell["moving"]]
    return [
        law,
        layer,
        f"{sum(cell['moving'] or cell['active'] for cell in cells)} of {len(cells)}",
        len(moving),
        sum(cell["active"] for cell in cells),
        f"{min(cell['least_J'] for cell in cells):.3f}",
        f"{1000 * max(cell['speed_m_s'] for cell in cells):.1f}",
        f"{1000 * max(cell['drift_m'] for cell in cells):.1f}",
        counts(moving, "delay_s", (0, 0.1, 0.5, 1, 2, 4)),
        counts(moving, "hand_N_m", (0, 100, 300, 1000)),
        PROTOTYPE[law, layer],
    ]


def felt(law, layer, cells):
    """A hand of 300 N/m and 0.5 kg, free and on the stiffest wall; what the tank takes, mean and worst of all that press."""

    def shown(wall, field):
        hand = [c for c in cells if (c["hand_N_m"], c["hand_kg"], c["wall_N_m"]) == (300, 0.5, wall)]
        return " / ".join(f"{cell[field]:.1f}" for cell in hand)

    pressing = [c for c in cells if c["hand_N_m"] > 0 and c["wall_N_m"] > 0] or cells

    def of(field):
        return f"{sum(c[field] for c in pressing) / len(pressing):.2f}, {max(c[field] for c in pressing):.2f}"

    return [
        law,
        layer,
        shown(0, "drag_N"),
        shown(20000, "held_N"),
        of("taken_pressing_N"),
        of("taken_withdrawing_N"),
    ]


def measure(binaries, count=ALL):
    cells = measured(binaries / "stability", count)
    rows = [
        (law, layer, [cell for cell in cells if (cell["law"], cell["layer"]) == (law, layer)])
        for law in ("claim", "abstract", "aligned")
        for layer in LAYERS
    ]
    text = (
        "Hands of 0.5 and 2 kg, 0 to 1000 N/m; walls of 0 to 20000 N/m; delay there and back with jitter of 20 %."
        " Unstable: still faster than 2 mm/s and not slowing down 17 s to 32 s after the hand's reach, or the port gave"
        " the hand more than 0.1 J. Drift, in those 15 s, is not judged. Prototype: cells still moving, least energy.\n\n"
    )
    text += table(HEAD, [row(*of) for of in rows])
    text += "\n\nForces on a hand of 300 N/m: in free motion (mean), and pressed 50 mm into the stiffest wall. The last two columns"
    text += " have the force that the tank removed, over all hands that press (RMS; mean, worst):\n\n"
    text += table(FELT, [felt(*of) for of in rows])
    return cells, text


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
