#!/usr/bin/env python3
"""liana ground between a ground station and lianad: the station is this test, with a codec of its own."""
import contextlib
import json
import select
import shutil
import signal
import socket
import sqlite3
import struct
import subprocess
import time
import unittest

import support
from liana import System
from liana.client import PATIENCE_S
from liana.system import program
from xtce_walker import Walker, same

APID = 100
ALL = 15  # acknowledgement flags
ACQUIRE, ENABLE, MOVE_JP, HOLD, ESTOP, CLEAR, MISSION = 1, 3, 7, 9, 11, 5, 12


def crc(octets):
    """CRC-16-CCITT bit by bit, as ECSS-E-ST-70-41C annex B states it."""
    value = 0xFFFF
    for octet in octets:
        for bit in range(7, -1, -1):
            top = (value >> 15) ^ (octet >> bit & 1)
            value = (value << 1 & 0xFFFF) ^ (0x1021 if top else 0)
    return value


def telecommand(count, service, subtype, data=b"", apid=APID, acknowledge=ALL, first=0x1800):
    body = bytes([0x20 | acknowledge, service, subtype, 0, 7]) + data
    head = struct.pack(">HHH", first | apid, 0xC000 | count, len(body) + 1)
    return head + body + struct.pack(">H", crc(head + body))


def pcap_of(packets):
    """A capture with each packet in a UDP datagram of its own: raw IPv4, as libpcap's LINKTYPE_IPV4 has it."""
    out = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, 228)
    for packet in packets:
        udp = struct.pack(">HHHH", 10015, 10015, 8 + len(packet), 0) + packet
        ends = bytes([127, 0, 0, 1, 127, 0, 0, 1])
        frame = struct.pack(">BBHHHBBH", 0x45, 0, 20 + len(udp), 0, 0, 64, 17, 0) + ends + udp
        out += struct.pack("<IIII", 0, 0, len(frame), len(frame)) + frame
    return out


class Report:
    def __init__(self, packet):
        self.octets = packet
        first, second, _ = struct.unpack(">HHH", packet[:6])
        self.apid, self.count, self.has_header = first & 0x7FF, second & 0x3FFF, bool(first & 0x800)
        self.kind = (packet[7], packet[8]) if self.has_header else (9, 2)
        self.data = packet[20:-2] if self.has_header else packet[6:-2]

    @property
    def request(self):
        """The sequence count of the telecommand that a report of service 1 is about."""
        return struct.unpack(">H", self.data[2:4])[0] & 0x3FFF

    @property
    def code(self):
        return struct.unpack(">H", self.data[4:6])[0]


class Station:
    """Sends telecommands, keeps reports; lets the arm's time go on while it waits."""

    def __init__(self, client, ports):
        self.client = client
        self.read = self.connect(ports["telemetry"])
        self.write = self.connect(ports["telecommand"])
        self.count, self.waiting, self.reports, self.states = 0, b"", [], {}
        self.pings_every_s, self.pinged_s = 0.0, 0.0  # of wall clock; 0: never

    @staticmethod
    def connect(address):
        host, port = address.rsplit(":", 1)
        return socket.create_connection((host, int(port)), timeout=PATIENCE_S)

    def send(self, *words, **options):
        """The sequence count of what was sent."""
        self.count += 1
        self.write.sendall(telecommand(self.count, *words, **options))
        return self.count

    def function(self, number, arguments=b""):
        return self.send(8, 1, struct.pack(">H", number) + arguments)

    def move(self, goal_deg, rate_deg_s=0.0):
        return self.function(MOVE_JP, struct.pack(f">{len(goal_deg)}dd", *goal_deg, rate_deg_s))

    def step(self):
        if self.pings_every_s and time.monotonic() - self.pinged_s > self.pings_every_s:
            self.pinged_s = time.monotonic()
            self.send(17, 1, acknowledge=0)
        state = self.client.step()
        self.states[state["tick"]] = state
        while select.select([self.read], [], [], 0.001)[0]:
            new = self.read.recv(65536)
            if not new:
                raise ConnectionError("telemetry has ended")
            self.waiting += new
        while len(self.waiting) >= 6:
            size = struct.unpack(">H", self.waiting[4:6])[0] + 7
            if len(self.waiting) < size:
                break
            packet, self.waiting = self.waiting[:size], self.waiting[size:]
            assert crc(packet) == 0, packet
            self.reports.append(Report(packet))

    def until(self, wanted):
        """Goes on until wanted() is neither None nor false; that."""
        end = time.monotonic() + PATIENCE_S
        while not (found := wanted()):
            if time.monotonic() > end:
                raise TimeoutError([(each.kind, each.data[:12]) for each in self.reports[-20:]])
            self.step()
        return found

    def go_on(self, seconds):
        end_s = self.client.state["time_s"] + seconds
        self.until(lambda: self.client.state["time_s"] >= end_s)

    def report(self, kind, count):
        return next((each for each in self.reports if each.kind == kind and each.request == count), None)

    def end_of(self, count):
        """The report that ends this telecommand."""
        ends = ((1, 2), (1, 4), (1, 7), (1, 8), (1, 10))
        return self.until(lambda: next(filter(None, (self.report(kind, count) for kind in ends)), None))

    def kinds_of(self, count):
        return [each.kind for each in self.reports if each.kind[0] == 1 and each.request == count]

    def close(self):
        self.read.close()
        self.write.close()


class GroundTest(support.SystemTest):
    def setUp(self):
        self.system = self.enterContext(System())
        self.client = self.system.client(lockstep=True)
        self.client.step()
        self.station = self.station_of()

    def start(self, *words):
        """`liana` with these words and --json; ended when the test ends."""
        process = subprocess.Popen(
            [program("liana"), *map(str, words), "--json"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        return process

    def station_of(self, *words):
        ends = ["--telemetry", "127.0.0.1:0", "--telecommand", "127.0.0.1:0"]
        self.process = self.start("ground", "--api", self.system.api, *ends, *words)
        self.ports = json.loads(self.process.stdout.readline())
        station = Station(self.client, self.ports)
        self.addCleanup(station.close)
        station.until(lambda: any(each.kind == (3, 25) for each in station.reports))  # lianad is there
        return station

    def assert_completed(self, count):
        end = self.station.end_of(count)
        self.assertEqual(end.kind, (1, 7), (end.kind, end.data))

    def enable(self):
        self.client.until(lambda state: state["state"] != "BOOTING" and state["is_homed"])
        self.assert_completed(self.station.function(ACQUIRE, bytes(64)))
        self.assert_completed(self.station.function(ENABLE))
        self.assertEqual(self.client.state["state"], "ENABLED")

    def test_a_connection_test_is_answered_with_all_its_reports(self):
        count = self.station.send(17, 1)
        self.station.end_of(count)
        self.assertEqual(self.station.kinds_of(count), [(1, 1), (1, 3), (1, 7)])
        alive = [each for each in self.station.reports if each.kind == (17, 2)]
        self.assertEqual([each.octets[11:13] for each in alive], [b"\0\7"])  # back to the source
        quiet = self.station.send(17, 1, acknowledge=0)
        self.station.end_of(self.station.send(17, 1))
        self.assertEqual(self.station.kinds_of(quiet), [])

    # req:A21
    def test_the_ground_moves_the_arm_and_hears_of_its_arrival(self):
        self.enable()
        goal_deg = list(self.client.state["setpoint_js_deg"])
        goal_deg[8] -= 1.0
        count = self.station.move(goal_deg, 0.5)
        self.assert_completed(count)
        self.assertEqual(self.station.kinds_of(count), [(1, 1), (1, 3), (1, 7)])
        self.assertEqual(self.client.state["owner"], "ground")
        self.assert_holds(self.client.state)
        self.assertAlmostEqual(self.client.state["setpoint_js_deg"][8], goal_deg[8], places=6)

    # req:A20
    def test_a_refused_motion_fails_with_the_refusal_code(self):
        self.enable()
        count = self.station.move([0.0] * 10)
        end = self.station.end_of(count)
        self.assertEqual((end.kind, end.code), ((1, 8), 207))
        self.assertEqual(self.client.state["verdict"]["code"], 207)
        self.assert_holds(self.client.state)

    def test_an_api_error_is_a_start_failure_with_its_code(self):
        goal_deg = list(self.client.state["setpoint_js_deg"])
        self.assertEqual(self.station.end_of(self.station.move(goal_deg)).code, 2)  # not_owner
        self.enable()
        end = self.station.end_of(self.station.move(goal_deg, 50.0))
        self.assertEqual((end.kind, end.code), ((1, 4), 6))  # out_of_range

    def test_a_hold_ends_the_move_before_it(self):
        self.enable()
        goal_deg = list(self.client.state["setpoint_js_deg"])
        goal_deg[8] -= 6.0
        move = self.station.move(goal_deg)
        self.client.until(lambda state: state["is_busy"])
        self.station.until(lambda: not self.client.state["at_rest"])
        hold = self.station.function(HOLD)
        self.assert_completed(hold)
        end = self.station.end_of(move)
        self.assertEqual((end.kind, end.code), ((1, 8), 33))
        self.assert_holds(self.client.state)

    def test_an_emergency_stop_needs_no_motion_and_is_cleared(self):
        self.enable()
        self.assert_completed(self.station.function(ESTOP, b"test".ljust(200, b"\0")))
        self.assertEqual(self.client.state["stop"]["by"], "ground")
        self.assertNotEqual(self.client.state["state"], "ENABLED")
        self.assert_completed(self.station.function(CLEAR))
        self.assertIsNone(self.client.state["stop"])

    # req:A12
    def test_the_arm_holds_when_the_link_is_lost(self):
        self.enable()
        goal_deg = list(self.client.state["setpoint_js_deg"])
        goal_deg[8] -= 6.0
        move = self.station.move(goal_deg)
        self.station.until(lambda: not self.client.state["at_rest"] and self.station.report((1, 3), move))
        self.station.write.close()
        end = self.station.end_of(move)
        self.assertEqual((end.kind, end.code), ((1, 8), 34))
        self.station.until(lambda: self.client.state["owner"] == "" and self.client.state["at_rest"])
        self.assert_holds(self.client.state)
        gap_deg = abs(self.client.state["setpoint_js_deg"][8] - goal_deg[8])
        self.assertGreater(gap_deg, 1.0)  # it stopped before its goal
        events = [each.data[:2] for each in self.station.reports if each.kind == (5, 3)]
        self.assertIn(struct.pack(">H", 101), events)
        # The owner's end is an event of lianad that the ground receives, although it had left.
        owner = struct.pack(">H", 9)
        self.station.until(
            lambda: any(
                each.kind == (5, 1) and each.data[:2] == owner and each.data[21] == 3 for each in self.reports()
            )
        )

    def reports(self):
        return self.station.reports

    def test_silence_on_the_link_ends_in_the_same_hold(self):
        self.process.kill()
        self.station = self.station_of("--silence-s", "3")
        self.station.pings_every_s = 0.5
        self.enable()
        self.station.go_on(1.0)
        self.assertEqual(self.client.state["owner"], "ground")
        self.station.pings_every_s = 0.0
        self.station.until(lambda: self.client.state["owner"] == "")
        self.assert_holds(self.client.until(lambda state: state["at_rest"]))

    def test_what_is_no_good_telecommand_is_refused_with_its_code(self):
        good = telecommand(1, 17, 1)
        no_data = struct.pack(">HHH", 0x1800 | APID, 0xC000, 1)
        packets = (
            (good[:-1] + bytes([good[-1] ^ 1]), (1, 2), 22),
            (no_data + struct.pack(">H", crc(no_data)), (1, 2), 21),
            (telecommand(2, 17, 1, first=0x0800), (1, 2), 23),
            (telecommand(3, 17, 1, apid=101), (1, 10), 24),
            (telecommand(4, 18, 1), (1, 2), 25),
            (telecommand(5, 17, 9), (1, 2), 25),
            (telecommand(6, 8, 1, b"\0\x63"), (1, 2), 26),
            (telecommand(7, 8, 1), (1, 2), 26),
            (telecommand(8, 3, 5, b"\1\x09"), (1, 2), 26),
            (telecommand(9, 3, 5, b"\2\1"), (1, 2), 27),
            (telecommand(10, 17, 1, b"\0"), (1, 2), 27),
            (telecommand(11, 8, 1, struct.pack(">HB", MISSION, 200)), (1, 2), 27),
            (telecommand(12, 9, 1, b"\x09"), (1, 2), 27),
            (telecommand(13, 15, 9, b"\1\2" + bytes(14)), (1, 2), 26),
        )
        for packet, kind, code in packets:
            with self.subTest(code=code, packet=packet.hex()):
                before = len(self.station.reports)
                self.station.write.sendall(packet)
                failure = self.station.until(
                    lambda: next((each for each in self.reports()[before:] if each.kind in ((1, 2), (1, 10))), None)
                )
                self.assertEqual((failure.kind, failure.code), (kind, code))

    def test_a_stream_without_packets_is_closed_and_a_datagram_is_counted(self):
        self.station.write.sendall(b"\xff" * 100)
        self.assertEqual(self.station.write.recv(1), b"")
        host, port = self.ports["telecommand"].rsplit(":", 1)
        sender = self.enterContext(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        sender.sendto(b"abc", (host, int(port)))
        sender.sendto(telecommand(77, 3, 27, b"\1\5"), (host, int(port)))
        self.assertEqual(self.station.end_of(77).kind, (1, 7))
        counters = next(each for each in self.station.reports if each.kind == (3, 25) and each.data[0] == 5)
        self.assertEqual(struct.unpack(">III", counters.data[1:13]), (1, 0, 2))  # received, rejected, unreadable

    def test_telemetry_goes_by_udp_too(self):
        self.process.kill()
        receiver = self.enterContext(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(PATIENCE_S)
        self.station = self.station_of("--udp-to", f"127.0.0.1:{receiver.getsockname()[1]}")
        count = self.station.send(17, 1)
        self.station.end_of(count)
        kinds = set()
        while (17, 2) not in kinds:
            kinds.add(Report(receiver.recv(65536)).kind)

    def test_stored_telemetry_comes_again_octet_for_octet(self):
        self.station.go_on(2.0)
        self.station.until(lambda: len([each for each in self.reports() if each.kind == (3, 25)]) >= 4)
        sent = [each.octets for each in self.station.reports if each.kind == (3, 25)]
        times = [octets[13:20] for octets in sent]
        before = len(self.station.reports)
        count = self.station.send(15, 9, b"\1\1" + times[0] + times[-1])
        self.station.end_of(count)
        again = [each.octets for each in self.station.reports[before:] if each.octets in sent]
        self.assertEqual(again, sent)

    def test_tshark_reads_every_primary_header(self):
        self.assertIsNotNone(shutil.which("tshark"), "tshark is missing: apt-get install tshark")
        self.station.end_of(self.station.send(17, 1))
        self.assert_completed(self.station.send(9, 1, b"\0"))
        packets = [telecommand(16383, 17, 1), *(each.octets for each in self.station.reports)]
        file = self.system.directory / "packets.pcap"
        file.write_bytes(pcap_of(packets))
        names = ("version", "type", "secheader", "apid", "seqflag", "seqnum", "length")
        fields = [word for name in names for word in ("-e", f"ccsds.{name}")]
        call = ["tshark", "-r", file, "-d", "udp.port==10015,ccsds", "-T", "fields", *fields]
        read = subprocess.run(call, capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(len(read), len(packets))
        for line, packet in zip(read, packets):
            first, second, length = struct.unpack(">HHH", packet[:6])
            head = [first >> 13, first >> 12 & 1, first >> 11 & 1, first & 0x7FF, second >> 14, second & 0x3FFF, length]
            self.assertEqual([int(word) for word in line.split()], head)

    # req:A25
    def test_a_store_behind_a_bad_line_has_every_packet_in_the_end(self):
        line = self.start(
            *("link", "--listen", "127.0.0.1:0", "--to", self.ports["telemetry"], "--seed", 3),
            *("--delay", "0,0.05", "--jitter", 0.9, "--loss", 0.1, "--outage", "2,2"),
        )
        far = json.loads(line.stdout.readline())["listen"]
        file = self.system.directory / "telemetry.db"
        store = self.start("ground", "store", file, "--telemetry", far, "--telecommand", self.ports["telecommand"])
        for structure in (1, 2):
            self.assert_completed(self.station.send(3, 31, bytes([1, structure]) + struct.pack(">I", 5)))
        end = time.monotonic() + 6.0
        while time.monotonic() < end:
            self.station.step()
            time.sleep(0.01)

        def stored():
            if not file.exists():
                return set()
            with contextlib.closing(sqlite3.connect(file)) as database:
                return {row[0] for row in database.execute("SELECT packet FROM packets")}

        first = self.station.until(lambda: next((each for each in self.reports() if each.octets in stored()), None))
        wanted = {each.octets for each in self.reports()[self.reports().index(first) :]}
        self.assertGreater(len(wanted), 50)
        end = time.monotonic() + 90.0
        while wanted - stored() and time.monotonic() < end:
            self.station.step()
            time.sleep(0.05)
        self.assertEqual(len(wanted - stored()), 0)
        store.send_signal(signal.SIGINT)
        counts = json.loads(store.communicate(timeout=PATIENCE_S)[0])
        self.assertGreater(counts["filled"], 10)
        self.assertGreater(counts["questions"], 0)
        shown = subprocess.run(
            [program("liana"), "ground", "show", file, "--name", "joints"], capture_output=True, text=True, check=True
        )
        self.assertGreater(len(shown.stdout.splitlines()), 10)
        for row in map(json.loads, shown.stdout.splitlines()):
            state = self.station.states.get(row["values"]["tick"])
            if state:
                self.assertEqual(row["values"]["setpoint_js_deg"], state["setpoint_js_deg"])

    # req:A21
    def test_an_xtce_walker_reads_what_the_api_says(self):
        text = subprocess.run([program("liana"), "ground", "--xtce"], capture_output=True, text=True, check=True)
        walker = Walker(text.stdout)
        for structure in (3, 4):
            self.assert_completed(self.station.send(3, 5, bytes([1, structure])))
        self.enable()
        self.assert_completed(self.station.send(9, 1, b"\0"))
        self.station.go_on(3.0)
        self.station.until(lambda: any(each.kind == (9, 2) for each in self.reports()))
        names, compared = {}, 0
        for report in self.station.reports:
            name, values = walker.decode(report.octets)
            names[name] = names.get(name, 0) + 1
            if name in ("arm", "joints", "forces", "work"):
                compared += self.assert_as_said(name, values)
        self.assertGreater(compared, 10)
        self.assertLessEqual(
            {"arm", "joints", "forces", "work", "time", "acceptance", "start", "completion", "event_informative"},
            names.keys(),
        )

    def assert_as_said(self, structure, values):
        """Every value of a housekeeping packet is that of the state of its tick, as the API sent it to this test."""
        state = self.station.states.get(values[f"{structure}_tick"])
        if state is None:
            return 0  # of before this test looked
        for name, path in PLACES[structure].items():
            said = state
            for key in path.split("."):
                said = said[key] if isinstance(said, dict) and key in said else None
            if isinstance(said, list):
                own = sorted(key for key in values if key.startswith(f"{structure}_{name}_"))
                if len(said) != 7:  # a pose has axes as names
                    self.assertEqual(len(own), len(said), name)
                axes = (
                    ("x_m", "y_m", "z_m", "qw", "qx", "qy", "qz")
                    if len(said) == 7
                    else [f"{i + 1:02}" for i in range(99)]
                )
                for axis, each in zip(axes, said):
                    self.assertTrue(same(values[f"{structure}_{name}_{axis}"], each), (name, axis, each))
            else:
                self.assertTrue(same(values[f"{structure}_{name}"], said), (name, values[f"{structure}_{name}"], said))
        return 1


PLACES = {
    "arm": {
        **{name: name for name in ("time_s", "state", "stop_category", "is_homed", "is_busy", "at_rest", "owner")},
        **{name: name for name in ("overruns", "refusals", "refused_motions")},
        "verdict_code": "verdict.code",
        "verdict_share": "verdict.share",
        "verdict_sequence": "verdict.sequence",
    },
    "joints": {name: name for name in ("setpoint_js_deg", "measured_js_deg", "setpoint_cp", "measured_cp")},
    "forces": {
        "tension_N": "tension_N",
        "clearance_m": "clearance.distance_m",
        "clearance_bound_m": "clearance.bound_m",
        "clearance_level": "clearance.level",
        "contact_force_N": "contact.force_N",
        "friction_mu": "friction.mu",
    },
    "work": {
        "retract_phase": "retract.phase",
        "retract_points": "retract.points_left",
        "servo_phase": "servo.phase",
        "tool_phase": "tool.phase",
        "device_engaged": "device_engaged",
    },
}


if __name__ == "__main__":
    unittest.main()
