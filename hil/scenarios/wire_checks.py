"""What tshark, a decoder that is not ours, reads in the bus logs of a run. Each gives a list of complaints, empty when
all is well.
"""
import collections
import shutil
import subprocess

from liana.drive_names import drive_text

RESETS, START = (129, 130), 1  # NMT commands: reset node, reset communication; start
BOOT_UP, OPERATIONAL = 0, 5  # states in the heartbeat
IDENTITY = 0x1018

# One decoded frame: line of the log, CAN identifier, NMT command and its node, state in a heartbeat, object of an SDO.
Frame = collections.namedtuple("Frame", "line identifier command node state object")
FIELDS = (
    "frame.number",
    "can.id",
    "canopen.nmt_ctrl.cd",
    "canopen.nmt_ctrl.node_id",
    "canopen.nmt_guard.state",
    "canopen.sdo.main_idx",
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


def malformed(logs):
    """Every frame of every log is one that CANopen knows."""
    complaints = []
    for log in logs:
        found = tshark(log, "-Y", "_ws.malformed", "-T", "fields", "-e", "frame.number")
        if found:
            complaints.append(f"{log.name}: {len(found)} malformed frames, the first in line {found[0]}")
    return complaints


def number(text):
    return int(text, 0) if text else None


def decoded(log):
    words = [word for field in FIELDS for word in ("-e", field)]
    return [Frame(*map(number, line.split(","))) for line in tshark(log, "-T", "fields", "-E", "separator=,", *words)]


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
