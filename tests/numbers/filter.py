"""From hand to tip: what the operator filter makes of a hand, beside a 1-Euro filter and a low-pass of second order that
are as late at 30 mm/s, and how the true tip comes after a hand (closed loop of core and arm), with the limits of the
table and with those it had before (0.14 m/s2, 1 m/s3, lag speed / acceleration).

Alone: filter.py [--bin DIR] [--count SEEDS] [--json].
"""
from asking import counted
from page import table

HEAD = ["filter", "lag ms at 30, 100 mm/s", "dB at 8 / 10 / 12 Hz", "most dB in 8-12 Hz", "most dB under 7 Hz"]
HEAD += ["reach of 60 mm in 2 s: past its end mm", "sway of a 0.6 Hz mode mm", "left of 0.5 mm RMS tremor, um"]
LED = ["limits", "hand", "lag of the true tip ms", "sway mm", "past the end mm", "least tension N", "faults"]
BESIDE = (
    "Each filter of Liana is followed by two others with the same lag at 30 mm/s, at 250 Hz. Gains are for 1 mm of tremor."
    " The last column has tremor of 0.5 mm RMS and 8 to 12 Hz, sampled at 90 Hz and averaged over command intervals."
)
LED_BY_A_HAND = (
    "How the true tip follows a hand. A sample takes 50 ms from the hand until its goal is in force. The lag is that of an"
    " arm as the table describes it, without friction. The other columns are with friction, the worst of the seeds. Sway is"
    " the distance from the commanded to the true tip."
)


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
    text = BESIDE + "\n\n"
    text += table(HEAD, [row(found) for found in values["filters"]])
    text += f"\n\n{LED_BY_A_HAND}\n\n"
    text += table(LED, [led_row(found) for found in values["led"]])
    return values, text


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
