"""What tshark, a decoder that is not ours, reads in the bus logs of a run. Each gives a list of complaints, empty when
all is well.
"""
import collections
import pathlib
import re
import shutil
import subprocess
import tempfile

from liana.drive_names import drive_text

NMT, SYNC, PDOS = 0, 0x80, range(0x181, 0x580)  # identifiers
RESETS, START = (129, 130), 1  # NMT commands: reset node, reset communication; start
BOOT_UP, OPERATIONAL = 0, 5  # states in the heartbeat
IDENTITY = 0x1018

FRAME = re.compile(r" ([0-9A-F]+)#([0-9A-F]*)$")
# One decoded frame: line of the log, CAN identifier, NMT command and its node, state in a heartbeat, object of an SDO,
# whether no such frame exists.
Frame = collections.namedtuple("Frame", "line identifier command node state object malformed", defaults=[False])
FIELDS = (
    "can.id",
    "canopen.nmt_ctrl.cd",
    "canopen.nmt_ctrl.node_id",
    "canopen.nmt_guard.state",
    "canopen.sdo.main_idx",
    "_ws.malformed",
)


def tshark(log, *words):
    """Lines of its output; ValueError when it cannot read the log."""
    if shutil.which("tshark") is None:
        raise ValueError("tshark is missing: apt-get install tshark")
    done = subprocess.run(
        ["tshark", "-r", str(log), "-d", "can.subdissector,canopen", *words],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        raise ValueError(f"tshark cannot read {log.name}: {done.stderr.strip()}")
    return done.stdout.splitlines()


def telling(lines):
    """The lines of a log, with their numbers, that say something new to who decodes them: of SYNC and PDOs, which differ
    in numbers alone, the first of each identifier and length after every NMT command.
    """
    seen = set()
    for place, line in enumerate(lines, 1):
        frame = FRAME.search(line)
        identifier = int(frame[1], 16) if frame else None
        if identifier == NMT:
            seen.clear()
        elif identifier == SYNC or identifier in PDOS:
            if (identifier, len(frame[2])) in seen:
                continue
            seen.add((identifier, len(frame[2])))
        yield place, line


def decoded(log):
    """The telling frames of a log."""
    found = list(telling(log.read_text().splitlines()))
    words = [word for field in FIELDS for word in ("-e", field)]
    with tempfile.TemporaryDirectory() as folder:
        short = pathlib.Path(folder) / log.name
        short.write_text("".join(f"{line}\n" for _, line in found))
        rows = tshark(short, "-T", "fields", "-E", "separator=;", *words)
    if len(rows) != len(found):
        raise ValueError(f"tshark reads {len(rows)} frames of {len(found)} in {log.name}")
    return [Frame(place, *fields_of(row)) for (place, _), row in zip(found, rows)]


def fields_of(row):
    *numbers, malformed = row.split(";")
    return [int(text, 0) if text else None for text in numbers] + [malformed != ""]


def malformed(name, frames):
    """Every frame is one that CANopen knows."""
    found = [frame.line for frame in frames if frame.malformed]
    return [f"{name}: {len(found)} malformed frames, the first in line {found[0]}"] if found else []


def of_node(frames, node):
    """What concerns one node, in the order of the wire: (step, line)."""
    for frame in frames:
        if frame.command is not None and frame.node in (0, node):
            if frame.command in RESETS:
                yield "reset", frame
            elif frame.command == START:
                yield "start", frame
        elif frame.identifier == 0x700 + node:
            if frame.state in (BOOT_UP, OPERATIONAL):
                yield "boot-up" if frame.state == BOOT_UP else "operational", frame
        elif frame.identifier in (0x580 + node, 0x600 + node):
            yield "SDO", frame
        elif frame.identifier in (0x180 + node, 0x200 + node):
            yield "PDO", frame


def boot_order(frames, node):
    """CiA 301: after the last reset boot-up, then SDO only, identity among the first, then NMT start; PDOs and
    operational only after it.
    """
    steps = list(of_node(frames, node))
    resets = [i for i, (step, _) in enumerate(steps) if step == "reset"]
    if not resets:
        return [f"{drive_text(node - 1)}: no reset communication"]
    steps = steps[resets[-1] + 1 :]
    order = []
    for step, frame in steps:
        if not order or order[-1][0] != step:
            order.append((step, frame))
    names = [step for step, _ in order]
    if names[:4] not in (["boot-up", "SDO", "start", "operational"], ["boot-up", "SDO", "start", "PDO"]):
        return [
            f"{drive_text(node - 1)}: after the reset come {', '.join(names[:5])};"
            " CiA 301 asks for boot-up, SDO, start, then PDO"
            " and operational"
        ]
    objects = [frame.object for step, frame in steps if step == "SDO"]
    if IDENTITY not in objects:
        return [f"{drive_text(node - 1)}: the identity (0x1018) was never read"]
    written_first = [f"0x{found:04X}" for found in objects[: objects.index(IDENTITY)] if found not in (0x1000, None)]
    return [f"{drive_text(node - 1)}: {written_first[0]} comes before the identity was read"] if written_first else []
