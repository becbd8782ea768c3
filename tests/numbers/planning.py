"""Planning at full size: random goals, tip and shape together, teleoperation at its limits, offline plans."""
import importlib

PARTS = {
    "planning_goals": "Random goals",
    "planning_shape": "Tip and shape",
    "planning_teleop": "Teleoperation",
    "planning_plans": "Offline plans",
    "planning_follow": "Following the leader",
}


def measure(binaries):
    values, texts = {}, []
    for name, title in PARTS.items():
        values[name], text = importlib.import_module(name).measure(binaries)
        texts.append(f"### {title}\n{text.strip()}\n")
    return values, "\n".join(texts)
