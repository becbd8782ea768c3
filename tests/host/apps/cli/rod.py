"""An elastic rod bent by tendons, its weight and a force at its tip, solved by shooting: what the backbone of a
continuum arm does, without anything of Liana's.

Model: D. C. Rucker, R. J. Webster, "Statics and dynamics of continuum robots with general tendon routing and external
loading", IEEE Transactions on Robotics 27, 2011, as a Kirchhoff rod (neither stretched nor sheared). It is written for
rod and tendons together: what a cut carries in all is what acts beyond it, wherever tendons end. Tendons run without
friction, parallel to the rod. x is along the straight rod, which is clamped at the origin.
"""
import math

DISCS = 10  # of a segment
STEPS = 3 * DISCS  # of a segment
STEP = 1e-6  # of the moment at the clamp, of what bends the rod by 1 rad, for differences
CLOSE = 1e-9  # of the same: where shooting ends


def plus(a, b, factor=1.0):
    return [x + factor * y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def solve(rows, right):
    """Linear equations by elimination with pivots."""
    rows = [list(row) + [value] for row, value in zip(rows, right)]
    count = len(rows)
    for k in range(count):
        pivot = max(range(k, count), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, count):
            rows[i] = plus(rows[i], rows[k], -rows[i][k] / rows[k][k])
    out = [0.0] * count
    for k in reversed(range(count)):
        out[k] = (rows[k][count] - dot(rows[k][k + 1 : count], out[k + 1 :])) / rows[k][k]
    return out


class Rod:
    """Segments of equal lengths one behind the other. `tendons`: of each segment the holes (y, z) of the tendons that
    end with it. Bending stiffness is about y and z, torsion `torsion` times as stiff: a round rod with Poisson's ratio
    0.3, if it is not told. Discs stand DISCS to a segment, the last one at its end.
    """

    def __init__(self, segment_m, tendons, bending_Nm2, kg_per_m=0.0, disc_kg=0.0, torsion=1 / 1.3):
        self.segment_m, self.tendons, self.kg_per_m, self.disc_kg = segment_m, tendons, kg_per_m, disc_kg
        self.stiffness = [torsion * bending_Nm2, bending_Nm2, bending_Nm2]
        self.length_m = segment_m * len(tendons)

    def curvature(self, moment, pulls, start):
        """Of the rod where rod and tendons together carry `moment`, all in the frame of the cross section."""
        u = start
        for _ in range(50):
            rest = [k * x - m for k, x, m in zip(self.stiffness, u, moment)]
            slope = [[self.stiffness[i] if i == j else 0.0 for j in range(3)] for i in range(3)]
            for tension_N, hole in pulls:
                along = plus([1.0, 0.0, 0.0], cross(u, hole))
                length = math.sqrt(dot(along, along))
                along = [x / length for x in along]
                rest = plus(rest, cross(hole, along), tension_N)
                for j in range(3):
                    turn = cross([float(i == j) for i in range(3)], hole)
                    turn = plus(turn, along, -dot(turn, along))
                    for i, x in enumerate(cross(hole, turn)):
                        slope[i][j] += tension_N * x / length
            change = solve(slope, rest)
            u = plus(u, change, -1.0)
            if max(map(abs, change)) < 1e-11 / self.length_m:
                return u
        raise ArithmeticError("the rod's curvature does not converge")

    def integrate(self, moment_Nm, tensions_N, gravity_m_s2, force_N):
        """Place and moment at the tip of the rod that carries `moment_Nm`, with its tendons, at the clamp."""
        place, axes, moment = [0.0] * 3, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], list(moment_Nm)
        u, step_m = [0.0] * 3, self.segment_m / STEPS

        def rates(s_m, state):
            nonlocal u
            x, y, z, m = state[3:6], state[6:9], state[9:12], state[12:]
            u = self.curvature([dot(m, axis) for axis in (x, y, z)], pulls, u)
            beyond_kg = self.kg_per_m * (self.length_m - s_m) + self.disc_kg * discs
            beyond_N = plus(force_N, gravity_m_s2, beyond_kg)
            turned = plus([u[2] * v for v in y], z, -u[1]), plus([u[0] * v for v in z], x, -u[2])
            return x + turned[0] + turned[1] + plus([u[1] * v for v in x], y, -u[0]) + cross(beyond_N, x)

        for segment in range(len(self.tendons)):
            pulls = [
                (tension_N, [0.0, *hole])
                for of_N, holes in list(zip(tensions_N, self.tendons))[segment:]
                for tension_N, hole in zip(of_N, holes)
                if tension_N
            ]
            for i in range(STEPS):
                discs = DISCS * len(self.tendons) - (segment * STEPS + i) * DISCS // STEPS
                s_m, state = segment * self.segment_m + i * step_m, place + axes[0] + axes[1] + axes[2] + moment
                a = rates(s_m, state)
                b = rates(s_m + step_m / 2, plus(state, a, step_m / 2))
                c = rates(s_m + step_m / 2, plus(state, b, step_m / 2))
                d = rates(s_m + step_m, plus(state, c, step_m))
                mean = [(p + 2 * q + 2 * r + t) / 6 for p, q, r, t in zip(a, b, c, d)]
                state = plus(state, mean, step_m)
                place, axes, moment = state[:3], [state[3:6], state[6:9], state[9:12]], state[12:]
        return place, moment

    def shape(self, tensions_N, gravity_m_s2=(0, 0, 0), force_N=(0, 0, 0), moment_Nm=(0, 0, 0)):
        """Where the rod's tip is at rest under these tensions (a list for each segment) and a force and a moment on it,
        in the frame of the clamp. Loads are taken on in steps.
        """
        at_clamp, unit = [0.0] * 3, self.stiffness[1] / self.length_m
        for share in (0.25, 0.5, 0.75, 1.0):
            pulled = [[share * tension_N for tension_N in of_N] for of_N in tensions_N]
            force = [share * x for x in force_N]
            gravity = [share * x for x in gravity_m_s2]
            wanted = [share * x for x in moment_Nm]
            for _ in range(30):
                place, moment = self.integrate(at_clamp, pulled, gravity, force)
                miss = plus(moment, wanted, -1.0)
                if max(map(abs, miss)) < CLOSE * unit:
                    break
                columns = []
                for k in range(3):
                    other = plus(at_clamp, [STEP * unit * (i == k) for i in range(3)])
                    moved = self.integrate(other, pulled, gravity, force)[1]
                    columns.append([(x - y) / (STEP * unit) for x, y in zip(moved, moment)])
                at_clamp = plus(at_clamp, solve([list(row) for row in zip(*columns)], miss), -1.0)
            else:
                raise ArithmeticError(f"shooting misses the tip's moment by {miss} N m")
        return place
