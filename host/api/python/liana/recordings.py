"""What a run leaves behind (docs/reference/formats.md): recordings (ticks.mcap) tick by tick, the bench's truth,
events. Arrays of numpy are there where numpy is.
"""
from __future__ import annotations

import collections
import functools
import itertools
import json
import math
import operator
import re
import struct
from typing import Any, Callable, Iterable, NamedTuple, Optional, Sequence, Union

from liana.client import LianaError, Path
from liana.mcap import BadRecording, Bytes, Mcap, content_of, reading

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
REQUESTS = ("none", "enable", "disable", "clear", "stop", "recover")
FIELD_NAME = re.compile(r"(\w+)((?:\[\d+\])*)$")
MAX_ELEMENTS = 1 << 20  # of all fields of a schema


class Fault(NamedTuple):
    """A latched fault (docs/reference/faults.md)."""

    number: int  # such as 3002
    index: int  # type: ignore[assignment]  # of drive or bus, from 0, -1: none; hides the tuple's own index()
    detail: int  # what it means depends on the number
    tick: int  # in which it was latched


class Event(NamedTuple):
    """Why something happened: a line of events.txt. The kinds, and what they number: docs/reference/formats.md,
    Events.
    """

    sequence: int  # 1, 2, ... without gaps
    time_s: float  # seconds of arm time
    tick: int  # when lianad noted it
    kind: str  # such as fault, refusal, verdict
    number: int  # of the fault or refusal; 0: none
    subject: str  # what it is about
    text: str  # for people
    values: dict[str, float]  # by name; the page has their units


def read_events(path: Path) -> list[Event]:
    """The events of a run's events.txt, without a last line that has no end; BadRecording for a line that is none."""
    events = []
    for line in content_of(path).decode(errors="replace").split("\n")[:-1]:
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
    """One tick of the core: what it was told and what it did. Arrays have an element for each drive, rates one for each
    theta, or joint of a serial arm. A tick is Recording.period_s long. Recording.tension_N gives newtons.
    """

    tick: int  # counts from the start of lianad
    lost_ticks: int  # ticks that were missed before this one
    lost_buses: int  # bit mask
    twice: int  # bit mask: drives under whose identifiers somebody else speaks
    request: str  # of REQUESTS
    sequence: int  # of the telecommand that is offered
    first_tick: int  # in which it may act
    expiry_tick: int  # from which on it may not
    statusword: Sequence[int]  # CiA 402, object 6041
    torque: Sequence[int]  # permille of the rated torque, object 6077
    position: Sequence[int]  # counts of the encoder, object 6064
    age: Sequence[int]  # ticks since the drive's last report
    heartbeat_age: Sequence[int]  # ticks since its last heartbeat
    operational: Sequence[int]  # 1: its network state is operational
    state: str  # of STATES
    stop_category: int  # 0: none
    at_rest: int  # 1: nothing moves
    active_sequence: int  # of the telecommand in force; 0: none
    faults: Sequence[Fault]
    dropped: int  # faults for which there was no place
    controlword: Sequence[int]  # CiA 402, object 6040
    target: Sequence[int]  # counts of the encoder, object 607A
    theta_rate: Sequence[float]  # rad/s


# What Recording.arrays has of the fields of Tick, with their units.
COLUMNS = {
    "tick": "tick",
    "state": "state",
    "request": "request",
    "stop_category": "stop_category",
    "at_rest": "at_rest",
    "sequence": "active_sequence",
    "statusword": "statusword",
    "controlword": "controlword",
    "torque_permille": "torque",
    "position_counts": "position",
    "target_counts": "target",
    "age_ticks": "age",
    "theta_rate_rad_s": "theta_rate",
}


def numpy() -> Any:
    """The module, where it is installed; LianaError where it is not."""
    try:
        import numpy as module  # only here: everything else does without
    except ImportError as error:
        raise LianaError(f"arrays need numpy, which is not there ({error}): install python3-numpy") from error
    return module


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
            count = math.prod(map(int, re.findall(r"\d+", counts)))
            if count * len(fields) > MAX_ELEMENTS or sum(map(len, found.values())) > MAX_ELEMENTS:
                raise BadRecording(f"the schema's field {head} makes more than {MAX_ELEMENTS} elements")
            for _ in range(count):
                if len(fields[0][0]) > 1:
                    at = place([(path[1:], width) for path, width in fields], at, f"{prefix}{name}.")
                else:
                    found[prefix + name].append((at, fields[0][1]))
                    at += fields[0][1]
        return at

    place([(path.split("."), width) for path, width in lines], 0, "")
    return found


def getter(ranks: Sequence[int], is_array: bool) -> Callable[[Sequence[Any]], Any]:
    """Takes these elements, an array as a tuple also where it has one element."""
    if is_array and len(ranks) == 1:
        return operator.itemgetter(slice(ranks[0], ranks[0] + 1))
    return operator.itemgetter(*ranks)


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
        ranks = [[rank[at] for at, _ in elements[path]] for path in wanted]
        self.getters = [getter(each, wanted[path][1] != 1) for path, each in zip(wanted, ranks)]

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
        with reading(f"{self.path}: the robot table"):
            robot: dict[str, Any] = json.loads(self._run("robot"))
            return robot

    @functools.cached_property
    def period_s(self) -> float:
        """Length of a tick, in seconds."""
        with reading(f"{self.path}: the length of a tick"):
            return float(self._run("period_s"))

    def _run(self, name: str) -> str:
        if name not in self.metadata.get("run", {}):
            raise BadRecording(f"{self.path}: has no {name} of a run: give ticks.mcap of a run's folder")
        return self.metadata["run"][name]

    @functools.cached_property
    def ticks(self) -> list[Tick]:
        """Every tick in recorded order; read once, about 20 us each."""
        found, inputs = [], []
        with reading(self.path):
            for message in self.messages("inputs", "outputs"):
                if message.channel.topic == "inputs":
                    inputs = self._inputs.pick(message.data)
                else:
                    found.append(tick_of(inputs, self._outputs.pick(message.data)))
        return found

    @functools.cached_property
    def N_per_permille(self) -> float:
        """Tension of a cable, in newtons, at one permille of its drive's rated torque; BadRecording for a serial arm."""
        robot = self.robot()
        if is_serial(robot):
            raise BadRecording(f"{self.path}: a serial arm has no cables: take torque_Nm of arrays()")
        with reading(f"{self.path}: the robot table's drives"):
            return float(robot["drives"]["rated_torque_Nm"]) / float(robot["drives"]["drum_radius_m"]) / 1000.0

    def tension_N(self, tick: Tick) -> tuple[float, ...]:
        """Tension of each cable at its drum by the drive's torque, in newtons, as lianad measures it without load
        cells. Drives of a base that feeds have a force and a torque at the same scale."""
        return tuple(self.N_per_permille * torque for torque in tick.torque)

    def arrays(self) -> dict[str, Any]:
        """All ticks as arrays of numpy, a row for each tick and a column for each drive or angle: `time_s`, the names
        of COLUMNS, and `tension_N` of a cable arm (newtons) or `torque_Nm` of a serial one."""
        np, ticks = numpy(), self.ticks
        with reading(self.path):
            found = {name: np.array([getattr(tick, field) for tick in ticks]) for name, field in COLUMNS.items()}
            found["time_s"] = found["tick"] * self.period_s
            drives = self.robot()["drives"]
            if is_serial(self.robot()):
                found["torque_Nm"] = found["torque_permille"] * (np.array(drives["rated_torque_Nm"]) / 1000.0)
            else:
                found["tension_N"] = found["torque_permille"] * self.N_per_permille
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
    """truth.bin of the bench: one row for each slot of the bus. `columns` names what is in it, with units (`_m`, `_N`,
    `_deg`), such as `tension_motor_max_N`: the largest tension of any cable at its drum, in newtons."""

    def __init__(self, path: Path) -> None:
        data = content_of(path)
        with reading(path):
            end = data.index(b"\n") + 1
            self.columns: list[str] = list(map(str, json.loads(data[:end])["columns"]))
            form = struct.Struct(f"<{len(self.columns)}d")
            whole = (len(data) - end) // form.size  # a run that was killed may leave a part of a row
            self.rows = [form.unpack_from(data, end + i * form.size) for i in range(whole)]

    @functools.cached_property
    def _angles(self) -> slice:
        found = [i for i, name in enumerate(self.columns) if ANGLE_COLUMN.fullmatch(name)]
        return slice(found[0], found[-1] + 1)

    def column(self, name: str) -> list[float]:
        """One quantity over all slots; the unit ends its name. LianaError for a name that is not in `columns`."""
        if name not in self.columns:
            raise LianaError(f"{name}: allowed {', '.join(self.columns)}")
        i = self.columns.index(name)
        return [row[i] for row in self.rows]

    def arrays(self) -> dict[str, Any]:
        """All columns as arrays of numpy, by name."""
        np = numpy()
        return dict(zip(self.columns, np.array(self.rows, dtype=float).reshape(-1, len(self.columns)).T))

    def theta_deg(self, row: int) -> tuple[float, ...]:
        """The ten thetas of a row; of a serial arm its joints."""
        return self.rows[row][self._angles]

    def travel_deg(self, first: int, last: Optional[int]) -> float:
        """Largest change of any theta or joint between the row `first` and any row until before `last`."""
        start = self.theta_deg(first)
        rows = range(len(self.rows))[first:last]
        return max(abs(a - b) for row in rows for a, b in zip(self.theta_deg(row), start))
