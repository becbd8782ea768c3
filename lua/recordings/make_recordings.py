#!/usr/bin/env python3
"""Makes the hand recordings of this folder (see README.md). Deterministic, standard library only.

usage: make_recordings.py [FOLDER]      writes panel_edge_vr.hand and approach_hand.hand
"""
import math
import pathlib
import random
import sys

# Where the hands have to lead the arm: tip and node 3 at the poses `prepare` and `panel edge` (base frame, metres).
TIP_FROM = (0.646615, -1.519711, 0.020182)
TIP_TO = (0.244568, -0.271144, 0.581923)
TIP_Q_FROM = (0.63779305, 0.00987514, 0.00818045, 0.77010102)
TIP_Q_TO = (0.9437203, 0.05824929, 0.28904016, 0.14984925)
NODE3_FROM = (-0.242596, -1.662394, 0.111163)
NODE3_TO = (-0.947447, -0.395663, 1.151544)

SCALE = 4.0  # tip metres per hand metre
ROTATION_SCALE = 2.0  # tip turn per hand turn

VR_RATE_HZ = 90.0
LEAD_IN_S = 1.0  # hands still, triggers pressed after 0.6 s
MOVE_S = 34.0
HOLD_S = 2.5  # hands still at the end, then 0.5 s with the triggers released
RELEASE_S = 0.5
STROKES = 12
STROKE_OVERLAP = 2.6  # a stroke lasts this many times the spacing of strokes: speed stays nearly even
TREMOR_RMS_M = 0.0005 / math.sqrt(2.0)  # amplitude 0.5 mm
TREMOR_RMS_RAD = 0.001
DRIFT_M = 0.003  # slow wandering of the hand, amplitude
DROPOUT = (20.0, 20.15)  # right handle lost, seconds
JUMP_S = 12.0  # one sample of the right handle is 0.3 m off
JUMP_M = 0.3

HAND_RATE_HZ = 1000.0
HAND_S = 10.0
HAND_TREMOR_RMS_M = 0.0001


def minimum_jerk(s):
    s = min(max(s, 0.0), 1.0)
    return s * s * s * (10.0 + s * (6.0 * s - 15.0))


def q_multiply(a, b):
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def q_of(vector):
    angle = math.sqrt(sum(v * v for v in vector))
    if angle < 1e-12:
        return (1.0, 0.0, 0.0, 0.0)
    k = math.sin(angle / 2.0) / angle
    return (math.cos(angle / 2.0), vector[0] * k, vector[1] * k, vector[2] * k)


def rotation_vector(q):
    if q[0] < 0.0:
        q = tuple(-x for x in q)
    s = math.sqrt(q[1] ** 2 + q[2] ** 2 + q[3] ** 2)
    k = 2.0 * math.atan2(s, q[0]) / s
    return tuple(k * x for x in q[1:])


class Waves:
    """A sum of sinusoids per axis with random frequencies and phases, RMS 1."""

    def __init__(self, rng, axes, low_hz, high_hz, count=3):
        two_pi = 2.0 * math.pi
        self.waves = [
            [(two_pi * rng.uniform(low_hz, high_hz), rng.uniform(0.0, two_pi)) for _ in range(count)]
            for _ in range(axes)
        ]
        self.gain = math.sqrt(2.0 / count)

    def at(self, t):
        return [self.gain * sum(math.sin(w * t + p) for w, p in axis) for axis in self.waves]


def progress(t, spans):
    """Share of the way after t seconds: overlapping minimum-jerk strokes, spans = [(start, length, weight)]."""
    return sum(weight * minimum_jerk((t - start) / length) for start, length, weight in spans)


def strokes(rng):
    spacing = MOVE_S / (STROKES - 1 + STROKE_OVERLAP)
    weights = [1.0 + rng.uniform(-0.15, 0.15) for _ in range(STROKES)]
    total = sum(weights)
    return [(LEAD_IN_S + i * spacing, STROKE_OVERLAP * spacing, w / total) for i, w in enumerate(weights)]


def text(t_us, fields):
    return " ".join([str(t_us)] + fields)


def pose_fields(position, q):
    """Positions rounded to 0.01 mm, quaternions to 1e-6: what such a tracker resolves."""
    return [f"{x:.5f}".rstrip("0").rstrip(".") for x in position] + [f"{x:.6f}" for x in q]


class Handle:
    """One VR handle on a straight way, with tremor and drift."""

    def __init__(self, rng, rest, way, turn):
        self.rest, self.way, self.turn = rest, way, turn
        self.spans = strokes(rng)
        self.tremor = Waves(rng, 6, 8.0, 12.0)
        self.drift = Waves(rng, 3, 0.05, 0.15, 2)

    def pose(self, t):
        share = progress(t, self.spans)
        # Drift dies out at both ends: a person starts where they are and watches where they end.
        fade = math.sin(math.pi * share)
        tremor, drift = self.tremor.at(t), self.drift.at(t)
        position = [
            self.rest[i] + share * self.way[i] + TREMOR_RMS_M * tremor[i] + DRIFT_M / math.sqrt(2.0) * fade * drift[i]
            for i in range(3)
        ]
        shake = q_of([TREMOR_RMS_RAD * x for x in tremor[3:]])
        return position, q_multiply(shake, q_of([share * x for x in self.turn]))


def vr_lines():
    rng = random.Random(20220101)
    tip_turn = rotation_vector(q_multiply(TIP_Q_TO, (TIP_Q_FROM[0], -TIP_Q_FROM[1], -TIP_Q_FROM[2], -TIP_Q_FROM[3])))
    way = [(b - a) / SCALE for a, b in zip(TIP_FROM, TIP_TO)]
    node_way = [(b - a) / SCALE for a, b in zip(NODE3_FROM, NODE3_TO)]
    right = Handle(rng, (0.25, -0.25, 1.05), way, [x / ROTATION_SCALE for x in tip_turn])
    left = Handle(rng, (0.20, 0.25, 1.05), node_way, (0.0, 0.0, 0.0))
    end = LEAD_IN_S + MOVE_S + HOLD_S + RELEASE_S
    last_right = None
    for k in range(int(end * VR_RATE_HZ) + 1):
        t = k / VR_RATE_HZ
        trigger = 1 if 0.6 <= t < end - RELEASE_S else 0
        position, q = right.pose(t)
        valid = not DROPOUT[0] <= t < DROPOUT[1]
        if k == round(JUMP_S * VR_RATE_HZ):
            position[2] += JUMP_M
        if not valid:
            position, q = last_right
        last_right = (position, q)
        left_fields = ["1", str(trigger)] + pose_fields(*left.pose(t))
        yield text(round(t * 1e6), [str(int(valid)), str(trigger)] + pose_fields(position, q) + left_fields)


def hand_lines():
    """A hand controller: one stroke of 50 mm, a turn of 10 deg, re-indexing, a second stroke."""
    rng = random.Random(20220102)
    tremor = Waves(rng, 3, 8.0, 12.0)
    for k in range(int(HAND_S * HAND_RATE_HZ) + 1):
        t = k / HAND_RATE_HZ
        share = minimum_jerk((t - 1.0) / 3.0) - minimum_jerk((t - 4.8) / 0.8) + minimum_jerk((t - 6.2) / 3.0)
        gripped = 0.8 <= t < 4.6 or 5.9 <= t < 9.6
        shake = [HAND_TREMOR_RMS_M * x for x in tremor.at(t)]
        position = (-0.025 + 0.05 * share + shake[0], shake[1], 0.01 * share + shake[2])
        yield text(
            round(t * 1e6),
            ["1", str(int(gripped))] + pose_fields(position, q_of((0.0, 0.0, math.radians(10.0) * share))),
        )


def write(path, header, lines):
    path.write_text("\n".join(header + list(lines)) + "\n", encoding="ascii")
    print(f"{path.name}: {path.stat().st_size} bytes")


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent
    note = "# synthetic, made by make_recordings.py; see README.md"
    mapping = f"# made for scale {SCALE:g}, rotation_scale {ROTATION_SCALE:g}; left hand steers node 3"
    write(folder / "panel_edge_vr.hand", ["liana-hand 1 vr", note, mapping], vr_lines())
    write(folder / "approach_hand.hand", ["liana-hand 1 hand", note], hand_lines())


if __name__ == "__main__":
    main()
