"""Recordings as the reader has to take them, written here byte by byte: plain, in chunks, compressed, cut short."""
import ctypes
import json
import os
import pathlib
import random
import struct
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[4] / "host" / "api" / "python"))

import liana  # noqa: E402
from liana import mcap, recordings  # noqa: E402
from liana.recordings import BadRecording, Mcap, Recording, Truth, read_events  # noqa: E402

ROBOT = {"drives": {"zero_counts": [0, 0]}, "segments": [{}]}


def text(value):
    return struct.pack("<I", len(value.encode())) + value.encode()


def record(opcode, content):
    return struct.pack("<BQ", opcode, len(content)) + content


def schema(number, name, encoding, content):
    data = content if isinstance(content, bytes) else content.encode()
    head = struct.pack("<H", number) + text(name) + text(encoding)
    return record(mcap.SCHEMA, head + struct.pack("<I", len(data)) + data)


def channel(number, topic, encoding, of_schema):
    return record(mcap.CHANNEL, struct.pack("<HH", number, of_schema) + text(topic) + text(encoding) + text(""))


def message(number, data, sequence=0, time_ns=0):
    return record(mcap.MESSAGE, struct.pack("<HIQQ", number, sequence, time_ns, time_ns) + data)


def metadata(name, **values):
    entries = b"".join(text(key) + text(value) for key, value in values.items())
    return record(mcap.METADATA, text(name) + struct.pack("<I", len(entries)) + entries)


def chunk(content, compression, compressed):
    head = struct.pack("<QQQI", 0, 0, len(content), 0) + text(compression) + struct.pack("<Q", len(compressed))
    return record(mcap.CHUNK, head + compressed)


def zstd(content):
    library = ctypes.CDLL("libzstd.so.1")
    library.ZSTD_compress.restype = ctypes.c_size_t
    room = ctypes.create_string_buffer(len(content) + 1000)
    size = library.ZSTD_compress(room, ctypes.c_size_t(len(room)), content, ctypes.c_size_t(len(content)), 3)
    return room.raw[:size]


END = record(mcap.DATA_END, bytes(4))
EVENTS = schema(1, "event", "jsonschema", "{}") + channel(1, "event", "json", 1)


class Files(unittest.TestCase):
    def file(self, *parts):
        path = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "ticks.mcap"
        path.write_bytes(mcap.MAGIC + b"".join(parts) + mcap.MAGIC)
        return path


class Containers(Files):
    def test_messages_of_a_topic_come_in_order_with_their_channel_and_times(self):
        other = channel(2, "other", "x", 0)
        parts = [message(1, b'{"n":1}', 5, 7), message(2, b"?"), message(1, b'{"n":2}', 6, 9)]
        read = Mcap(self.file(EVENTS, other, *parts, END))
        found = list(read.messages("event"))
        self.assertEqual([(one.json()["n"], one.sequence, one.log_time_ns) for one in found], [(1, 5, 7), (2, 6, 9)])
        self.assertEqual(len(list(read.messages())), 3)
        self.assertEqual(read.channels["event"].schema_encoding, "jsonschema")
        self.assertTrue(read.whole)

    def test_what_is_in_chunks_is_read_as_what_is_not_whatever_compressed_it(self):
        content = EVENTS + b"".join(message(1, json.dumps({"n": n}).encode()) for n in range(100))
        for compression, compressed in (("", content), ("zstd", zstd(content))):
            read = Mcap(self.file(metadata("run", seed="1"), chunk(content, compression, compressed), END))
            self.assertEqual([one.json()["n"] for one in read.messages("event")], list(range(100)))
            self.assertEqual((read.metadata, read.whole), ({"run": {"seed": "1"}}, True))

    def test_a_compression_that_is_not_known_and_a_chunk_that_is_damaged_are_refused_by_name(self):
        with self.assertRaisesRegex(BadRecording, "lz4.*zstd and none"):
            Mcap(self.file(chunk(EVENTS, "lz4", EVENTS)))
        with self.assertRaisesRegex(BadRecording, "not .* bytes of zstd"):
            Mcap(self.file(chunk(EVENTS, "zstd", b"\1" + zstd(EVENTS)[1:])))

    def test_what_is_no_recording_and_what_is_no_json_is_refused(self):
        path = self.file()
        path.write_bytes(b"something else")
        with self.assertRaisesRegex(BadRecording, "no MCAP file"):
            Mcap(path)
        read = Mcap(self.file(channel(2, "exact", "liana-fields-1", 0), message(2, b"\1"), END))
        with self.assertRaisesRegex(BadRecording, "exact is liana-fields-1"):
            next(read.messages("exact")).json()

    def test_a_file_cut_short_anywhere_has_its_whole_records_and_is_said_not_to_be_whole(self):
        path = self.file(EVENTS, message(1, b'{"n":1}'), message(1, b'{"n":2}'), END)
        content = path.read_bytes()
        end = len(content) - len(mcap.MAGIC) - len(END)
        for length in range(len(mcap.MAGIC), end):
            path.write_bytes(content[:length])
            read = Mcap(path)
            self.assertFalse(read.whole)
            self.assertLessEqual(len(list(read.messages())), 1)


class Foreign(Files):
    """Files of other programs, and files that are damaged: read, or refused by BadRecording."""

    def test_a_schema_that_is_no_text_stays_bytes_and_its_messages_are_read(self):
        descriptor = b"\n\xff\xfe\x80 a descriptor of protobuf"
        pose = schema(1, "Pose", "protobuf", descriptor) + channel(1, "/pose", "protobuf", 1)
        read = Mcap(self.file(pose, message(1, b"\x08\x96\x01"), END))
        found = read.channels["/pose"]
        self.assertEqual((found.schema_encoding, found.schema, found.schema_data), ("protobuf", "", descriptor))
        self.assertEqual([bytes(one.data) for one in read.messages("/pose")], [b"\x08\x96\x01"])

    def refused(self, *parts):
        path = self.file(*parts)
        with self.assertRaises(BadRecording) as caught:
            for one in Mcap(path).messages():
                one.json()
        return str(caught.exception)

    def test_what_no_writer_makes_is_refused_and_takes_no_memory(self):
        nested = EVENTS
        for _ in range(3000):
            nested = chunk(nested, "", nested) if len(nested) < 1 << 20 else nested
        head = struct.pack("<QQQI", 0, 0, 1 << 60, 0) + text("zstd")
        for part in (
            nested,
            record(mcap.CHUNK, head + struct.pack("<Q", 4) + bytes(4)),
            record(mcap.CHUNK, b"short"),
            channel(1, "x", "json", 7),
            message(9, b"of no channel"),
            record(mcap.MESSAGE, b"?"),
            EVENTS + message(1, b"[" * 100000),
            EVENTS + message(1, b"\xff"),
            record(mcap.METADATA, text("run") + struct.pack("<I", 1 << 31)),
            record(mcap.SCHEMA, struct.pack("<H", 1) + struct.pack("<I", 1 << 31)),
        ):
            self.refused(part, END)

    def test_bytes_changed_at_random_are_read_or_refused(self):
        content = EVENTS + b"".join(message(1, json.dumps({"n": n}).encode()) for n in range(20))
        run = metadata("run", robot=json.dumps(ROBOT), period_s="0.004")
        path = self.file(run, chunk(content, "zstd", zstd(content)), content, END)
        whole, draw, refused = path.read_bytes(), random.Random(5), 0
        for _ in range(1500):
            damaged = bytearray(whole)
            for _ in range(draw.randint(1, 4)):
                damaged[draw.randrange(8, len(whole))] = draw.randrange(256)
            path.write_bytes(damaged[: draw.choice((len(whole), draw.randrange(8, len(whole))))])
            try:
                read = Recording(path)
                for one in read.messages("event"):
                    one.json()
                read.ticks
            except BadRecording as error:
                self.assertTrue(str(error))
                refused += 1
        self.assertGreater(refused, 100)

    def test_what_is_no_file_is_refused_at_once(self):
        folder = self.file().parent
        os.mkfifo(folder / "pipe")
        for path in (folder, folder / "pipe", folder / "nothing", pathlib.Path("/dev/zero")):
            for read in (Mcap, Truth, read_events):
                with self.assertRaisesRegex(BadRecording, str(path)):
                    read(path)

    def test_a_recording_without_its_run_says_what_it_lacks(self):
        read = Recording(self.file(EVENTS, END))
        for ask in (read.robot, lambda: read.period_s, read.arrays):
            with self.assertRaises(liana.LianaError):
                ask()

    def test_arrays_without_numpy_say_what_to_install(self):
        with mock.patch.dict(sys.modules, {"numpy": None}), self.assertRaisesRegex(liana.LianaError, "python3-numpy"):
            Recording(self.file(END)).arrays()

    def test_a_truth_that_is_damaged_is_refused(self):
        path = self.file()
        for content in (
            b"",
            b"no end of line",
            b"{}\n",
            b'{"columns": 3}\n',
            b'{"columns": []}\n1',
            b"[" * 99999 + b"\n",
        ):
            path.write_bytes(content)
            with self.assertRaises(BadRecording):
                Truth(path)


def fields(wanted, arrays):
    """A schema of all wanted fields, with places for three drives and thetas, and the bytes of one message."""
    lines, data, structures = [], b"", {}
    for path, (kind, size) in wanted.items():
        prefix, _, name = path.rpartition(".")
        structures.setdefault(prefix, []).append((name, kind, size, arrays.get(path, (0, 0, 0))))
    for prefix, members in structures.items():
        is_array = prefix in ("drive", "faults.fault")
        head = f"{prefix}[3]." if is_array else f"{prefix}." if prefix else ""
        for name, kind, size, _ in members:
            many = "[3]" if not is_array and size != 1 else ""
            lines.append(f"{head}{name}{many} {struct.calcsize(kind)}")
        for row in range(3 if is_array else 1):
            for name, kind, size, values in members:
                count = 1 if is_array or size == 1 else 3
                data += struct.pack(f"<{count}{kind}", *values[row : row + count])
    return "\n".join(lines) + "\n", data


class Ticks(Files):
    def recording(self, inputs, outputs, robot=ROBOT):
        parts = [metadata("run", robot=json.dumps(robot))]
        for number, (topic, (lines, data)) in enumerate((("inputs", inputs), ("outputs", outputs)), 1):
            parts += [schema(number, topic, "liana-fields-1", lines), channel(number, topic, "liana-fields-1", number)]
            parts.append(message(number, data))
        return Recording(self.file(*parts, END))

    def test_a_tick_has_what_was_recorded_of_the_drives_that_the_robot_has(self):
        inputs = {"tick": (42,), "request": (3,), "drive.statusword": (0x1237, 0x0250, 9)}
        outputs = {
            "state": (4,),
            "faults.count": (1,),
            "faults.fault.number": (3002, 7, 7),
            "faults.fault.index": (-1, 0, 0),
            "faults.fault.tick": (40, 0, 0),
            "drive.target_counts": (-5, 6, 7),
            "theta_rate_rad_s": (0.5, -0.25, 9.0),
        }
        read = self.recording(fields(recordings.INPUTS, inputs), fields(recordings.outputs_of(ROBOT), outputs))
        self.assertEqual(len(read.ticks), 1)
        tick = read.ticks[0]
        self.assertEqual((tick.tick, tick.request, tick.state), (42, "clear", "FAULT"))
        self.assertEqual((tick.statusword, tick.target, tick.theta_rate), ((0x1237, 0x0250), (-5, 6), (0.5, -0.25)))
        self.assertEqual(tick.faults, (recordings.Fault(3002, -1, 0, 40),))

    def test_an_arm_with_one_drive_has_arrays_of_one(self):
        robot = {"drives": {"zero_counts": [0]}, "segments": [{}]}
        inputs = fields(recordings.INPUTS, {"drive.position_counts": (17, 2, 3)})
        tick = self.recording(inputs, fields(recordings.outputs_of(robot), {}), robot).ticks[0]
        self.assertEqual((tick.position, tick.tick), ((17,), 0))

    def test_tension_is_torque_over_the_radius_of_the_drum(self):
        drives = {"zero_counts": [0, 0], "rated_torque_Nm": 9, "drum_radius_m": 0.015}
        inputs = fields(recordings.INPUTS, {"drive.torque_permille": (500, -10, 7)})
        robot = {**ROBOT, "drives": drives}
        read = self.recording(inputs, fields(recordings.outputs_of(robot), {}), robot)
        self.assertEqual(read.tension_N(read.ticks[0]), (300.0, -6.0))

    def test_a_state_that_there_is_not_and_a_schema_without_end_are_refused(self):
        inputs, outputs = fields(recordings.INPUTS, {}), fields(recordings.outputs_of(ROBOT), {"state": (200,)})
        with self.assertRaises(BadRecording):
            self.recording(inputs, outputs).ticks
        for lines in ("tick[999999999] 8\n", "a." * 5000 + "b 8\n", "tick eight\n", "tick\n"):
            with self.assertRaises(BadRecording):
                self.recording((lines, inputs[1]), outputs).ticks

    def test_of_a_serial_arm_a_tick_has_the_rates_of_its_joints(self):
        robot = {"kind": "serial", "drives": {"zero_counts": [0, 0]}, "joints": [{}, {}, {}]}
        outputs = {"state": (2,), "drive.target_counts": (-5, 6, 7), "joint_rate_rad_s": (0.5, -0.25, 0.125)}
        written = fields(recordings.outputs_of(robot), outputs)
        tick = self.recording(fields(recordings.INPUTS, {"tick": (42,)}), written, robot).ticks[0]
        self.assertEqual((tick.state, tick.target, tick.theta_rate), ("ENABLED", (-5, 6), (0.5, -0.25, 0.125)))

    def test_a_field_of_another_width_is_refused_by_name(self):
        inputs, outputs = fields(recordings.INPUTS, {}), fields(recordings.outputs_of(ROBOT), {})
        changed = inputs[0].replace("tick 8", "tick 4"), inputs[1]
        with self.assertRaisesRegex(BadRecording, "tick.*8 bytes"):
            self.recording(changed, outputs).ticks

    def test_a_schema_that_is_none_is_refused(self):
        inputs, outputs = fields(recordings.INPUTS, {}), fields(recordings.outputs_of(ROBOT), {})
        with self.assertRaisesRegex(BadRecording, "field ,"):
            self.recording(("tick..x 8\n", inputs[1]), outputs).ticks

    def test_a_run_that_never_ticked_has_no_ticks(self):
        self.assertEqual(Recording(self.file(END)).ticks, [])


class Events(Files):
    def read(self, *lines):
        path = self.file()
        path.write_bytes("\n".join(lines).encode())
        return read_events(path)

    def test_a_line_is_an_event_and_a_comment_is_none(self):
        line = "      12\t   4.936\t    1234\tverdict     \t   104\texecution\t"
        line += "cable 7 \u2028\x85: too fast\tcommand=17 share=nan"
        (event,) = self.read("#sequence\ttime_s", line, "# 3 events are missing so far", "      13\t 4.9")
        self.assertEqual(event[:6], (12, 4.936, 1234, "verdict", 104, "execution"))
        self.assertEqual(event.text, "cable 7 \u2028\x85: too fast")
        self.assertEqual(event.values["command"], 17)
        self.assertNotEqual(event.values["share"], event.values["share"])

    def test_what_is_no_event_is_refused_by_its_line(self):
        for line in (
            "hello",
            "1\t2\t3\tstop\tfour\tx\ty\t",
            "1\t2\t3\tstop\t4\tx\ty\tz",
            "1\t2\t3\tstop\t4\tx\ty\tz=z",
        ):
            with self.assertRaises(BadRecording) as caught:
                self.read(line, "")
            self.assertIn(line[:5], str(caught.exception).replace("\\t", "\t"))


class Truths(Files):
    def test_rows_are_read_until_the_last_whole_one_and_travel_is_the_largest_change(self):
        columns = ["slot", *(f"theta_deg_{n}" for n in range(1, 11))]
        rows = [[slot, *[0.0] * 8, (0.0, 1.0, -2.0)[slot], 0.5] for slot in range(3)]
        path = self.file()
        data = b"".join(struct.pack("<11d", *row) for row in rows)
        path.write_bytes(json.dumps({"columns": columns}).encode() + b"\n" + data + b"half a row")
        truth = Truth(path)
        self.assertEqual(truth.column("slot"), [0.0, 1.0, 2.0])
        self.assertEqual(
            (truth.travel_deg(0, 2), truth.travel_deg(0, None), truth.travel_deg(1, None)), (1.0, 2.0, 3.0)
        )

    def test_travel_of_a_serial_arm_is_of_its_joints_and_of_nothing_else(self):
        columns = ["slot", *(f"joint_deg_{n}" for n in range(1, 8)), "tip_x_m"]
        rows = [[slot, *[0.0] * 6, 0.5 * slot, 100.0 * slot] for slot in range(3)]
        path = self.file()
        data = b"".join(struct.pack("<9d", *row) for row in rows)
        path.write_bytes(json.dumps({"columns": columns}).encode() + b"\n" + data)
        truth = Truth(path)
        self.assertEqual((truth.theta_deg(1), truth.travel_deg(0, None)), ((0.0,) * 6 + (0.5,), 1.0))


if __name__ == "__main__":
    unittest.main(verbosity=2)
