"""Input devices at a running system (docs/reference/device-protocol.md): drivers in other languages, drivers that die,
that flood, that lie, and what `liana device` tells of them (req:A30).
"""
import itertools
import json
import math
import os
import pathlib
import socket
import struct
import subprocess
import threading
import time
import unittest

from support import SOURCE, SystemTest
from liana.devices import Device
from liana.system import System, program, run

HERE = [1.0, 0.0, 0.0, 0.0]  # a hand's attitude
MOTION, PRESS = 0, 1  # events of spacenavd


class Spacenavd:
    """Where libspnav looks for spacenavd: one client, to which the test gives what a puck does. It speaks the first
    protocol, of events alone: what the library says at its start stays unanswered."""

    def __init__(self, path):
        self.path = path
        self.listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.listener.bind(str(path))
        self.listener.listen(1)
        self.client = None

    def accept(self):
        self.client, _ = self.listener.accept()

    def push(self, *deflection):
        self.client.send(struct.pack("8i", MOTION, *deflection, 0))

    def keep_pushing(self, *deflection):
        """As a hand does: a hundred times a second, never twice the same; ends with what is returned."""
        over = threading.Event()

        def words():
            trembles = itertools.cycle((0, 1, -1, 2))
            while not over.wait(0.01):
                self.push(*[each and each + next(trembles) for each in deflection])

        hand = threading.Thread(target=words)
        hand.start()
        return lambda: (over.set(), hand.join())

    def press(self, button):
        self.client.send(struct.pack("8i", PRESS, button, *[0] * 6))

    def close(self):
        for each in (self.client, self.listener):
            if each:
                each.close()


class DevicesTest(SystemTest):
    def setUp(self):
        self.system = self.enterContext(System())
        self.client = self.system.client()
        self.path = f"{self.system.api}.devices"

    def device(self, name="omega", **options):
        device = Device(self.path, name, **options)
        self.addCleanup(device.close)
        return device

    def start(self, *words, **environment):
        """A driver of its own, ended with the test."""
        driver = subprocess.Popen(
            list(map(str, words)),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **environment},
        )
        self.addCleanup(driver.communicate)
        self.addCleanup(driver.kill)
        return driver

    def listed(self, name):
        """Goes on until lianad lists a device of this name."""
        return self.client.until(lambda state: name in [each["name"] for each in state["devices"]])

    def patiently(self, wanted, limit_s=60.0):
        """Goes on until wanted(state), a state in at least 20 ms: the driver's time is the wall's, and where the arm's is
        a hundred times as fast, no sample is young enough on a busy machine."""
        return self.client.until(lambda state: time.sleep(0.02) or wanted(state), limit_s)

    def steer(self, device, seconds, deadman=True, speed_m_s=0.02):
        """The device's hand goes on upwards, a sample for each state; its clock is the arm's."""
        end_s = self.client.state["time_s"] + seconds
        while self.client.state["time_s"] < end_s:
            now_us = round(1e6 * self.client.state["time_s"])
            device.receive(now_us)
            device.send(now_us, [0.0, 0.0, speed_m_s * now_us * 1e-6 % 0.5, *HERE], deadman)
            self.client.step()
        return self.client.state

    def has_moved(self, before, metres=0.002):
        return lambda state: math.dist(state["setpoint_cp"][:3], before["setpoint_cp"][:3]) > metres


class Drivers(DevicesTest):
    def test_a_sample_leads_the_tip_and_the_state_says_what_it_led_to(self):
        device = self.device()
        self.client.enable()
        self.client.call("use_device", device="hand")
        before = self.client.state
        state = self.steer(device, 1.0)
        self.assertTrue(state["device_engaged"])
        self.assertTrue(self.has_moved(before)(state))
        told = device.receive(round(1e6 * state["time_s"]))
        self.assertEqual(told.tick, state["tick"], "whoever has the state has had what the device was told")
        self.assertTrue(told.in_use and told.engaged)
        self.assertEqual(told.measured_cp, state["measured_cp"])
        delay_s = state["time_s"] - told.answers_us * 1e-6 - told.held_us * 1e-6
        self.assertLessEqual(delay_s, 0.0401, "two command intervals from a sample to its command")
        entry = state["devices"][0]
        self.assertTrue(entry["clock_known"])
        self.assertAlmostEqual(entry["delay_up_s"] + entry["delay_down_s"], 0.0, delta=1e-6)

    # req:A12
    def test_a_driver_that_dies_in_motion_is_a_hold(self):
        device = self.device()
        self.client.enable()
        self.client.call("use_device", device="omega")
        self.assertTrue(self.steer(device, 1.0)["device_engaged"])
        device.close()
        state = self.client.until(lambda state: not state["device_engaged"], 0.2)
        self.assertEqual((state["device_reason"], state["devices"]), ("device gone", []))
        self.client.until(lambda state: state["at_rest"], 5)
        self.assert_holds(self.client.state)
        self.assertIn("device omega is gone", " ".join(event["text"] for event in self.client.events))

    # req:A12
    def test_a_device_that_jumps_lies_of_its_time_or_says_it_is_stale_is_a_hold_that_names_why(self):
        device = self.device()
        self.client.enable()
        self.client.call("use_device", device="omega")
        now_us = lambda: round(1e6 * self.client.state["time_s"])
        lies = {
            "hand jumped": lambda us: (us, [0.03, 0.0, 0.0, *HERE], True),
            "clock set": lambda us: (us + 300_000, [0.0, 0.0, 0.0, *HERE], True),
            "samples refused": lambda us: (us, [math.nan, 0.0, 0.0, *HERE], True),
            "input stale": lambda us: (us, [0.0, 0.0, 0.0, *HERE], True, True, True),
        }
        for reason, lie in lies.items():
            with self.subTest(reason):
                for deadman in (False, True):
                    end_s = self.client.state["time_s"] + 0.5
                    while self.client.state["time_s"] < end_s:
                        device.receive(now_us())
                        device.send(now_us(), [0.0, 0.0, 0.0, *HERE], deadman)
                        self.client.step()
                self.assertTrue(self.client.state["device_engaged"])
                begin_s = self.client.state["time_s"]
                while self.client.state["device_engaged"] and self.client.state["time_s"] < begin_s + 1.0:
                    device.send(*lie(now_us()))
                    self.client.step()
                self.assertLessEqual(self.client.state["time_s"], begin_s + 0.1001)
                self.assertEqual(self.client.state["device_reason"], reason)
                if reason == "clock set":  # its clock goes on from there; who sets it back says hello again
                    self.client.go_on(0.5)

    def test_the_driver_in_plain_c_of_the_documentation_steers(self):
        built = self.system.directory / "device_driver"
        source = SOURCE / "docs" / "examples" / "04_device_driver" / "driver.c"
        compiler = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"]
        subprocess.run([*compiler, "-I", SOURCE / "host" / "api" / "device", source, "-o", built, "-lm"], check=True)
        driver = self.start(built, self.path)
        self.listed("sine")
        self.client.enable()
        self.client.call("use_device", device="sine")
        self.patiently(lambda state: state["device_engaged"])
        self.patiently(self.has_moved(self.client.state, 0.001))
        self.client.call("use_device", device="none")
        driver.terminate()

    def test_a_second_lianad_would_not_take_the_sockets_and_this_one_takes_them_away(self):
        sockets = [pathlib.Path(self.path), self.system.api]
        self.assertTrue(all(socket.is_socket() for socket in sockets))
        self.system.shut_down(self.client)
        self.assertFalse(any(socket.exists() for socket in sockets))


class Spacemice(DevicesTest):
    def setUp(self):
        super().setUp()
        self.daemon = Spacenavd(self.system.directory / "spnav.sock")
        self.addCleanup(self.daemon.close)

    def spacemouse(self, *words):
        driver = self.start(
            program("liana-spacemouse"), "--api", self.system.api, *words, SPNAV_SOCKET=str(self.daemon.path)
        )
        self.daemon.accept()
        self.listed("spacemouse")
        return driver

    def test_a_pushed_puck_moves_the_tip_and_a_puck_let_go_is_a_hold(self):
        self.spacemouse()
        self.client.enable()
        self.client.call("use_device", device="pointer")
        before = self.client.state
        let_go = self.daemon.keep_pushing(0, 340, 0, 0, 0, 0)
        self.addCleanup(let_go)
        self.patiently(lambda state: state["device_engaged"])
        state = self.patiently(self.has_moved(before))
        self.assertGreater(state["setpoint_cp"][2], before["setpoint_cp"][2], "up is up")
        let_go()
        self.daemon.push(*[0] * 6)
        self.patiently(lambda state: not state["device_engaged"] and state["at_rest"])
        self.assert_holds(self.client.state)

    # req:A12
    def test_a_puck_that_says_no_more_while_it_is_pushed_is_a_hold_until_it_was_let_go(self):
        self.spacemouse()
        self.client.enable()
        self.client.call("use_device", device="pointer")
        let_go = self.daemon.keep_pushing(0, 340, 0, 0, 0, 0)
        self.addCleanup(let_go)
        self.patiently(lambda state: state["device_engaged"])
        let_go()  # and no word of rest: it sleeps, or is out of reach
        state = self.patiently(lambda state: not state["device_engaged"])
        self.assertEqual(state["device_reason"], "input stale")
        self.patiently(lambda state: state["at_rest"])
        self.assert_holds(self.client.state)
        self.addCleanup(self.daemon.keep_pushing(0, 340, 0, 0, 0, 0))
        end_s = self.client.state["time_s"] + 0.5
        self.patiently(lambda state: self.assertFalse(state["device_engaged"]) or state["time_s"] > end_s)

    def test_spacenavd_that_ends_is_a_hold_and_is_said(self):
        driver = self.spacemouse("--button", "0")
        self.daemon.close()
        self.client.until(lambda state: state["devices"] == [], 600)
        self.assertEqual(driver.wait(60), 1)
        self.assertIn("spacenavd is gone", driver.stderr.read())

    def test_without_spacenavd_it_says_what_to_do(self):
        done = run("liana-spacemouse", "--api", self.system.api, env={**os.environ, "SPNAV_SOCKET": "/nowhere"})
        self.assertEqual(done.returncode, 2)
        self.assertIn("spacenavd does not listen", done.stderr)


class Attacks(DevicesTest):
    def raw(self, *packets):
        stranger = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.addCleanup(stranger.close)
        stranger.connect(self.path)
        for packet in packets:
            stranger.send(packet)
        return stranger

    def test_garbage_is_refused_while_another_device_steers_on(self):
        device = self.device()
        self.client.enable()
        self.client.call("use_device", device="omega")
        self.steer(device, 0.5)
        strangers = [self.raw(os.urandom(size)) for size in (1, 15, 16, 240, 752, 4096)]
        self.assertTrue(self.steer(device, 0.5)["device_engaged"])
        for stranger in strangers:
            self.assertIn(b"allowed", stranger.recv(1024))
        events = " ".join(event["text"] for event in self.client.events)
        self.assertIn("is refused: header.", events)

    def test_a_flood_ends_that_device_and_the_arm_holds(self):
        device = self.device()
        self.client.enable()
        self.client.call("use_device", device="omega")
        self.steer(device, 0.5)
        device.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 1 << 20)  # room for as many at once
        now_us = round(1e6 * self.client.state["time_s"])
        for i in range(300):
            device.send(now_us + i, [0.0, 0.0, 0.0, *HERE], True)
        self.client.until(lambda state: not state["device_engaged"], 1)
        device.receive(now_us)
        self.assert_names(device.problem, "256 packets")


class CommandLine(DevicesTest):
    def told(self, *words):
        """`liana device` with these words, while time goes on."""
        results = []
        asking = threading.Thread(
            target=lambda: results.append(run("liana", "device", *words, "--api", self.system.api))
        )
        asking.start()
        while asking.is_alive():
            self.client.step()
        asking.join()
        return results[0]

    def test_what_is_connected_is_listed_with_rate_and_delays(self):
        self.assertIn("0 devices", self.told("list").stdout)
        device = self.device(kind="pointer")
        self.listed("omega")
        self.steer(device, 2.5, deadman=False)
        line = self.told("list").stdout.splitlines()[2]
        self.assertRegex(line, r"^omega +pointer +1 +50.0 Hz +0.0 ms +0.0 ms")
        told = json.loads(self.told("list", "--json").stdout)["devices"][0]
        self.assertEqual((told["name"], told["hands"][0]["sensed"]), ("omega", 63))

    def test_a_device_is_watched_and_one_that_is_not_there_is_named(self):
        device = self.device()
        self.listed("omega")
        self.steer(device, 0.2)
        watched = self.told("watch", "omega", "--seconds", "0.2", "--json")
        self.assertEqual(watched.returncode, 0, watched.stderr)
        self.assertTrue(json.loads(watched.stdout.splitlines()[0])["hands"][0]["sample"]["deadman"])
        missing = self.told("watch", "falcon")
        self.assertEqual(missing.returncode, 1)
        self.assert_names(missing.stderr, "falcon", "omega")


if __name__ == "__main__":
    unittest.main()
