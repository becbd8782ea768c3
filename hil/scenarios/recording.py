"""Reads what `liana-archive` wrote (ticks.mcap, docs/formats.md): the fields of every tick that the rules look at, and
whether the recording is whole.
"""
import collections
import itertools
import json
import math
import operator
import re
import struct

kMagic = b"\x89MCAP0\r\n"
kSchema, kChannel, kMessage, kMetadata, kDataEnd = 0x03, 0x04, 0x05, 0x0C, 0x0F
kMessageHead = 22  # channel, sequence, two times
kName = re.compile(r"(\w+)((?:\[\d+\])*)$")

# Field: its type (struct), and how many of an array's elements belong to this arm ("drives", "thetas"); None: all.
kInputs = {
    "tick": ("Q", 1),
    "lost_ticks": ("I", 1),
    "lost_bus_mask": ("I", 1),
    "request": ("B", 1),
    "telecommand.sequence": ("Q", 1),
    "telecommand.first_tick": ("Q", 1),
    "telecommand.expiry_tick": ("Q", 1),
    "drive.statusword": ("H", "drives"),
    "drive.torque_permille": ("h", "drives"),
    "drive.position_counts": ("i", "drives"),
    "drive.feedback_age_ticks": ("H", "drives"),
    "drive.heartbeat_age_ticks": ("H", "drives"),
    "drive.operational": ("B", "drives"),
}
kOutputs = {
    "state": ("B", 1),
    "stop_category": ("B", 1),
    "at_rest": ("B", 1),
    "active_sequence": ("Q", 1),
    "faults.fault.number": ("H", None),
    "faults.fault.index": ("h", None),
    "faults.fault.detail": ("H", None),
    "faults.fault.tick": ("Q", None),
    "faults.count": ("I", 1),
    "faults.dropped": ("I", 1),
    "drive.controlword": ("H", "drives"),
    "drive.target_counts": ("i", "drives"),
    "theta_rate_rad_s": ("d", "thetas"),
}
kStates = ("DISABLED", "ENABLING", "ENABLED", "STOPPING", "FAULT")
kRequests = ("none", "enable", "disable", "clear", "stop")

Fault = collections.namedtuple("Fault", "number index detail tick")
Tick = collections.namedtuple(
    "Tick",
    (
        "tick lost_ticks lost_buses request sequence first_tick expiry_tick statusword torque position age"
        " heartbeat_age operational state stop_category at_rest active_sequence faults dropped controlword target"
        " theta_rate"
    ),
)


class BadRecording(Exception):
    pass


def offsets(lines):
    """Where each field lies: path without indices -> offsets of its elements; `lines` are a schema's (path, width)."""
    found = collections.defaultdict(list)

    def place(group, at, prefix):
        for head, same in itertools.groupby(group, key=lambda line: line[0][0]):
            same = list(same)
            name, counts = kName.match(head).groups()
            for _ in range(math.prod(map(int, re.findall(r"\d+", counts)))):
                if len(same[0][0]) > 1:
                    at = place([(path[1:], width) for path, width in same], at, f"{prefix}{name}.")
                else:
                    found[prefix + name].append((at, same[0][1]))
                    at += same[0][1]
        return at

    place([(path.split("."), width) for path, width in lines], 0, "")
    return found


class Picker:
    """Takes the wanted fields out of a message."""

    def __init__(self, schema, wanted, sizes):
        places = offsets([(line.rsplit(" ", 1)[0], int(line.rsplit(" ", 1)[1])) for line in schema.split("\n") if line])
        elements = {path: places[path][: sizes.get(size, size)] for path, (_, size) in wanted.items()}
        for path, (kind, _) in wanted.items():
            if {width for _, width in elements[path]} != {struct.calcsize(kind)}:
                raise BadRecording(f"field {path} is not {struct.calcsize(kind)} bytes wide in the recording's schema")
        order = sorted((at, wanted[path][0]) for path in wanted for at, _ in elements[path])
        form, end = "<", 0
        for at, kind in order:
            form += f"{at - end}x{kind}"
            end = at + struct.calcsize(kind)
        self.form = struct.Struct(form)
        rank = {at: i for i, (at, _) in enumerate(order)}
        self.getters = [operator.itemgetter(*(rank[at] for at, _ in elements[path])) for path in wanted]

    def pick(self, data, at):
        """The wanted fields in their order; an array as a tuple."""
        flat = self.form.unpack_from(data, at)
        return [get(flat) for get in self.getters]


def text_at(data, at):
    """A string with its length before it, and where it ends."""
    end = at + 4 + struct.unpack_from("<I", data, at)[0]
    return data[at + 4 : end].decode(), end


def records(data):
    if data[:8] != kMagic:
        raise BadRecording("ticks.mcap is no MCAP file")
    at = len(kMagic)
    while at + 9 <= len(data) and data[at : at + 8] != kMagic:
        opcode, length = data[at], struct.unpack_from("<Q", data, at + 1)[0]
        yield opcode, data[at + 9 : at + 9 + length]
        at += 9 + length


def metadata_of(record):
    name, at = text_at(record, 0)
    end, values = at + 4 + struct.unpack_from("<I", record, at)[0], {}
    at += 4
    while at < end:
        key, at = text_at(record, at)
        values[key], at = text_at(record, at)
    return name, values


class Recording:
    """`ticks` in recorded order; `run`, `end`: its metadata; `whole`: the file has its end record."""

    def __init__(self, path):
        schemas, self.channels, self.pickers = {}, {}, {}
        self.metadata, self.whole, self.ticks = {}, False, []
        inputs = None
        for opcode, record in records(path.read_bytes()):
            if opcode == kSchema:
                self.keep_schema(record, schemas)
            elif opcode == kChannel:
                number, schema = struct.unpack_from("<HH", record)
                self.channels[number] = (text_at(record, 4)[0], schemas[schema])
            elif opcode == kMetadata:
                self.metadata.update([metadata_of(record)])
            elif opcode == kMessage:
                topic = self.channels[struct.unpack_from("<H", record)[0]][0]
                if topic == "inputs":
                    inputs = self.pick(record, kInputs)
                elif topic == "outputs":
                    self.ticks.append(self.tick(inputs, self.pick(record, kOutputs)))
            elif opcode == kDataEnd:
                self.whole = True

    @staticmethod
    def keep_schema(record, schemas):
        number = struct.unpack_from("<H", record)[0]
        _, at = text_at(record, 2)
        _, at = text_at(record, at)
        schemas[number] = text_at(record, at)[0]

    def robot(self):
        return json.loads(self.metadata["run"]["robot"])

    def pick(self, record, wanted):
        number = struct.unpack_from("<H", record)[0]
        if number not in self.pickers:
            robot = self.robot()
            sizes = {"drives": len(robot["drives"]["zero_counts"]), "thetas": 2 * len(robot["segments"])}
            self.pickers[number] = Picker(self.channels[number][1], wanted, sizes)
        return self.pickers[number].pick(record, kMessageHead)

    @staticmethod
    def tick(inputs, outputs):
        (
            state,
            category,
            at_rest,
            active,
            numbers,
            indices,
            details,
            ticks,
            count,
            dropped,
            words,
            targets,
            rates,
        ) = outputs
        faults = tuple(itertools.starmap(Fault, zip(numbers[:count], indices, details, ticks)))
        return Tick(
            *inputs[:3],
            kRequests[inputs[3]],
            *inputs[4:],
            kStates[state],
            category,
            at_rest,
            active,
            faults,
            dropped,
            words,
            targets,
            rates,
        )
