"""The chain of modules that stands for an elastic backbone, beside the rod that a backbone is: the published arm of
`tdcr_benchmark` at rest under given tensions, weight and a force at its tip. Prints how far apart the tips are.
"""
import json
import math
import pathlib
import sys
import tempfile
import unittest

from programs import liana, liana_json
from rod import Rod, cross, dot, plus, solve

DOWN = [0, 0, -9.80665]
# Tensions of the six cables, gravity in the base frame, a force on the rod's tip, and what is allowed in the columns of
# the table [% of length]: what was found, and a third more.
CASES = {
    "segment 1 pulls": ([4, 0, 0, 0, 0, 0], [0, 0, 0], [0, 0, 0], [1.1, 1.1, 1.1]),
    "both pull in one plane": ([2, 0, 0, 1, 0, 0], [0, 0, 0], [0, 0, 0], [0.6, 0.6, 0.6]),
    "both pull, out of plane": ([4, 0, 0, 0, 2, 0], [0, 0, 0], [0, 0, 0], [1.4, 1.4, 1.4]),
    "out of plane, pushed": ([4, 0, 0, 0, 2, 0], [0, 0, 0], [0, 0.05, 0], [6.3, 2.3, 1.6]),
    "nothing pulls, lying": ([0, 0, 0, 0, 0, 0], DOWN, [0, 0, 0], [0.83, 0.83, 0.1]),
    "both pull, lying": ([4, 0, 0, 0, 2, 0], DOWN, [0, 0, 0], [2.6, 2.0, 1.5]),
    "out of plane, pushed, lying": ([4, 0, 0, 0, 2, 0], DOWN, [0, 0.05, 0], [5.8, 2.9, 1.7]),
}
SPLIT = 2  # parts of each segment, which bend by themselves, in the finer chain
STIFF = 1e3  # torsion of a rod that does not twist, beside its bending


class Chain:
    """The shipped arm as `liana pose` knows it: each segment cut into `parts` ones, of which only the last has the
    segment's cables; those of the others are slack.
    """

    def __init__(self, folder, parts):
        self.source = json.loads(liana("robot", "export", "tdcr_benchmark")[1])
        table = json.loads(json.dumps(self.source))
        self.module_m = table["segments"][0]["module_length_m"]
        self.parts, self.segments = parts, len(table["segments"])
        cables = table["cables"]
        table["segments"] = [
            {**segment, "modules": segment["modules"] // parts} for segment in table["segments"] for _ in range(parts)
        ]
        for name in ("hole_radius_m", "phase_deg"):
            cables[name] = [value for value in cables[name] for _ in range(parts)]
        drives = table["drives"]
        for name in ("direction", "zero_counts"):
            drives[name] = drives[name] * parts
        table["named_poses_deg"] = {"zero": [0] * (2 * len(table["segments"]))}
        del table["start_pose"], table["jig_poses"]
        self.table, self.file = table, folder / f"parts_{parts}.json"

    def pose(self, theta_rad):
        angles = ",".join(repr(math.degrees(x)) for x in theta_rad)
        return liana_json("pose", "--robot", self.file, f"--theta-deg={angles}")

    def end(self, pose):
        """The rod's end, half a module before the tip, as half a module lies before the first joint."""
        return [row[3] - 0.5 * self.module_m * row[0] for row in pose["tip_pose"][:3]]

    def torque(self, pose, tension_N, force_N):
        """What is left over about each angle: the arm is at rest where it is zero."""
        arm = plus(self.end(pose), [row[3] for row in pose["tip_pose"][:3]], -1.0)
        out = []
        for k, load_Nm in enumerate(pose["static_load_Nm"]):
            linear, angular = ([row[k] for row in pose["jacobian"][3 * i : 3 * i + 3]] for i in range(2))
            moved = plus(linear, cross(angular, arm))
            pulled = sum(row[k] * t for row, t in zip(pose["cable_jacobian_m_rad"], tension_N))
            out.append(load_Nm + pulled - dot(moved, force_N))
        return out

    def rest(self, tension_N, gravity_m_s2, force_N):
        """The rod's end where the chain is at rest, in the frame of the rod's clamp."""
        self.table["gravity_m_s2"] = gravity_m_s2
        self.file.write_text(json.dumps(self.table))
        of_segment = [tension_N[3 * m : 3 * m + 3] for m in range(self.segments)]
        pulled = [
            t
            for of_N in of_segment
            for part in range(self.parts)
            for t in (of_N if part + 1 == self.parts else [0] * 3)
        ]
        theta_rad = [0.0] * (2 * self.segments * self.parts)
        for _ in range(12):
            left = self.torque(self.pose(theta_rad), pulled, force_N)
            if max(map(abs, left)) < 1e-9:
                break
            columns = []
            for k in range(len(theta_rad)):
                other = self.pose([x + 1e-6 * (i == k) for i, x in enumerate(theta_rad)])
                columns.append([(x - y) / 1e-6 for x, y in zip(self.torque(other, pulled, force_N), left)])
            change = solve([list(row) for row in zip(*columns)], left)
            theta_rad = plus(theta_rad, change, -min(1.0, 0.1 / max(map(abs, change))))
        assert max(map(abs, left)) < 1e-9, f"the chain does not come to rest: {left}"
        return plus(self.end(self.pose(theta_rad)), [0.5 * self.module_m, 0.0, 0.0])


def rod_of(table, **options):
    """The rod that the table of `tdcr_benchmark` stands for, by what its source says of the arm."""
    thick_m, spacing_m, cables = 0.001, 0.01, table["cables"]
    holes = [
        [(r * math.cos(math.radians(phase)), r * math.sin(math.radians(phase))) for phase in phases]
        for r, phases in zip(cables["hole_radius_m"], cables["phase_deg"])
    ]
    bending_Nm2 = 60e9 * math.pi / 4 * (thick_m / 2) ** 4
    return Rod(10 * spacing_m, holes, bending_Nm2, 0.0115 * (thick_m / 0.0014) ** 2, 0.0002, **options)


class RodByTheBooks(unittest.TestCase):
    """The rod of these tests beside closed solutions."""

    LENGTH_M, BENDING_NM2 = 0.2, 0.003

    def rod(self, kg_per_m=0.0):
        return Rod(self.LENGTH_M / 2, [[(0.0, 0.008)], [(0.0, 0.006)]], self.BENDING_NM2, kg_per_m)

    def assert_near(self, point, expected, share=1e-6):
        self.assertLess(math.dist(point, expected), share * self.LENGTH_M, (point, expected))

    def test_a_moment_at_its_end_or_a_tendon_bends_it_into_an_arc(self):
        for curvature in (1.0, 10.0):
            arc = [math.sin(curvature * 0.2) / curvature, 0.0, (1 - math.cos(curvature * 0.2)) / curvature]
            turned = [0.0, -curvature * self.BENDING_NM2, 0.0]
            self.assert_near(self.rod().shape([[0], [0]], moment_Nm=turned), arc)
            tendon_N = curvature * self.BENDING_NM2 / 0.006
            self.assert_near(self.rod().shape([[0], [tendon_N]]), arc)

    def test_a_small_weight_or_force_bends_it_as_a_beam(self):
        for load_N, deflection in ((1e-3, 1 / 3), (1e-3, 1 / 8)):
            force_N, kg_per_m = ([0, load_N, 0], 0.0) if deflection > 0.2 else ([0, 0, 0], load_N / self.LENGTH_M)
            tip = self.rod(kg_per_m).shape([[0], [0]], [0, 1.0, 0], force_N)
            beam_m = deflection * load_N * self.LENGTH_M**3 / self.BENDING_NM2
            self.assertAlmostEqual(tip[1] / beam_m, 1.0, delta=1e-3)

    def test_a_large_force_bends_it_as_the_elastica(self):
        """K. Mattiasson, International Journal for Numerical Methods in Engineering 17, 1981: a cantilever's end."""
        for load, across, along in ((1, 0.30172, 0.05643), (10, 0.81061, 0.55500)):
            tip = self.rod().shape([[0], [0]], force_N=[0, 0, load * self.BENDING_NM2 / self.LENGTH_M**2])
            self.assert_near(tip, [self.LENGTH_M * (1 - along), 0.0, self.LENGTH_M * across], 1e-5)

    def test_turned_about_its_axis_with_all_that_loads_it_it_has_the_same_shape(self):
        c, s = math.cos(1.0), math.sin(1.0)

        def turned(v):
            return [v[0], c * v[1] - s * v[2], s * v[1] + c * v[2]]

        tips = []
        for turn in (list, turned):
            holes = [[tuple(turn([0, y, z])[1:]) for y, z in ((0.008, 0.0), (0.0, 0.008))]] * 2
            rod = Rod(self.LENGTH_M / 2, holes, self.BENDING_NM2, 0.03)
            tips.append(rod.shape([[3, 0], [0, 2]], turn([0, 0, -9.8]), turn([0.01, 0.02, 0.03])))
        self.assert_near(tips[1], turned(tips[0]))


class ChainBesideRod(unittest.TestCase):
    def test_the_tips_are_as_far_apart_as_the_page_says(self):
        folder = tempfile.TemporaryDirectory(prefix="liana-test-")
        self.addCleanup(folder.cleanup)
        whole, split = (Chain(pathlib.Path(folder.name), parts) for parts in (1, SPLIT))
        rod, straight = rod_of(whole.source), rod_of(whole.source, torsion=STIFF)
        print(
            "\n| load | tip of the rod, mm | chain | rod without twist | and segments halved |\n|---|---|---|---|---|"
        )
        for case, (tension_N, gravity_m_s2, force_N, allowed) in CASES.items():
            loads = [tension_N[:3], tension_N[3:]], gravity_m_s2, force_N
            tip, untwisted = (each.shape(*loads) for each in (rod, straight))
            one, two = (chain.rest(tension_N, gravity_m_s2, force_N) for chain in (whole, split))
            apart = [100 * math.dist(a, b) / rod.length_m for a, b in ((one, tip), (one, untwisted), (two, untwisted))]
            place = ", ".join(f"{1e3 * x:.1f}" for x in tip)
            print(f"| {case} | {place} | " + " | ".join(f"{x:.2f} %" for x in apart) + " |", flush=True)
            for column, (found, most) in enumerate(zip(apart, allowed)):
                self.assertLess(found, most, f"{case}, column {column + 1}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
