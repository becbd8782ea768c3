"""What the truth says of an arm inside the slit: how far its links got, what touched, and when it was at rest."""
import math

WITHIN_S = 5.0
EVERY = 5  # slots from one look at the links to the next
REST_DEG_S = 0.1


def turned(rotation, axis, angle):
    """The rotation (rows) followed by a turn about the body's own axis (0: x, 1: y, 2: z)."""
    s, c = math.sin(angle), math.cos(angle)
    turns = ((1, 0, 0), (0, c, -s), (0, s, c)), ((c, 0, s), (0, 1, 0), (-s, 0, c)), ((c, -s, 0), (s, c, 0), (0, 0, 1))
    turn = turns[axis]
    return [[sum(row[k] * turn[k][j] for k in range(3)) for j in range(3)] for row in rotation]


def joint_centres_m(robot, theta_deg):
    """Of every joint and the tip; odd modules turn pitch first, even ones yaw first."""
    rotation, at = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0.0, 0.0, 0.0]
    if "base" in robot:  # slide and roll come first
        at[0] = robot["base"]["slide_m_per_deg"] * theta_deg[0]
        rotation, theta_deg = turned(rotation, 0, math.radians(theta_deg[1])), theta_deg[2:]
    found = [tuple(at)]
    for s, segment in enumerate(robot["segments"]):
        pitch, yaw = (math.radians(theta_deg[2 * s + i]) for i in (0, 1))
        for module in range(segment["modules"]):
            for axis, angle in ((2, pitch), (1, yaw)) if module % 2 == 0 else ((1, yaw), (2, pitch)):
                rotation = turned(rotation, axis, angle)
            at = [at[i] + segment["module_length_m"] * rotation[i][0] for i in range(3)]
            found.append(tuple(at))
    return found


def link_travel_m(truth, robot, begin, period_s):
    """Largest distance of any joint centre from where it was in the slot `begin`, within WITHIN_S."""
    start = joint_centres_m(robot, truth.theta_deg(begin))
    end = min(len(truth.rows), begin + round(WITHIN_S / period_s))
    return max(
        math.dist(a, b)
        for row in range(begin, end, EVERY)
        for a, b in zip(joint_centres_m(robot, truth.theta_deg(row)), start)
    )


def beside_way_m(robot, truth, way):
    """How far the joint centre that is farthest rests from where the nearest pose of a way, in degrees, has it."""
    rest = joint_centres_m(robot, truth.theta_deg(len(truth.rows) - 1))
    told = (joint_centres_m(robot, theta_deg) for theta_deg in way)
    return min(max(math.dist(a, b) for a, b in zip(pose, rest)) for pose in told)


class Aftermath:
    """From the slot `begin` to the end of the truth."""

    def __init__(self, truth, robot, begin, period_s):
        self.contact_N = max(truth.column("contact_force_N")[begin:])
        self.clearance_mm = 1e3 * min(truth.column("slit_clearance_m")[begin:])
        self.least_tension_N = min(truth.column("tension_min_N")[begin:])
        self.most_tension_N = max(truth.column("tension_motor_max_N")[begin:])
        self.tip_speed_m_s = max(truth.column("tip_speed_m_s")[begin:])
        self.link_mm = 1e3 * link_travel_m(truth, robot, begin, period_s)
        moving = [i for i, rate in enumerate(truth.column("fastest_deg_s")[begin:]) if rate > REST_DEG_S]
        self.rest_s = (moving[-1] + 1) * period_s if moving else 0.0
        self.depth_m = truth.column("slit_depth_m")[begin]

    def complaints(self, target):
        """What of a target (slit/targets.json) was not met."""
        found = []
        if self.contact_N > target["contact_N"]:
            found.append(f"contact of {self.contact_N:.1f} N, allowed are {target['contact_N']:g}")
        if target["link_mm"] is not None and self.link_mm > target["link_mm"]:
            found.append(f"a link got {self.link_mm:.0f} mm away, allowed are {target['link_mm']:g}")
        return found

    def note(self):
        return (
            f"at {self.depth_m:.2f} m: contact {self.contact_N:.1f} N, clearance {self.clearance_mm:.1f} mm, link"
            f" {self.link_mm:.0f} mm, tension {self.least_tension_N:.1f} to {self.most_tension_N:.0f} N, rest after"
            f" {self.rest_s:.1f} s"
        )
