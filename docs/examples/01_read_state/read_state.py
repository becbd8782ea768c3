"""Reads the state of a simulated arm, once."""
from liana import System

with System() as system:
    state = system.client().until(lambda state: state["is_homed"])
    angles = ", ".join(f"{angle:.2f}" for angle in state["measured_js_deg"])
    print(f"{state['state']} at {state['time_s']:.2f} s, joints at {angles} deg")
