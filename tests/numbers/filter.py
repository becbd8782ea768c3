"""From hand to tip: what the operator filter makes of a hand, beside a 1-Euro filter and a low-pass of second order that
are as late at 30 mm/s, and how the true tip comes after a hand (closed loop of core and arm), with the limits of the
table and with those it had before (0.14 m/s2, 1 m/s3, lag speed / acceleration).

Alone: filter.py [--bin DIR] [--count SEEDS] [--json].
"""
from asking import counted
from page import table

HEAD = ["filter", "lag ms at 30, 100 mm/s", "dB at 8 / 10 / 12 Hz", "most dB in 8-12 Hz", "most dB under 7 Hz"]
HEAD += ["reach of 60 mm in 2 s: past its end mm", "swing of a 0.6 Hz mode mm", "left of 0.5 mm RMS tremor, um"]
LED = ["limits", "hand", "lag of the true tip ms", "swing mm", "past the end mm", "least tension N", "faults"]


def row(found):
    return [
        found["name"],
        f"{1e3 * found['lag_30_s']:.0f}, {1e3 * found['lag_100_s']:.0f}",
        f"{found['dB_8']:.0f} / {found['dB_10']:.0f} / {found['dB_12']:.0f}",
        f"{found['dB_band']:.1f}",
        f"{found['dB_below_7']:.2f}",
        f"{found['over_mm']:.2f}",
        f"{found['swing_mm']:.1f}",
        f"{1e3 * found['tremor_left_mm']:.1f}",
    ]


def led_row(found):
    steady = found["lag_s"] > 0
    return [
        found["limits"],
        found["what"],
        f"{1e3 * found['lag_s']:.0f}" if steady else "-",
        f"{found['swing_mm']:.1f}",
        "-" if steady else f"{found['over_mm']:.1f}",
        f"{found['least_N']:.1f}",
        found["faults"],
    ]


def measure(binaries, count=3):
    values = counted(binaries / "filter", count)
    text = (
        "Every filter of ours is followed by the two that are as late; at 250 Hz, 1 mm of tremor for the gains. Tremor of"
        " 0.5 mm RMS: 8 to 12 Hz, sampled at 90 Hz and averaged over command intervals as a device's samples are.\n\n"
    )
    text += table(HEAD, [row(found) for found in values["filters"]])
    text += "\n\nThe true tip after a hand, its samples 50 ms on their way to a goal in force (lag of an arm as the table says, without friction; the rest with friction, the worst of the seeds); swing: away from where it is commanded:\n\n"
    text += table(LED, [led_row(found) for found in values["led"]])
    return values, text


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
