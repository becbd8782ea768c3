"""Safety rules over the bus logs of an arm whose drives follow torques: RPDO1 is controlword, torque [permille of rated]
and rate [counts/s], in place of a target.
"""
import collections
import struct

import predicates
from liana.drive_names import drive_text

RAMP_S = 0.1  # from rated torque to none
ROUNDING_PERMILLE = 2  # of both ends
RATED_PERMILLE = 1000
MAX_RATE_SHARE = 1.2  # of a joint's rate: what leads it back to its target may be quicker than what is planned
STILL = 0.01  # of a joint's rate
GEAR_SWING_DEG = 0.2  # of a joint behind a closed brake: its gear is a spring

TorqueCommand = collections.namedtuple("TorqueCommand", "slot controlword torque rate")


def gives_torque(robot):
    return robot.get("kind") == "serial" and robot["drives"].get("mode") == "torque"


class TorqueTraffic(predicates.Traffic):
    COMMAND, COMMAND_WORDS = TorqueCommand, struct.Struct("<Hhi")


def swing_counts(robot):
    return GEAR_SWING_DEG / 360.0 * predicates.counts_per_turn(robot)


def fastest_counts_s(robot, node):
    return robot["joints"][node - 1]["rate_deg_s"] / 360.0 * predicates.counts_per_turn(robot)


def told(traffic, robot, period_s):
    """No drive that is enabled is told more than its rated torque, a step of it quicker than the ramp, or a rate that
    its joint cannot have.
    """
    complaints = []
    for node, commands in sorted(traffic.commands.items()):
        most_counts_s = MAX_RATE_SHARE * fastest_counts_s(robot, node) + predicates.ROUNDING_COUNTS
        for before, now in zip(commands, commands[1:]):
            if not (predicates.is_enabling(before) and predicates.is_enabling(now)):
                continue
            periods = max(1, now.slot - before.slot)
            most_step = RATED_PERMILLE * period_s / RAMP_S * periods + ROUNDING_PERMILLE
            where = f"{drive_text(node - 1)}, slot {now.slot}"
            if abs(now.torque) > RATED_PERMILLE:
                complaints.append(f"{where}: told {now.torque} permille of its rated torque")
            if abs(now.torque - before.torque) > most_step:
                complaints.append(f"{where}: the torque changes by {now.torque - before.torque} permille")
            if abs(now.rate) > most_counts_s:
                complaints.append(f"{where}: told a rate of {now.rate} counts/s, allowed are {most_counts_s:.0f}")
    return complaints


def rates_while_latched(traffic, robot, first_slot, end_slot):
    """From the end of the path stop to the operator's clear, no drive that still holds the arm is told to turn."""
    complaints = []
    for node, found in predicates.enabling_commands(traffic, first_slot, end_slot):
        fastest = max(abs(command.rate) for command in found)
        if fastest > STILL * fastest_counts_s(robot, node):
            complaints.append(f"{drive_text(node - 1)}: told a rate of {fastest} counts/s while the fault is latched")
    return complaints
