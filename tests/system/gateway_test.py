"""The console's gateway against lianad and the simulated arm (docs/console-protocol.md)."""
import contextlib
import json
import math
import os
import pathlib
import struct
import subprocess
import tempfile
import threading
import time
import unittest

from support import SystemTest
from console_client import BINARY, Closed, Console, Refused, WebSocket, http_get
from liana.client import wait_until
from liana.system import System, program


class Gateway:
    """liana-gateway for one test, on a free port unless another is given."""

    def __init__(self, test, api, *words, listen="127.0.0.1:0"):
        self.log_file = tempfile.NamedTemporaryFile("r", prefix="liana-gateway-", suffix=".log")
        test.addCleanup(self.log_file.close)
        with open(self.log_file.name, "ab") as log:
            call = [program("liana-gateway"), "--api", str(api), "--listen", listen, *map(str, words)]
            self.process = subprocess.Popen(call, stdout=subprocess.PIPE, stderr=log, text=True)
        test.addCleanup(self.process.stdout.close)
        test.addCleanup(self.end)
        self.address = self.process.stdout.readline().strip()

    def end(self):
        self.process.kill()
        self.process.wait()

    def log(self):
        return pathlib.Path(self.log_file.name).read_text()

    def resident_kB(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.split("VmRSS:")[1].split()[0])


class GatewayTest(SystemTest):
    """A system whose time one lockstep client lets go on: `pace` of them a second while the block runs."""

    def setUp(self):
        self.system = self.enterContext(System())
        self.keeper = self.system.client("keeper", "client")
        self.gateway = Gateway(self, self.system.api)
        self.states = {}  # by tick, as lianad tells them
        self.over = False
        self.thread = threading.Thread(target=self.keep_going)
        self.thread.start()
        self.addCleanup(self.stop_keeping)

    def keep_going(self):
        with contextlib.suppress(OSError):
            while not self.over:
                state = self.keeper.step()
                self.states[state["tick"]] = state
                time.sleep(0.004)

    def stop_keeping(self):
        self.over = True
        self.thread.join()

    def console(self, name="anna", **options):
        console = Console(self.gateway.address, name, **options)
        self.addCleanup(console.close)
        return console


class WhatAClientSees(GatewayTest):
    def test_records_and_facts_say_what_lianads_state_says(self):
        console = self.console().until(lambda me: len(me.sequences) > 5 and me.facts.get("is_homed"))
        self.assertEqual(console.welcome["protocol"], 1)
        self.assertEqual((console.welcome["role"], console.welcome["name"]), ("operate", "anna"))
        self.assertEqual(console.welcome["robot"], self.keeper.welcome["robot"])
        wait_until(lambda: console.state["tick"] in self.states, "the same state")
        said = self.states[console.state["tick"]]
        flat = {
            "measured_js_deg": said["measured_js_deg"],
            "setpoint_cp": said["setpoint_cp"],
            "tension_N": said["tension_N"],
            "node_m": sum(said["node_m"], []),
            "drives.position_m": [drive["position_m"] for drive in said["drives"]],
            "buses.frames": [bus["frames"] for bus in said["buses"]],
            "friction.mu": [said["friction"]["mu"]],
        }
        for name, numbers in flat.items():
            with self.subTest(name):
                self.assertEqual(console.state[name], [struct.unpack("f", struct.pack("f", n))[0] for n in numbers])
        self.assertEqual(console.state["time_s"], said["time_s"])
        console.until(lambda me: me.header[1] == me.facts_number)
        for name in ("state", "is_homed", "owner", "held", "faults"):
            self.assertEqual(console.facts[name], self.states[console.state["tick"]][name], name)
        self.assertNotIn("measured_js_deg", console.facts)

    def test_events_come_in_order_each_once_and_those_kept_come_to_a_latecomer(self):
        first = self.console().until(lambda me: me.facts.get("is_homed"))
        first.stop("look")
        first.until(lambda me: any("look" in event["text"] for event in me.events))
        late = self.console("late").until(lambda me: len(me.events) >= len(first.events))
        for console in (first, late):
            sequences = [event["sequence"] for event in console.events]
            self.assertEqual(sequences, list(range(1, len(sequences) + 1)))
        self.assertEqual(late.events[: len(first.events)], first.events)

    def test_who_answers_no_record_gets_four_and_after_that_the_newest(self):
        console = self.console(answers=False).until(lambda me: len(me.sequences) == 4)
        other = self.console("other").until(lambda me: len(me.sequences) > 60)
        console.socket.settimeout(0.3)
        with self.assertRaises(TimeoutError):
            console.until(lambda me: len(me.sequences) > 4)
        console.socket.settimeout(60)
        console.answer_record()
        console.until(lambda me: len(me.sequences) == 5)
        self.assertGreaterEqual(console.sequences[4], other.sequences[-1] - 1)

    def test_a_slower_pace_is_kept(self):
        console = self.console().until(lambda me: len(me.sequences) > 3)
        console.say({"op": "pace", "hz": 4})
        begin, seen = time.monotonic(), len(console.sequences)
        console.until(lambda me: len(me.sequences) == seen + 6)
        self.assertGreater(time.monotonic() - begin, 1.0)


class WhatAClientMayDo(GatewayTest):
    def test_each_client_owns_motion_itself_and_its_death_is_a_hold(self):
        owner, other = self.console("owner"), self.console("other")
        owner.enable()
        answer = other.ask("acquire")
        self.assertEqual((answer["ok"], answer["code"]), (False, "not_owner"))
        self.assertIn("owner", answer["message"])
        goal = list(owner.state["setpoint_js_deg"])
        goal[8] -= 6.0
        owner.call("move_jp", goal_deg=goal)
        other.until(lambda me: me.facts["is_busy"] and abs(me.state["setpoint_js_deg"][8] - goal[8]) < 5.5)
        owner.close()
        other.until(lambda me: me.facts["owner"] == "")
        other.until(lambda me: me.facts["at_rest"] and not me.facts["is_busy"])
        self.assertEqual(other.facts["state"], "ENABLED")
        self.assertGreater(abs(other.state["setpoint_js_deg"][8] - goal[8]), 1.0)
        other.call("acquire")

    def test_a_stop_of_another_client_is_confirmed_by_lianad_and_takes_the_drives_power(self):
        owner, other = self.console("owner"), self.console("other")
        owner.enable()
        number = other.stop("hand on the key")
        other.until(lambda me: number in me.answers)
        self.assertTrue(other.answers[number]["ok"])
        other.until(lambda me: me.facts["stop"] and me.facts["state"] == "DISABLED")
        self.assertEqual((other.facts["stop"]["by"], other.facts["stop"]["reason"]), ("other", "hand on the key"))

    def test_a_stop_that_is_no_proper_message_is_a_stop(self):
        console = self.console().until(lambda me: me.facts)
        console.send('{"op":"stop","reason":"in a hurry", ')
        console.until(lambda me: me.facts["stop"])
        self.assertEqual(console.facts["stop"]["reason"], "in a hurry")

    def test_two_clients_of_one_name_are_told_apart(self):
        self.assertEqual(self.console("anna").until(lambda me: me.welcome).welcome["name"], "anna")
        self.assertEqual(self.console("anna").until(lambda me: me.welcome).welcome["name"], "anna-2")

    def test_device_samples_reach_lianad_beside_motion_requests(self):
        console = self.console("pilot")
        console.enable()
        console.call("use_device", device="vr")
        hand = {"valid": True, "trigger": 0, "pose": [0, 0, 0, 1, 0, 0, 0]}
        before = console.state["device_samples"][0]
        for i in range(20):
            console.call("device", device="vr", samples=[{"t_us": 11111 * i, "right": hand, "left": hand}])
        console.until(lambda me: me.state["device_samples"][0] >= before + 20)

    def test_what_lianad_refuses_is_answered_in_its_words(self):
        console = self.console().until(lambda me: me.facts)
        console.enable()
        answer = console.ask("move_jp", goal=[1])
        self.assertEqual((answer["ok"], answer["code"]), (False, "bad_request"))
        self.assertIn("goal", answer["message"])
        for op in ("hello", "done", "shutdown"):
            self.assertEqual(console.ask(op)["code"], "not_allowed")


class WhenSomethingEnds(GatewayTest):
    def test_a_gateway_that_was_killed_and_started_again_goes_on_and_the_arm_held_meanwhile(self):
        console = self.console("owner")
        console.enable()
        tick = console.state["tick"]
        self.gateway.end()
        with self.assertRaises(OSError):
            console.until(lambda me: False)
        wait_until(lambda: self.keeper.state["owner"] == "", "the hold")
        port = self.gateway.address.rsplit(":", 1)[1].strip("/")
        self.gateway = Gateway(self, self.system.api, listen=f"127.0.0.1:{port}")
        again = self.console("owner").until(lambda me: me.state.get("tick", 0) > tick)
        self.assertEqual(again.facts["state"], "ENABLED")
        again.call("acquire")

    def test_the_end_of_lianad_is_told_and_what_was_asked_is_answered(self):
        console = self.console().until(lambda me: me.facts)
        self.stop_keeping()
        self.system.kill("lianad")
        console.until(lambda me: me.away)
        self.assertIn("lianad", console.away)
        self.assertEqual(console.ask("acquire")["code"], "away")
        number = console.stop()
        console.until(lambda me: number in me.answers)
        self.assertFalse(console.answers[number]["ok"])
        self.assertIn("cut the power", console.answers[number]["message"])


if __name__ == "__main__":
    unittest.main()
