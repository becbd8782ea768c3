"""The arms that scenarios are run with: what each stands in and on, and how it is moved."""
import collections

# `scene`, `bus`: tables under lua/; `joint`: index of the angle that test moves turn; `mission`: a short one.
Arm = collections.namedtuple("Arm", "scene bus joint mission")
ARMS = {
    "zhu2022": Arm("panel_slit", "embedded", 8, "short.lua"),
    "feeder": Arm("none", "embedded_feeder", 0, "short_micro.lua"),
    "lab_1g": Arm("none", "embedded_lab_1g", 3, "short_micro.lua"),
    "micro": Arm("none", "embedded_micro", 3, "short_micro.lua"),
    "macro_micro_stiff": Arm("none", "embedded_payload", 3, "short_micro.lua"),
}
CABLE_ARM = "zhu2022"


def tables(robot):
    """The words of System that name this robot's tables."""
    return {"robot": robot, "scene": ARMS[robot].scene, "bus": ARMS[robot].bus}
