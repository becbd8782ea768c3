"""Arms as a lab might build them, drawn by seed within what the loader allows: 2 to 8 segments, 3 or 4 cables each, every
segment with its own modules and limit. Their kinematics is written once more here, and a mission is given for all.
"""
import math
import random

MOST_DRIVES = 32
MOST_BEND_DEG = 170.0  # of a segment in one plane
LEAST_RADIUS_M = 0.016  # the holes of 32 cables have to fit side by side
LEAST_MODULE_KG = 0.001
DENSITY_KG_M3 = 1000.0  # a hollow aluminium module, filled up to its bounding cylinder

TOUR = """
local liana = require "liana"
local function pose(name)
  return liana.step(name) {
    device = "none", run = liana.move_to(name), exit = liana.all { liana.at_pose(name, 0.5), liana.at_rest() },
    time_limit_s = 600, on_fail = "hold",
  }
end
return liana.mission "tour" { pose "first", pose "second" }
"""


def angles_of(table, draw):
    """Angles within the limits of every segment, deg."""
    return [draw.uniform(-1, 1) * segment["theta_limit_deg"] for segment in table["segments"] for _ in range(2)]


def table_of(seed):
    """A robot as a lab might build it: everything is drawn, within what the loader allows."""
    draw = random.Random(seed)
    count = draw.randint(2, 8)
    cables = [draw.choice((3, 4)) for _ in range(count)]
    while sum(cables) > MOST_DRIVES:
        cables[cables.index(4)] = 3
    step = 360.0 / (12 * count)
    limit = draw.uniform(5, 25)
    length_m = math.exp(draw.uniform(math.log(0.03), math.log(0.2)))
    segments = []
    for _ in range(count):
        modules = draw.randint(2, 10)
        limit_deg = min(limit * draw.uniform(0.8, 1.2), MOST_BEND_DEG / modules)
        segments.append(
            {
                "modules": modules,
                "module_length_m": round(length_m * draw.uniform(0.8, 1.2), 4),
                "theta_limit_deg": round(limit_deg, 1),
            }
        )
    radius = max(length_m * draw.uniform(0.25, 0.45), LEAST_RADIUS_M)
    mass_kg = DENSITY_KG_M3 * length_m * radius**2 * draw.uniform(0.5, 1.5)
    offset_m = length_m * draw.uniform(0.05, 0.12)

    def pose():
        return [round(0.3 * angle, 2) for angle in angles_of({"segments": segments}, draw)]

    return {
        "format": 1,
        "kind": "robot",
        "name": f"made_up_{seed}",
        "segments": segments,
        "module": {"mass_kg": mass_kg, "radius_m": radius},
        "joint": {"viscous_Nms_per_rad": 0.4},
        "cables": {
            "hole_radius_m": [0.8 * radius * (1 - 0.2 * j / count) for j in range(count)],
            "face_offset_m": [offset_m * (1 + 0.3 * j / count) for j in range(count)],
            "phase_deg": [[360.0 / n * c + step * j for c in range(n)] for j, n in enumerate(cables)],
            "EA_N": 200000,
            "lead_m": 0.4,
            "friction_mu": {"nominal": 0.04, "ideal": 0, "worn": 0.08},
        },
        "tension": {
            "plan_N": 40,
            "floor_motor_N": 15,
            "floor_anywhere_N": 1,
            "ceiling_free_N": 180,
            "alarm_N": 400,
            "hard_limit_N": 600,
        },
        "drives": {
            "drum_radius_m": 0.015,
            "counts_per_turn": 65536,
            "gear": 1,
            "servo_time_constant_s": 0.03,
            "rated_torque_Nm": 9,
            "identity": {"vendor": 19529, "product": 1, "revision": 1},
            "direction": [draw.choice((-1, 1)) for _ in range(sum(cables))],
            "zero_counts": [1000000] * sum(cables),
        },
        "limits": {
            "theta_rate_deg_s": 2,
            "theta_accel_deg_s2": 4,
            "tip_speed_m_s": 0.1,
            "tip_speed_slit_m_s": 0.03,
            "tip_accel_m_s2": 0.14,
            "tip_jerk_m_s3": 1,
            "tip_rate_deg_s": 20,
            "tip_angular_accel_deg_s2": 40,
            "tip_angular_jerk_deg_s3": 400,
            "cable_speed_m_s": 0.01,
        },
        "named_poses_deg": {"zero": [0] * (2 * count), "first": pose(), "second": pose()},
        "start_pose": "first",
    }


def loaded(table, seed, fits):
    """The same arm with weight: mounted in any direction, with a tool, and masses up to what `fits` says it can hold."""
    draw = random.Random(f"load {seed}")
    towards = [draw.gauss(0, 1) for _ in range(3)]
    size = math.sqrt(sum(x * x for x in towards))
    length_m = sum(segment["modules"] * segment["module_length_m"] for segment in table["segments"])
    own_kg, tool_share = table["module"]["mass_kg"], draw.uniform(0, 0.2)
    modules = sum(segment["modules"] for segment in table["segments"])
    center = draw.uniform(0.3, 0.7)

    def heavy(share):
        return {
            **table,
            "gravity_m_s2": [9.80665 * x / size for x in towards],
            "module": {**table["module"], "mass_kg": max(LEAST_MODULE_KG, share * own_kg), "center": center},
            "tool": {"mass_kg": share * tool_share * modules * own_kg, "center_m": [0.02 * length_m, 0, 0]},
        }

    low, high = math.log(1e-3), math.log(10.0)
    for _ in range(7):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if fits(heavy(math.exp(middle))) else (low, middle)
    return heavy(draw.uniform(0.5, 1.0) * math.exp(low))


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def turn(axis, angle_deg):
    c, s = math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))
    if axis == "y":
        return [[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]]
    return [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def tip_of(table, theta_deg):
    """The tip, one universal joint after the other (docs/reference/formats.md): the least that an arm is, written once
    more.
    """
    pose = [[float(i == j) for j in range(4)] for i in range(4)]
    for j, segment in enumerate(table["segments"]):
        pitch, yaw = turn("z", theta_deg[2 * j]), turn("y", theta_deg[2 * j + 1])
        along = [[1, 0, 0, segment["module_length_m"]], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
        for k in range(segment["modules"]):
            pose = product(pose, product(pitch, yaw) if k % 2 == 0 else product(yaw, pitch))
            pose = product(pose, along)
    return pose
