"""What a run leaves behind (docs/reference/formats.md): recordings (ticks.mcap) tick by tick, the bench's truth,
events.
"""
from __future__ import annotations

import collections
import functools
import itertools
import json
import math
import operator
import pathlib
import re
import struct
from typing import Any, Iterable, NamedTuple, Optional, Sequence, Union

from liana.client import Path
from liana.mcap import BadRecording, Bytes, Mcap

__all__ = ["BadRecording", "Event", "Fault", "Mcap", "Recording", "Tick", "Truth", "offsets", "read_events"]

# Field: its type (struct), and how many of an array's elements belong to this arm ("drives", "angles"); None: all.
Wanted = dict[str, tuple[str, Union[int, str, None]]]
INPUTS: Wanted = {
    "tick": ("Q", 1),
    "lost_ticks": ("I", 1),
    "lost_bus_mask": ("I", 1),
    "twice_mask": ("I", 1),
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
OUTPUTS: Wanted = {
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
}
ANGLE_COLUMN = re.compile(r"(?:theta|joint)_deg_\d+")  # of truth.bin
STATES = ("DISABLED", "ENABLING", "ENABLED", "STOPPING", "FAULT")
REQUESTS = ("none", "enable", "disable", "clear", "stop")
FIELD_NAME = re.compile(r"(\w+)((?:\[\d+\])*)$")


class Fault(NamedTuple):
    """A latched fault; numbers are those of docs/reference/faults.md, `tick` is when it was latched."""

    number: int
    index: int  # type: ignore[assignment]  # of drive or bus; hides the tuple's own index()
    detail: int
    tick: int


class Event(NamedTuple):
    """Why something happened: a line of events.txt. The kinds, and what they number: docs/reference/formats.md,
    Events.
    """

    sequence: int  # 1, 2, ... without gaps
    time_s: float  # arm time
    tick: int
    kind: str
    number: int
    subject: str
    text: str
    values: dict[str, float]


def read_events(path: Path) -> list[Event]:
    """The events of a run's events.txt, without a last line that has no end; BadRecording for a line that is none."""
    events = []
    for line in pathlib.Path(path).read_text(errors="replace").split("\n")[:-1]:
        if line.startswith("#"):
            continue
        try:
            sequence, time_s, tick, kind, number, subject, text, values = line.split("\t")
            figures = {name: float(value) for name, value in (pair.split("=") for pair in values.split())}
            head = (int(sequence), float(time_s), int(tick), kind.strip(), int(number))
        except ValueError as error:
            raise BadRecording(f"{path}: {line!r} is no event: {error}") from error
        events.append(Event(*head, subject, text, figures))
    return events


class Tick(NamedTuple):
    """One tick of the core: what it was told and what it did. Arrays have an element per drive, rates one per theta, or
    joint of a serial arm.
    """

    tick: int
    lost_ticks: int
    lost_buses: int  # bit mask
    twice: int  # bit mask: drives under whose identifiers somebody else speaks
    request: str  # of REQUESTS
    sequence: int  # of the telecommand that is offered
    first_tick: int  # in which it may act
    expiry_tick: int  # from which on it may not
    statusword: Sequence[int]
    torque: Sequence[int]  # permille of the rated one
    position: Sequence[int]  # counts
    age: Sequence[int]  # ticks since the drive's last report
    heartbeat_age: Sequence[int]  # ticks
    operational: Sequence[int]
    state: str  # of STATES
    stop_category: int
    at_rest: int
    active_sequence: int  # of the telecommand in force; 0: none
    faults: Sequence[Fault]
    dropped: int  # faults for which there was no place
    controlword: Sequence[int]
    target: Sequence[int]  # counts
    theta_rate: Sequence[float]  # rad/s


def offsets(lines: Iterable[tuple[str, int]]) -> dict[str, list[tuple[int, int]]]:
    """Where each field lies: path without indices -> (offset, width) of its elements; `lines`: (path, width)."""
    found: dict[str, list[tuple[int, int]]] = collections.defaultdict(list)

    def place(group: list[tuple[list[str], int]], at: int, prefix: str) -> int:
        for head, same in itertools.groupby(group, key=lambda line: line[0][0]):
            fields = list(same)
            match = FIELD_NAME.match(head)
            if match is None:
                raise BadRecording(f"the schema has a field {head}, which is no name")
            name, counts = match.groups()
            for _ in range(math.prod(map(int, re.findall(r"\d+", counts)))):
                if len(fields[0][0]) > 1:
                    at = place([(path[1:], width) for path, width in fields], at, f"{prefix}{name}.")
                else:
                    found[prefix + name].append((at, fields[0][1]))
                    at += fields[0][1]
        return at

    place([(path.split("."), width) for path, width in lines], 0, "")
    return found


class Picker:
    """Takes the wanted fields out of a message."""

    def __init__(self, schema: str, wanted: Wanted, sizes: dict[str, int]) -> None:
        lines = [line.rsplit(" ", 1) for line in schema.split("\n") if line]
        places = offsets([(path, int(width)) for path, width in lines])
        many = {path: sizes[size] if isinstance(size, str) else size for path, (_, size) in wanted.items()}
        elements = {path: places[path][: many[path]] for path in wanted}
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

    def pick(self, data: Bytes) -> list[Any]:
        """The wanted fields in their order; an array as a tuple."""
        if len(data) < self.form.size:  # fields that are not there, as of no telecommand, are zero
            data = bytes(data).ljust(self.form.size, b"\0")
        flat = self.form.unpack_from(data)
        return [get(flat) for get in self.getters]


class Recording(Mcap):
    """ticks.mcap of a run; what else is in it (`channels`, `messages()`) is there as in every MCAP file."""

    def robot(self) -> dict[str, Any]:
        """The robot table that was recorded with."""
        robot: dict[str, Any] = json.loads(self.metadata["run"]["robot"])
        return robot

    @functools.cached_property
    def ticks(self) -> list[Tick]:
        """Every tick in recorded order; read once, about 20 us each."""
        found, inputs = [], []
        for message in self.messages("inputs", "outputs"):
            if message.channel.topic == "inputs":
                inputs = self._inputs.pick(message.data)
            else:
                found.append(tick_of(inputs, self._outputs.pick(message.data)))
        return found

    @functools.cached_property
    def _inputs(self) -> Picker:
        return Picker(self.channels["inputs"].schema, INPUTS, self._sizes())

    @functools.cached_property
    def _outputs(self) -> Picker:
        return Picker(self.channels["outputs"].schema, outputs_of(self.robot()), self._sizes())

    def _sizes(self) -> dict[str, int]:
        robot = self.robot()
        angles = len(robot["joints"]) if is_serial(robot) else 2 * (len(robot["segments"]) + ("base" in robot))
        return {"drives": len(robot["drives"]["zero_counts"]), "angles": angles}


def is_serial(robot: dict[str, Any]) -> bool:
    """True for the table of a serial arm."""
    return robot.get("kind") == "serial"


def outputs_of(robot: dict[str, Any]) -> Wanted:
    """OUTPUTS, and the rates of this arm's angles."""
    return {**OUTPUTS, "joint_rate_rad_s" if is_serial(robot) else "theta_rate_rad_s": ("d", "angles")}


def tick_of(inputs: list[Any], outputs: list[Any]) -> Tick:
    """One tick of the fields of INPUTS and outputs_of(), in their order."""
    state, category, at_rest, active, numbers, indices, details, ticks, count, dropped, *commands = outputs
    faults = tuple(itertools.starmap(Fault, zip(numbers[:count], indices, details, ticks)))
    asked = (*inputs[:4], REQUESTS[inputs[4]], *inputs[5:])
    return Tick._make((*asked, STATES[state], category, at_rest, active, faults, dropped, *commands))


class Truth:
    """truth.bin of the bench: one row per slot, `columns` names what is in it."""

    def __init__(self, path: Path) -> None:
        data = pathlib.Path(path).read_bytes()
        end = data.index(b"\n") + 1
        self.columns: list[str] = json.loads(data[:end])["columns"]
        form = struct.Struct(f"<{len(self.columns)}d")
        whole = (len(data) - end) // form.size  # a run that was killed may leave a part of a row
        self.rows = [form.unpack_from(data, end + i * form.size) for i in range(whole)]

    @functools.cached_property
    def _angles(self) -> slice:
        found = [i for i, name in enumerate(self.columns) if ANGLE_COLUMN.fullmatch(name)]
        return slice(found[0], found[-1] + 1)

    def column(self, name: str) -> list[float]:
        """One quantity over all slots."""
        i = self.columns.index(name)
        return [row[i] for row in self.rows]

    def theta_deg(self, row: int) -> tuple[float, ...]:
        """The ten thetas of a row; of a serial arm its joints."""
        return self.rows[row][self._angles]

    def travel_deg(self, first: int, last: Optional[int]) -> float:
        """Largest change of any theta or joint between the row `first` and any row until before `last`."""
        start = self.theta_deg(first)
        rows = range(len(self.rows))[first:last]
        return max(abs(a - b) for row in rows for a, b in zip(self.theta_deg(row), start))
