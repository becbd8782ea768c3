"""Safety rules as checks over what a run left behind: the bus logs and truth.bin. Each gives a list of complaints,
empty when the rule held.
"""
import collections
import math
import re
import struct

from liana.drive_names import drive_text

ENABLE_OPERATION = 0x0F
TARGET_OF = range(0x201, 0x280)
REPORT_OF = range(0x181, 0x200)
FIRST_SENSOR = 0x20  # nodes from here on are no drives
LINE = re.compile(r"\((\d+\.\d+)\) \S+ ([0-9A-F]{3})#([0-9A-F]*)")
ROUNDING_COUNTS = 2  # of both ends
LET_GO_M, JUMPS = 0.008, 6

Command = collections.namedtuple("Command", "slot controlword target")
Report = collections.namedtuple("Report", "slot position")
REPORT_WORDS = struct.Struct("<2xi")


class Traffic:
    """Commands to and reports of every drive, by node, in the order of the wire."""

    COMMAND, COMMAND_WORDS = Command, struct.Struct("<Hi")

    def __init__(self, log_texts, period_s):
        self.commands, self.reports = collections.defaultdict(list), collections.defaultdict(list)
        for text in log_texts:
            for time, identifier, data in LINE.findall(text):
                self.take(int(float(time) / period_s + 1e-6), int(identifier, 16), data)

    def take(self, slot, identifier, data):
        if len(data) < 12:
            return
        if identifier in TARGET_OF:
            words = self.COMMAND_WORDS.unpack_from(bytes.fromhex(data))
            self.commands[identifier - 0x200].append(self.COMMAND(slot, *words))
        elif identifier in REPORT_OF and identifier - 0x180 < FIRST_SENSOR:
            self.reports[identifier - 0x180].append(Report(slot, *REPORT_WORDS.unpack_from(bytes.fromhex(data))))


def is_enabling(command):
    return command.controlword & 0x8F == ENABLE_OPERATION


def counts_per_turn(robot):
    """Counts of one turn of what a drive turns: a drum, or a joint of a serial arm."""
    return robot["drives"]["counts_per_turn"] * robot["drives"].get("gear", 1)


def step_limit_counts(robot, period_s):
    """Largest change of a target in one period: the table's own limit, none of the gate's margin."""
    if robot.get("kind") == "serial":
        turns_per_s = max(joint["rate_deg_s"] for joint in robot["joints"]) / 360.0
    else:
        turns_per_s = robot["limits"]["cable_speed_m_s"] / (2 * math.pi * robot["drives"]["drum_radius_m"])
    return turns_per_s * period_s * counts_per_turn(robot) + ROUNDING_COUNTS


def let_go_counts(robot):
    """How far a target may jump when a cable is missed and its segment is let go, or taken back: 8 mm of cable."""
    if robot.get("kind") == "serial":
        return 0.0
    return LET_GO_M / (2 * math.pi * robot["drives"]["drum_radius_m"]) * counts_per_turn(robot) + ROUNDING_COUNTS


class Jumps:
    """A drive may jump a few times a run: out with its segment, and back. Anything else is too fast."""

    def __init__(self, limit_counts, jump_counts):
        self.limit_counts, self.jump_counts, self.jumps = limit_counts, jump_counts, collections.Counter()

    def is_too_fast(self, drive, step_counts, periods=1):
        if step_counts <= self.limit_counts * periods:
            return False
        self.jumps[drive] += 1
        return step_counts > self.jump_counts or self.jumps[drive] > JUMPS


def target_steps(traffic, limit_counts, jump_counts=0.0):
    """No target of an enabled drive changes more than the limit from one period to the next, but where it lets go."""
    complaints, jumps = [], Jumps(limit_counts, jump_counts)
    for node, commands in sorted(traffic.commands.items()):
        for before, now in zip(commands, commands[1:]):
            periods = max(1, now.slot - before.slot)
            step = abs(now.target - before.target)
            if is_enabling(before) and is_enabling(now) and jumps.is_too_fast(node, step, periods):
                complaints.append(
                    f"{drive_text(node - 1)}, slot {now.slot}: the target changes by {step} counts, allowed are"
                    f" {limit_counts * periods:.0f}"
                )
    return complaints


def enabling_commands(traffic, first_slot, end_slot):
    """(node, its commands in these slots that enable operation), where there are any."""
    for node, commands in sorted(traffic.commands.items()):
        found = [command for command in commands if first_slot <= command.slot < end_slot and is_enabling(command)]
        if found:
            yield node, found


def enabling_without_clear(traffic, first_slot, end_slot):
    """Between the stop and the operator's clear and enable, no drive is told to enable operation."""
    return [
        f"{drive_text(node - 1)}, slot {found[0].slot}: told to enable operation while the fault is latched"
        f" ({len(found)} times)"
        for node, found in enabling_commands(traffic, first_slot, end_slot)
    ]


def targets_that_move(traffic, first_slot, end_slot):
    """From the end of the path stop to the operator's clear, the targets of drives that still hold the arm stay as
    they are, but for a count: tensions that creep round to one side or the other.
    """
    complaints = []
    for node, found in enabling_commands(traffic, first_slot, end_slot):
        targets = [command.target for command in found]
        if max(targets) - min(targets) > 1:
            complaints.append(
                f"{drive_text(node - 1)}: the target moves by {max(targets) - min(targets)} counts"
                " while the fault is latched"
            )
    return complaints


def drums_that_move(traffic, first_slot, end_slot, left_out=(), allowed_counts=1):
    """Brakes hold: between the stop and the operator's enable, the drives report one place. `left_out`: nodes whose
    reports are the fault.
    """
    complaints = []
    for node, reports in sorted(traffic.reports.items()):
        places = [report.position for report in reports if first_slot <= report.slot < end_slot]
        if node not in left_out and places and max(places) - min(places) > allowed_counts:
            complaints.append(
                f"{drive_text(node - 1)}: the drum moves by {max(places) - min(places)} counts"
                " while the fault is latched"
            )
    return complaints


def drives_with_torque(enabled, first_slot, end_slot):
    """From the end of the stop to the operator's enable, no drive is in Operation enabled; `enabled` is the column of
    truth.bin.
    """
    found = [slot for slot, count in enumerate(enabled) if first_slot <= slot < end_slot and count > 0]
    return [f"slot {found[0]}: {enabled[found[0]]:.0f} drives are enabled while the fault is latched"] if found else []


def numbers_that_are_none(rows):
    """Every number of truth.bin is finite."""
    broken = [i for i, row in enumerate(rows) if not all(math.isfinite(value) for value in row)]
    return [f"row {broken[0]} of truth.bin holds a number that is not finite"] if broken else []
