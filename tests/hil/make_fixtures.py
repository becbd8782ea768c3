"""Writes the robot, scene and bus fixtures of the bench tests; the slit comes from the press-rod angles. Usage:
make_fixtures.py DIR
"""
import json
import math
import pathlib
import sys

POSES = {
    "zero": [0] * 10,
    "prepare": [-8.5, 0, -12, 0, 8, -2, 13, 0, 12, -2],
    "panel_edge": [-6.14, -15, -3.29, -8.72, 7.2, 15, 5.55, 15, 1, -2.8],
    "press_rod": [-2.641, -2.064, -1.81, -4.64, 4.777, 5.87, 0, 4.764, 0, -0.543],
}


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def tip_pose(theta_deg):
    """Position and rotation of the tip: odd modules turn Rz(pitch) Ry(yaw), even ones Ry(yaw) Rz(pitch), then 0.1 m
    along x.
    """
    rotation = [[1.0 if i == j else 0.0 for j in range(3)] for i in range(3)]
    position = [0.0, 0.0, 0.0]
    for segment in range(5):
        p, y = (math.radians(theta_deg[2 * segment + k]) for k in range(2))
        rz = [[math.cos(p), -math.sin(p), 0], [math.sin(p), math.cos(p), 0], [0, 0, 1]]
        ry = [[math.cos(y), 0, math.sin(y)], [0, 1, 0], [-math.sin(y), 0, math.cos(y)]]
        for module in range(8):
            turn = multiply(rz, ry) if module % 2 == 0 else multiply(ry, rz)
            rotation = multiply(rotation, turn)
            position = [position[i] + 0.1 * rotation[i][0] for i in range(3)]
    return position, rotation


def quaternion(r):
    """Rotation matrix to w, x, y, z; the rotations here are far from half a turn."""
    w = math.sqrt(1 + r[0][0] + r[1][1] + r[2][2]) / 2
    return [w, (r[2][1] - r[1][2]) / (4 * w), (r[0][2] - r[2][0]) / (4 * w), (r[1][0] - r[0][1]) / (4 * w)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def combine(*terms):
    return [sum(s * v[i] for s, v in terms) for i in range(3)]


def scene():
    rod, attitude = tip_pose(POSES["press_rod"])
    n = [attitude[i][1] for i in range(3)]
    offset = dot(n, rod)
    u = [1 - n[0] * n[0], -n[0] * n[1], -n[0] * n[2]]
    u = [x / math.sqrt(dot(u, u)) for x in u]
    w = [u[1] * n[2] - u[2] * n[1], u[2] * n[0] - u[0] * n[2], u[0] * n[1] - u[1] * n[0]]
    middle = (1.75 + 3.70) / 2

    def box(name, across):
        return {
            "name": name,
            "center_m": combine((middle, u), (offset + across, n)),
            "half_extent_m": [(3.70 - 1.75) / 2, 0.01, 2.0],
            "rotation": [u, n, w],
        }

    frame = [[u[i], n[i], w[i]] for i in range(3)]
    return {
        "format": 1,
        "kind": "scene",
        "name": "panel_slit",
        "boxes": [box("panel", 0.06), box("wall", -0.06)],
        "spheres": [{"name": "obstacle", "center_m": [-0.15, 0.28, 1.10], "radius_m": 0.25}],
        "slit": {
            "normal": n,
            "offset_m": offset,
            "u_axis": u,
            "w_axis": w,
            "mouth_u_m": 1.75,
            "end_u_m": 3.70,
            "half_gap_m": 0.05,
            "frame": {"position_m": combine((1.75, u), (offset, n)), "quaternion_wxyz": quaternion(frame)},
        },
        "rod": {"position_m": rod, "quaternion_wxyz": quaternion(attitude), "radius_m": 0.010, "stiffness_N_per_m": 50},
        "camera": {"rate_hz": 25, "latency_s": 0.1, "noise_m": 0.0003, "noise_deg": 0.05, "range_m": 3.0},
        "contact": {"stiffness_N_per_m": 20000, "damping_Ns_per_m": 50, "friction": 0.2},
    }


def robot():
    return {
        "format": 1,
        "kind": "robot",
        "name": "zhu2022",
        "segments": [{"modules": 8, "module_length_m": 0.1, "theta_limit_deg": 20}] * 5,
        "module": {"mass_kg": 0.3, "radius_m": 0.03},
        "joint": {"viscous_Nms_per_rad": 0.4},
        "cables": {
            "hole_radius_m": 0.025,
            "face_offset_m": 0.010,
            "phase_deg": [[24 * m + 120 * c for c in range(3)] for m in range(5)],
            "EA_N": 240000,
            "lead_m": 0.5,
            "friction_mu": {"nominal": 0.05, "ideal": 0, "worn": 0.10},
        },
        "tension": {"plan_N": 40},
        "drives": {
            "drum_radius_m": 0.015,
            "counts_per_turn": 65536,
            "gear": 1,
            "servo_time_constant_s": 0.03,
            "rated_torque_Nm": 9,
            "identity": {"vendor": 19529, "product": 1, "revision": 1},
            "direction": [1, -1] * 7 + [1],
            "zero_counts": [1000000 + 1000 * i for i in range(15)],
        },
        "named_poses_deg": POSES,
    }


def buses():
    return {
        "format": 1,
        "kind": "buses",
        "name": "embedded",
        "backend": "embedded",
        "rate_hz": 250,
        "command_interval_s": 0.02,
        "buses": [
            {"name": "can0", "bitrate": 1000000, "nodes": list(range(1, 9))},
            {"name": "can1", "bitrate": 1000000, "nodes": list(range(9, 16))},
        ],
        "heartbeat_ms": 100,
        "max_load": 0.75,
    }


def feeder():
    """An arm on a base that feeds, as lua/robots/feeder.lua; its slide counts the other way round."""
    return {
        "format": 1,
        "kind": "robot",
        "name": "feeder",
        "base": {"limit_deg": 90, "slide_m_per_deg": 0.005, "roll_radius_m": 0.05, "mass_kg": 2},
        "segments": [{"modules": 4, "module_length_m": 0.05, "theta_limit_deg": 18}] * 4,
        "gravity_m_s2": [0, 0, -9.80665],
        "module": {"mass_kg": 0.04, "radius_m": 0.03},
        "joint": {"viscous_Nms_per_rad": 0.3},
        "cables": {
            "hole_radius_m": 0.026,
            "face_offset_m": 0.008,
            "phase_deg": [[30 * m + 120 * c for c in range(3)] for m in range(4)],
            "EA_N": 150000,
            "lead_m": 0.3,
            "friction_mu": {"nominal": 0.05, "ideal": 0, "worn": 0.10},
        },
        "tension": {"plan_N": 30},
        "drives": {
            "drum_radius_m": 0.012,
            "counts_per_turn": 16384,
            "gear": 1,
            "servo_time_constant_s": 0.03,
            "rated_torque_Nm": 5,
            "identity": {"vendor": 19529, "product": 1, "revision": 1},
            "direction": [-1] + [1] * 13,
            "zero_counts": [500000 + 1000 * i for i in range(14)],
        },
        "limits": {"cable_speed_m_s": 0.04},
        "named_poses_deg": {
            "zero": [0] * 10,
            "back": [-85] + [0] * 9,
            "look": [-20, 30, 6, -4, 5, 5, -6, 4, 3, 6],
        },
    }


def feeder_buses():
    return {
        **buses(),
        "name": "embedded_feeder",
        "buses": [
            {"name": "can0", "bitrate": 1000000, "nodes": list(range(1, 8))},
            {"name": "can1", "bitrate": 1000000, "nodes": list(range(8, 15))},
        ],
    }


def micro():
    rows = [(90, 0, 0.28), (90, 0, 0.22), (0, 2.10, 0.20), (0, 2.10, 0), (90, 0, 0.20), (-90, 0, 0.22), (0, 0, 0.28)]
    return {
        "format": 1,
        "kind": "serial",
        "name": "micro",
        "joints": [
            {
                "alpha_deg": alpha,
                "a_m": a,
                "d_m": d,
                "low_deg": -270,
                "high_deg": 270,
                "rate_deg_s": 4,
                "accel_deg_s2": 4,
            }
            for alpha, a, d in rows
        ],
        "link_radius_m": 0.15,
        "mass": {"module_kg": 30, "module_radius_m": 0.15, "boom_kg": 25, "end_effector_kg": 40},
        "friction": {"coulomb_Nm": 8, "viscous_Nms_per_rad": 40, "rotor_inertia_kgm2": 10},
        "drives": {
            "counts_per_turn": 1048576,
            "gear": 1,
            "servo_time_constant_s": 0.03,
            "rated_torque_Nm": 150,
            "identity": {"vendor": 19529, "product": 2, "revision": 1},
            "direction": [1, -1, 1, -1, 1, -1, 1],
            "zero_counts": [1000000] * 7,
        },
        "named_poses_deg": {"zero": [0] * 7, "prepare": [0, 60, -30, 100, -40, 60, 0]},
    }


def micro_buses():
    return {
        **buses(),
        "name": "embedded_micro",
        "buses": [
            {"name": "can0", "bitrate": 1000000, "nodes": [1, 2, 3, 4]},
            {"name": "can1", "bitrate": 1000000, "nodes": [5, 6, 7]},
        ],
    }


for name, make in (
    ("robot", robot),
    ("scene", scene),
    ("buses", buses),
    ("feeder", feeder),
    ("feeder_buses", feeder_buses),
    ("micro", micro),
    ("micro_buses", micro_buses),
):
    (pathlib.Path(sys.argv[1]) / (name + ".json")).write_text(json.dumps(make(), indent=1, sort_keys=True) + "\n")
