"""Every request, of every kind of client, and every Lua function, in every operating state: whatever the arm did after
it, both ends of verification had passed, and all safety rules held (req:A20).
"""
import json
import re
import time
import unittest

from support import SOURCE, SystemTest
import trial
from liana.client import ConnectionClosed
from liana.devices import Device
from liana.system import System

# Not archive: the recorder that the run is judged by has its only place.
ROLES = ("mission", "operator", "camera", "client", "observer", "tool")
TIP = [3.9, 0.1, 0.1, 1.0, 0.0, 0.0, 0.0]
HAND = [0.1, 0, 0, 1, 0, 0, 0]
SMALL_DEG = 4.0
FAULT_SLOT = 1500
PATIENCE_S = 120


def joints(state):
    goal_deg = list(state["setpoint_js_deg"])
    goal_deg[8] -= SMALL_DEG
    return goal_deg


# Fields with which a request asks for something in earnest, from the state that the arm is in.
REQUESTS = {
    "hello": lambda state: {"name": "again", "role": "client"},
    "done": lambda state: {"tick": state["tick"]},
    "acquire": lambda state: {},
    "release": lambda state: {},
    "state_command": lambda state: {"command": "enable"},
    "move_jp": lambda state: {"goal_deg": joints(state)},
    "move_path": lambda state: {"points_deg": [state["setpoint_js_deg"], joints(state)]},
    "move_cp": lambda state: {
        "goal": state["setpoint_cp"][:2] + [state["setpoint_cp"][2] + 0.05] + state["setpoint_cp"][3:]
    },
    "servo_cp": lambda state: {"goal": state["setpoint_cp"]},
    "servo_target": lambda state: {"target": "rod", "offset": TIP},
    "insert": lambda state: {"force_N": 10},
    "comply": lambda state: {},
    "payload": lambda state: {"mass_kg": 10, "inertia_kgm2": [1, 1, 1, 0, 0, 0]},
    "adapter": lambda state: {"command": "lock"},
    "hold_theta": lambda state: {"held": [{"theta": 9, "target_deg": 2.0}]},
    "shape": lambda state: {"nodes": [{"node": 2, "position_m": [1.5, 0.2, 0.0]}]},
    "dither": lambda state: {"share": 0.1, "duration_s": 1},
    "use_device": lambda state: {"device": "hand"},
    "retract": lambda state: {},
    "hold": lambda state: {},
    "tool": lambda state: {"command": "close"},
    "stop": lambda state: {},
    "shutdown": lambda state: {},
    "timing": lambda state: {},
    "announce": lambda state: {"step": {"index": 1, "name": "a step", "device": "none"}},
    "mission_control": lambda state: {"command": "resume"},
    "operator_says": lambda state: {"what": "arrived"},
    "archive_alarm": lambda state: {"text": "the disk is full", "count": 1},
    "devices": lambda state: {},
    "tool_report": lambda state: {"number": 1, "phase": "done", "time_s": state["time_s"]},
    "camera": lambda state: {"capture_time_s": state["time_s"], "slit": TIP, "rod": TIP},
}
# What is left out where it would only end the connection it comes from, or the whole system.
LAST = "shutdown"
OWN = set(REQUESTS) - {LAST, "done"}


def lua(value):
    """As Lua writes it."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{name} = {lua(each)}" for name, each in value.items()) + "}"
    if isinstance(value, list):
        return "{" + ", ".join(map(lua, value)) + "}"
    return json.dumps(value)


def disabled(client):
    client.call("stop")
    client.until(lambda state: state["state"] in ("DISABLED", "FAULT"))


def enabled(client):
    if client.state["state"] == "FAULT":
        client.call("acquire")
        client.call("state_command", command="clear")
    client.until(lambda state: state["state"] in ("DISABLED", "ENABLED"))
    if client.state["state"] == "ENABLED":
        client.call("acquire")
        client.call("hold")
        client.until(lambda state: state["at_rest"] and not state["is_busy"], 60)
    else:
        client.enable()


def moving(client):
    enabled(client)
    client.start_moving(change_deg=SMALL_DEG if client.state["setpoint_js_deg"][8] > 0 else -SMALL_DEG)


def braking(client):
    moving(client)
    client.call("hold")


def led_back(client):
    moving(client)
    client.call("retract")


STATES = {"disabled": disabled, "enabled": enabled, "moving": moving, "braking": braking, "led back": led_back}


class Crowded(System):
    """With a client of every role, there before the bench is: it would be the one camera and the one tool."""

    def start_bench(self):
        self.others = {role: self.client(role, role, lockstep=False, subscribe=()) for role in ROLES}
        self.hand = Device(f"{self.api}.devices", "omega")
        super().start_bench()


class EveryRequest(SystemTest):
    def setUp(self):
        self.system = self.enterContext(Crowded(expect="client,archive", faults=self.faults()))
        self.others = self.system.others
        self.addCleanup(self.system.hand.close)
        self.system.start_archive()
        self.client = self.system.client()

    def faults(self):
        slot = FAULT_SLOT if "fault" in self._testMethodName else None
        return [{"kind": "fault", "drive": 5, "at_slot": slot}] if slot else []

    def judge(self):
        self.client.request(LAST)
        with self.assertRaises(ConnectionClosed):
            while True:
                self.client.step()
        for name in ("lianad", "liana-bus", "liana-bench"):
            self.assertEqual(self.system.ended(name), 0, name)
        judged = trial.Trial(self.faults())
        judged.judge(self.system, self.client.faults_told)
        self.assertEqual(judged.complaints, [])
        return judged

    def steer(self):
        """The device's deadman is held all the time, and its hand moves on."""
        hand, now_us = self.system.hand, round(1e6 * self.client.state["time_s"])
        hand.receive(now_us)
        hand.send(now_us, [now_us * 1e-8, *HAND[1:]], deadman=True)

    def everyone_asks(self, op, reach):
        """The owner, and then every other kind of client, each with the arm in the state again."""
        reach(self.client)
        self.client.ask(op, **REQUESTS[op](self.client.state))
        self.steer()
        self.client.go_on(0.1)
        for other in self.others.values():
            other.request(op, **REQUESTS[op](self.client.state))
        self.client.go_on(0.2)

    def test_the_page_of_requests_has_no_other_than_those_tried_here(self):
        page = (SOURCE / "docs" / "reference" / "api.md").read_text().split("<!-- requests", 1)[1].split("###", 1)[0]
        self.assertEqual(set(re.findall(r"^\| `(\w+)` \|", page, re.M)), set(REQUESTS))

    def test_while_the_drives_boot(self):
        self.client.step()
        for op in sorted(OWN):
            for each in (self.client, *self.others.values()):
                each.request(op, **REQUESTS[op](self.client.state))
        self.client.step()
        self.assertEqual(self.client.state["state"], "BOOTING")
        self.client.until(lambda state: state["state"] == "DISABLED")
        self.judge()

    def test_in_every_state_of_a_sound_arm(self):
        self.client.until(lambda state: state["state"] == "DISABLED" and state["is_homed"])
        for reach in STATES.values():
            for op in sorted(OWN):
                self.everyone_asks(op, reach)
        judged = self.judge()
        self.assertGreater(len({tick.sequence for tick in judged.recording.ticks}), 100)

    def test_of_a_mission(self):
        stubs = (SOURCE / "lua" / "liana" / "arm_stubs.lua").read_text().split("made by ./dev docs", 1)[1]
        functions = re.findall(r"^function arm\.(\w+)\(", stubs, re.M)
        self.assertGreater(len(functions), 10)
        self.client.until(lambda state: state["state"] == "DISABLED" and state["is_homed"])
        for function in functions:
            enabled(self.client)
            self.client.call("release")
            self.system.start_mission(self.mission(function), lockstep=False)
            self.until_the_mission_has_ended()
            self.client.call("acquire")
        self.judge()

    def until_the_mission_has_ended(self):
        """By the wall clock: the arm's time runs ahead while a loaded machine still starts the mission's process."""
        end_s = time.monotonic() + PATIENCE_S
        while self.system.children["liana-mission"].poll() is None:
            self.assertLess(time.monotonic(), end_s, "the mission has not ended")
            self.client.step()

    def mission(self, function):
        """A file with a mission of one step, which calls this function of `arm`."""
        path = self.system.directory / f"{function}.lua"
        fields = lua(REQUESTS[function](self.client.state))
        path.write_text(
            f"""local liana = require "liana"
local again = liana.condition("never", function() return false end)
return liana.mission "{function}" {{
  liana.step "one" {{
    device = "none", run = function(arm) arm.{function}({fields}) end, exit = again, time_limit_s = 1, on_fail = "hold",
  }},
}}
"""
        )
        return path

    def test_after_a_fault(self):
        self.client.enable()
        self.client.until(lambda state: state["state"] == "FAULT")
        for op in sorted(OWN):
            self.everyone_asks(op, lambda client: None)
        self.judge()


if __name__ == "__main__":
    unittest.main(verbosity=2)
