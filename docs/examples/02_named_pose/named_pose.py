"""Moves a simulated arm to a named pose of its robot table."""
import json

from liana import System
from liana.system import table

goal_deg = json.loads(table("robot", "zhu2022"))["named_poses_deg"]["zero"]
with System(scene="none") as system:
    client = system.client()
    client.enable()
    client.call("move_jp", goal_deg=goal_deg)
    state = client.until(lambda state: not state["is_busy"], limit_s=120)
    error_deg = max(abs(goal - angle) for goal, angle in zip(goal_deg, state["measured_js_deg"]))
    print(f"{state['state']}, largest error {error_deg:.2f} deg after {state['time_s']:.0f} s")
