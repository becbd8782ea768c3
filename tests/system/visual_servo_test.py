"""The small arm led by its tip camera, as users run it: in place, within the source's time, or said to be lost."""
import json
import math
import tempfile
import unittest
from pathlib import Path

from support import SystemTest
from liana.recordings import Truth
from liana.system import run, table


def product(a, b):
    """Of two quaternions."""
    w, x, y, z = a
    p, q, r, s = b
    return (
        w * p - x * q - y * r - z * s,
        w * q + x * p + y * s - z * r,
        w * r - x * s + y * p + z * q,
        w * s + x * r - y * q + z * p,
    )


def turned(quaternion, vector):
    """A vector turned by a unit quaternion."""
    w, x, y, z = quaternion
    return product(product(quaternion, (0.0, *vector)), (w, -x, -y, -z))[1:]


class VisualServo(SystemTest):
    """Flown by liana run."""

    def flown(self, *words):
        folder = Path(tempfile.mkdtemp(prefix="liana-servo-"))
        report = folder / "report.json"
        done = run("liana", "run", "servo_reach", "--robot", "micro", "--time", "fast", *words, "--json", report)
        return done, json.loads(report.read_text(encoding="utf-8"))

    # req:B16 req:B24
    def test_the_tip_ends_within_a_millimetre_of_its_place_in_the_sources_time(self):
        folder = Path(tempfile.mkdtemp(prefix="liana-servo-")) / "record"
        done, report = self.flown("--scene", "target_ahead", "--seed", "40017", "--record", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(25 <= report["steps"][-1]["duration_s"] <= 40, report["steps"])
        target = json.loads(table("scene", "target_ahead"))["rod"]
        attitude = target["quaternion_wxyz"]
        place = [p + d for p, d in zip(target["position_m"], turned(attitude, (-0.108, 0.0, 0.0)))]
        truth = Truth(folder / "truth.bin")
        last = dict(zip(truth.columns, truth.rows[-1]))
        for axis, wanted_m in zip("xyz", place):
            self.assertLess(abs(last[f"tip_{axis}_m"] - wanted_m), 0.001)
        stands, wanted = [last[f"tip_q{part}"] for part in "wxyz"], product(attitude, (0.5, 0.5, 0.5, 0.5))
        cosine = abs(sum(a * b for a, b in zip(stands, wanted)))
        self.assertLess(math.degrees(2 * math.acos(min(1.0, cosine))), 0.5)

    def test_a_target_that_is_not_there_is_lost_and_the_arm_holds(self):
        done, report = self.flown("--scene", "none", "--seed", "40018")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("target lost", report["reason"])
        self.assertIn("it is not seen", report["reason"])


if __name__ == "__main__":
    unittest.main()
