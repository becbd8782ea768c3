"""Safety rules over a recording (liana.recordings), tick by tick. Each gives a list of complaints, empty when the rule
held; all_complaints() is all of them.

What is wrong is judged anew from what the drives reported, what has to follow from it by reactions.json, which is
written by hand.
"""
import collections
import json
import math
import pathlib
import typing

import predicates
import torque_rules
from liana.drive_names import drive_text

REACTIONS_PAGE = pathlib.Path(__file__).resolve().parent / "reactions.json"

REACTIONS = ("none", "hold", "stop", "stop at once", "off at once")  # a later one wins
NONE, HOLD, STOP, AT_ONCE, OFF = range(5)
CATEGORIES = (0, 1, 2, 2, 3)  # stop category that the state shows for each
FOLLOWERS = {
    "DISABLED": ("ENABLING", "FAULT"),
    "ENABLING": ("ENABLED", "STOPPING"),
    "ENABLED": ("STOPPING",),
    "STOPPING": ("DISABLED", "FAULT"),
    "FAULT": ("DISABLED",),
}
LATCHED_LAST = (1001, 6001)  # found after the reaction of their tick was decided: they act from the next one on
QUICK_STOP, DISABLE_VOLTAGE, FAULT_RESET = 0x02, 0x00, 0x80
CLEAR_TICKS = 260  # from a clear to its verdict
PERSIST_TICKS = 1250  # a hold that stays so long is a stop
QUICK_STOP_TICKS = 120  # a quick stop that takes longer is ended
PATH_STOP_TICKS = 500  # twice what rest from full speed takes
STILL_RAD_S = 1e-6
IN_OTHER_MODE = 2  # of `operational`: the drive shows another mode than its own
TELL_TICKS = 10  # two command intervals: the next state tells
SETTLE_TICKS = 5  # from the state on: drives have heard the last command, their brakes are closed

# Detection that is promised: wrong for more than so many ticks is a fault.
SILENT_TICKS, HEARTBEAT_S, LOST_TICKS = 2, 0.3, 2
SLACK_TICKS, ALARM_TICKS, OVERLOAD_TICKS = 25, 25, 3
FOLLOWING_M, FOLLOWING_S, FOLLOWING_TICKS = 2e-4, 0.08, 6  # at rest, and of the way at cable speed
FOLLOWING_DEG = 0.5  # of a serial arm's joint: 0.1 deg, and its way at full rate while drive and bus lag
TORQUE_FOLLOWING_DEG = 2.5  # of one whose drive follows torques: 2 deg, and that way
JUMP_DEG, OUTSIDE_DEG, OUTSIDE_TICKS = 0.2, 1.01, 2
BASE_JUMP_M, BASE_JUMP_PERIODS = 3e-4, 10  # of slide and roll of a base: more than ten periods at full rate


class Limits(typing.NamedTuple):
    """What reports are judged by: of every arm, of cables, and of a serial arm's joints."""

    step_counts: float
    following_counts: float
    heartbeat_ticks: int
    newtons_per_permille: float = 0.0
    slack_N: float = -math.inf
    let_go_counts: float = 0.0  # of a cable that is let go, or taken back
    alarm_N: float = math.inf
    overload_N: float = math.inf
    jump_counts: float = math.inf
    base_jump_counts: tuple = ()  # the same of slide and roll of a base, which have no cable
    ranges_counts: tuple = ()  # least and most of each joint


def limits_of(robot, period_s):
    serial = robot.get("kind") == "serial"
    return Limits(
        step_counts=predicates.step_limit_counts(robot, period_s),
        heartbeat_ticks=round(HEARTBEAT_S / period_s),
        let_go_counts=predicates.let_go_counts(robot),
        **(joint_limits(robot) if serial else cable_limits(robot, period_s)),
    )


def cable_limits(robot, period_s):
    drives, tension, limits = robot["drives"], robot["tension"], robot["limits"]
    counts_per_m = predicates.counts_per_turn(robot) / (2 * math.pi * drives["drum_radius_m"])
    jumps_m = [
        BASE_JUMP_M + BASE_JUMP_PERIODS * period_s * limits["theta_rate_deg_s"] * m_per_deg
        for m_per_deg in metres_per_deg(robot.get("base"))
    ]
    return {
        "following_counts": (FOLLOWING_M + FOLLOWING_S * limits["cable_speed_m_s"]) * counts_per_m,
        "base_jump_counts": tuple(counts_per_m * jump_m for jump_m in jumps_m),
        "newtons_per_permille": drives["rated_torque_Nm"] / 1000 / drives["drum_radius_m"],
        "slack_N": tension["floor_anywhere_N"],
        "alarm_N": tension["alarm_N"],
        "overload_N": tension["hard_limit_N"],
    }


def metres_per_deg(base):
    """Of slide and roll of a base that feeds; of an arm without one, nothing."""
    return [base["slide_m_per_deg"], math.radians(base["roll_radius_m"])] if base else []


def joint_limits(robot):
    drives, counts_per_deg = robot["drives"], predicates.counts_per_turn(robot) / 360.0
    following_deg = TORQUE_FOLLOWING_DEG if torque_rules.gives_torque(robot) else FOLLOWING_DEG
    ranges = []
    for joint, zero, direction in zip(robot["joints"], drives["zero_counts"], drives["direction"]):
        ends = joint["low_deg"] - OUTSIDE_DEG, joint["high_deg"] + OUTSIDE_DEG
        ranges.append(tuple(sorted(zero + direction * end * counts_per_deg for end in ends)))
    return {
        "following_counts": following_deg * counts_per_deg,
        "jump_counts": JUMP_DEG * counts_per_deg,
        "ranges_counts": tuple(ranges),
    }


def reactions_by_hand():
    """Fault number -> index into REACTIONS."""
    return {number: REACTIONS.index(row["reaction"]) for number, row in page_of_reactions().items()}


def retracts_by_hand():
    """Numbers of faults with which the arm may be led back."""
    return {number for number, row in page_of_reactions().items() if row["retract"]}


def page_of_reactions():
    """Fault number -> row of reactions.json."""
    return {int(number): row for number, row in json.loads(REACTIONS_PAGE.read_text()).items() if number.isdigit()}


def is_enabling(word):
    return word & 0x8F == predicates.ENABLE_OPERATION


def is_enabled(statusword):
    return statusword & 0x6F == 0x27


def has_torque(statusword):
    return is_enabled(statusword) or statusword & 0x6F == 0x07 or statusword & 0x4F == 0x0F


def is_in_fault(statusword):
    return statusword & 0x4F in (0x0F, 0x08)


def names(tick):
    return {(fault.number, fault.index) for fault in tick.faults}


def neighbours(ticks):
    return zip(ticks, ticks[1:])


def missing_ticks(ticks):
    """Every tick is there."""
    return [
        f"tick {now.tick} follows tick {before.tick}"
        for before, now in neighbours(ticks)
        if now.tick != before.tick + 1 + now.lost_ticks
    ]


def target_steps(ticks, limits):
    """No target of a drive told to enable operation changes more in a tick than the cable speed with the gate's
    margin, but where it lets go.
    """
    complaints, jumps = [], predicates.Jumps(limits.step_counts, limits.let_go_counts)
    for before, now in neighbours(ticks):
        if now.target == before.target:
            continue
        for drive, (old, new) in enumerate(zip(before.target, now.target)):
            if (
                is_enabling(before.controlword[drive])
                and is_enabling(now.controlword[drive])
                and jumps.is_too_fast(drive, abs(new - old))
            ):
                complaints.append(
                    f"tick {now.tick}: the target of {drive_text(drive)} changes by {new - old} counts, allowed are"
                    f" {limits.step_counts:.0f}"
                )
    return complaints


def commands_out_of_time(ticks):
    """A telecommand is in force only from its first tick until before its expiry, and only one that was released."""
    offered, complaints = {}, []
    for now in ticks:
        offered[now.sequence] = (now.first_tick, now.expiry_tick)
        if now.active_sequence == 0:
            continue
        first, expiry = offered.get(now.active_sequence, (math.inf, 0))
        if not first <= now.tick < expiry:
            complaints.append(
                f"tick {now.tick}: telecommand {now.active_sequence} is in force, which holds from {first} until before"
                f" {expiry}"
            )
    return complaints


def acting(tick):
    """The latched faults that decide how this tick reacts."""
    return [fault for fault in tick.faults if fault.tick < tick.tick or fault.number not in LATCHED_LAST]


def commands_while_latched(ticks, retracts=frozenset()):
    """No telecommand is in force while a fault is latched, and what moved comes to rest; `retracts`: faults with which
    the arm may be led back.
    """
    complaints = []
    for now in ticks:
        held = [] if may_retract(now, retracts) else acting(now)
        held = [
            fault for fault in held if fault.number not in retracts
        ] or held  # until the first of them it might move
        if held and now.active_sequence != 0:
            complaints.append(
                f"tick {now.tick}: telecommand {now.active_sequence} is in force while {held[0].number} is latched"
            )
        if held and now.tick > held[0].tick + PATH_STOP_TICKS and max(map(abs, now.theta_rate)) > STILL_RAD_S:
            complaints.append(
                f"tick {now.tick}: the commanded arm still moves, {held[0].number} was latched in tick {held[0].tick}"
            )
    return complaints


def may_retract(tick, retracts):
    """All that is latched is known, and of a kind that leaves the way back open."""
    return not tick.dropped and all(fault.number in retracts for fault in tick.faults)


def states_not_documented(ticks, reactions):
    """States follow each other as documented, and every fault is one that has a page."""
    complaints = [
        f"tick {now.tick}: {now.state} follows {before.state}"
        for before, now in neighbours(ticks)
        if now.state != before.state and now.state not in FOLLOWERS[before.state]
    ]
    unknown = {fault.number for now in ticks for fault in now.faults} - reactions.keys()
    return complaints + [f"fault {number} is not in reactions.json" for number in sorted(unknown)]


def enabling_unasked(ticks):
    """Drives are enabled only after an operator's enable, and none is told to enable operation in DISABLED or FAULT."""
    complaints = []
    for before, now in neighbours(ticks):
        if now.state == "ENABLING" != before.state and (now.request != "enable" or now.faults):
            complaints.append(
                f"tick {now.tick}: enabling begins, asked for is {now.request}, {len(now.faults)} faults are latched"
            )
        if now.state in ("DISABLED", "FAULT") and any(map(is_enabling, now.controlword)):
            complaints.append(f"tick {now.tick}: a drive is told to enable operation in {now.state}")
    return complaints


def faults_gone_unasked(ticks):
    """A latched fault goes away only by an operator's clear, and Fault is left only so."""
    asked, complaints = -math.inf, []
    for before, now in neighbours(ticks):
        if now.request in ("clear", "recover"):
            asked = now.tick
        gone = names(before) - names(now)
        if gone and now.tick > asked + CLEAR_TICKS:
            complaints.append(f"tick {now.tick}: faults {sorted(gone)} are gone without a clear")
        if before.state == "FAULT" != now.state and (now.faults or now.tick > asked + CLEAR_TICKS):
            complaints.append(f"tick {now.tick}: FAULT is left without a clear")
    return complaints


def had_torque(tick):
    """The drives hold the arm: in ENABLED, and in ENABLING from the pretension ramp on."""
    return tick.state == "ENABLED" or (tick.state == "ENABLING" and all(map(is_enabled, tick.statusword)))


def weakest_reaction_broken(before, now, highest, was, persisted):
    """Why this tick does less than the highest latched reaction asks for; None when it does enough."""
    if now.state in ("DISABLED", "ENABLING") or (now.state == "ENABLED" and highest > HOLD):
        return f"the state is {now.state}"
    if now.stop_category < CATEGORIES[highest]:
        return f"the stop category is {now.stop_category}"
    if highest == OFF and any(word not in (DISABLE_VOLTAGE, FAULT_RESET) for word in now.controlword):
        return "a drive is not told to disable voltage"
    if highest >= AT_ONCE and any(map(is_enabling, now.controlword)):
        return "a drive is told to enable operation"
    if highest == AT_ONCE > was and had_torque(before):
        if any(is_enabled(status) and word != QUICK_STOP for status, word in zip(now.statusword, now.controlword)):
            return "a drive with torque is not told to quick stop"
    if (
        highest == HOLD
        and before.state == "ENABLED" != now.state
        and now.request not in ("stop", "disable")
        and not persisted
    ):
        return f"the state is {now.state}: a hold keeps the drives enabled"
    return None


def weak_reactions(ticks, reactions):
    """The highest reaction of all latched faults is what happens, in the tick in which they are latched
    (docs/explanation/fault-detection.md).
    """
    complaints, was = [], NONE
    for before, now in neighbours(ticks):
        held = acting(now)
        highest = max((reactions.get(fault.number, OFF) for fault in held), default=NONE)
        persisted = bool(held) and now.tick >= held[0].tick + PERSIST_TICKS - SETTLE_TICKS
        why = weakest_reaction_broken(before, now, highest, was, persisted) if held else None
        if why:
            complaints.append(
                f"tick {now.tick}: {REACTIONS[highest]} is asked for by {[tuple(fault[:2]) for fault in held]}, but"
                f" {why}"
            )
        was = highest
    return complaints


class Watch:
    """Which faults the reports of one tick after the other must lead to."""

    def __init__(self, limits, always=False):
        """`always`: everything for which there is a reason, in every state and of drives that were never heard well."""
        self.limits, self.always, self.seen, self.wrong_for = limits, always, set(), collections.Counter()
        self.ticks = 0

    def lasting(self, key, is_wrong, ticks):
        self.wrong_for[key] = self.wrong_for[key] + 1 if is_wrong else 0
        return self.wrong_for[key] >= ticks

    def due(self, before, now):
        """(number, index) of everything that is wrong and must be latched in this tick."""
        powered = self.always or before.state == "ENABLED"
        self.ticks += 1
        found = [(4001, bus) for bus in range(32) if now.lost_buses >> bus & 1]
        found += ((3009, drive) for drive in range(32) if now.twice >> drive & 1)
        if powered and now.lost_ticks > LOST_TICKS:
            found.append((2001, -1))
        for drive, status in enumerate(now.statusword):
            found += ((number, drive) for number in self.of_link(now, drive))
            if is_in_fault(status):
                found.append((3003, drive))
            elif powered and not is_enabled(status):
                found.append((3004, drive))
            elif powered and now.operational[drive] == IN_OTHER_MODE:
                found.append((3010, drive))
            found += ((number, drive) for number in self.of_cable(now, drive, powered))
            found += ((number, drive) for number in self.of_joint(before, now, drive, powered))
        return found

    def of_link(self, now, drive):
        silent, missing = now.age[drive] > SILENT_TICKS, now.heartbeat_age[drive] > self.limits.heartbeat_ticks
        if not silent and not missing and now.operational[drive]:
            self.seen.add(drive)
        elif self.always or drive in self.seen or self.ticks >= self.limits.heartbeat_ticks - 1:  # booted before
            if silent:
                yield 3002
            if missing:
                yield 3001
            if not now.operational[drive]:
                yield 3007

    def of_joint(self, before, now, drive, powered):
        position, both_new = now.position[drive], now.age[drive] == 0 == before.age[drive]
        lag = abs(before.target[drive] - position)
        if self.lasting((3006, drive), powered and lag > self.limits.following_counts, FOLLOWING_TICKS):
            yield 3006
        jump_counts = (*self.limits.base_jump_counts, *[self.limits.jump_counts] * 32)[drive]
        if both_new and abs(position - before.position[drive]) > jump_counts:
            yield 2003
        for least, most in self.limits.ranges_counts[drive : drive + 1]:
            if self.lasting((2002, drive), powered and not least <= position <= most, OUTSIDE_TICKS):
                yield 2002

    def of_cable(self, now, drive, powered):
        limits, tension_N = self.limits, now.torque[drive] * self.limits.newtons_per_permille
        if drive < len(limits.base_jump_counts):
            if self.lasting((5002, drive), powered and abs(tension_N) > limits.overload_N, OVERLOAD_TICKS):
                yield 5002
            return
        if self.lasting((5001, drive), powered and tension_N < limits.slack_N, SLACK_TICKS):
            yield 5001
        if self.lasting((5003, drive), powered and tension_N > limits.alarm_N, ALARM_TICKS):
            yield 5003
        if self.lasting((5002, drive), powered and tension_N > limits.overload_N, OVERLOAD_TICKS):
            yield 5002


def faults_not_latched(ticks, limits):
    """Whatever the reports show wrong is latched in the same tick; a full list counts what it has no place for."""
    watch, complaints, unplaced = Watch(limits), [], set()
    for before, now in neighbours(ticks):
        if now.dropped < before.dropped:  # an operator's clear emptied the list: what is gone needs no place any more
            unplaced = set()
        unplaced |= set(watch.due(before, now)) - names(now)
        unplaced -= names(now)
        absent = unplaced if len(unplaced) > now.dropped else ()
        if not now.dropped:
            unplaced = set()
        if absent:
            complaints.append(f"tick {now.tick}: {sorted(absent)} had to be latched, there are {sorted(names(now))}")
    return complaints


# Numbers whose cause is plain in the reports, so that the watch here finds exactly what the core may latch.
PLAIN = (2001, 3001, 3002, 3003, 3004, 3007, 3009, 3010, 4001, 5001, 5002, 5003)


def false_alarms(ticks, limits, first_cause):
    """Nothing is latched before anything was done to the arm (`first_cause`, a tick), and nothing whose plain cause is
    not in the reports.
    """
    watch, complaints = Watch(limits, always=True), []
    for before, now in neighbours(ticks):
        due, new = set(watch.due(before, now)), names(now) - names(before)
        for number, index in sorted(new):
            if now.tick < first_cause:
                complaints.append(f"tick {now.tick}: {number} of {index} is latched, and nothing has happened yet")
            elif number in PLAIN and (number, index) not in due:
                complaints.append(f"tick {now.tick}: {number} of {index} is latched, and no report shows why")
    return complaints


def quick_stops_cut_short(ticks, reactions):
    """A drive that was told to quick stop keeps its torque until it stands: until it is off, its time is up, or a
    fault asks for off.
    """
    told_since, complaints = {}, []
    for now in ticks:
        off = any(reactions.get(fault.number, OFF) == OFF for fault in acting(now)) or now.dropped
        for drive, (word, status) in enumerate(zip(now.controlword, now.statusword)):
            if word == QUICK_STOP and has_torque(status):
                told_since.setdefault(drive, now.tick)
                continue
            since = told_since.pop(drive, None)
            if (
                since is not None
                and has_torque(status)
                and now.age[drive] == 0
                and not off
                and now.tick < since + QUICK_STOP_TICKS
            ):
                complaints.append(
                    f"tick {now.tick}: {drive_text(drive)} is told 0x{word:02X} while its quick stop is under way"
                )
    return complaints


def stops_not_confirmed(ticks):
    """FAULT is reached with every drive shown to be without torque, or with 3008 for those that are not."""
    complaints = []
    for before, now in neighbours(ticks):
        if before.state != "STOPPING" or now.state not in ("FAULT", "DISABLED"):
            continue
        unplaced = 0
        for drive, status in enumerate(now.statusword):
            shown = now.age[drive] <= SILENT_TICKS and not has_torque(status)
            unplaced += not shown and (3008, drive) not in names(now)
            if not shown and (3008, drive) not in names(now) and unplaced > now.dropped:
                complaints.append(
                    f"tick {now.tick}: {now.state} is reached, but {drive_text(drive)} is not shown to be without torque,"
                    " nor is 3008 latched"
                )
    return complaints


def faults_not_told(ticks, told):
    """Every fault that a client was told of is in the recording, and every recorded one was told; `told`: (number,
    index, tick). Those of a boot that failed come before its first tick.
    """
    told = {fault for fault in told if fault[2] >= ticks[0].tick}
    recorded = {(fault.number, fault.index, fault.tick) for now in ticks for fault in now.faults}
    due = {fault for fault in recorded if fault[2] < ticks[-1].tick - TELL_TICKS}
    return [f"fault {fault} was told to the client, but is not recorded" for fault in sorted(told - recorded)] + [
        f"fault {fault} is recorded, but the client was never told" for fault in sorted(due - told)
    ]


def standing_ranges(ticks):
    """(first tick, tick after the last) of every stretch in which drives must be without torque and brakes closed."""
    first = None
    for now in ticks:
        standing = now.state in ("DISABLED", "FAULT")
        if standing and first is None:
            first = now.tick + SETTLE_TICKS
        if not standing and first is not None:
            yield first, now.tick
            first = None
    if first is not None:
        yield first, ticks[-1].tick + 1


def torque_while_off(ticks, enabled):
    """In DISABLED and FAULT no drive has torque; `enabled` is the column of truth.bin."""
    return [
        complaint
        for first, end in standing_ranges(ticks)
        for complaint in predicates.drives_with_torque(enabled, first, end)
    ]


def drums_moving_while_off(ticks, left_out):
    """In DISABLED and FAULT brakes hold the drums; `left_out`: drives whose reports are the fault."""
    complaints, index = [], {now.tick: i for i, now in enumerate(ticks)}
    for first, end in standing_ranges(ticks):
        rows = ticks[index.get(first, len(ticks)) : index.get(end, len(ticks))]
        for drive in range(len(ticks[0].position)):
            places = [row.position[drive] for row in rows if row.age[drive] == 0]
            if drive not in left_out and places and max(places) - min(places) > 1:
                complaints.append(
                    f"ticks {first} to {end}: the drum of {drive_text(drive)} moves by"
                    f" {max(places) - min(places)} counts while the arm is off"
                )
    return complaints


def all_complaints(recording, enabled, told, left_out=(), first_cause=-1):
    """Everything that breaks a rule; `enabled`: column of truth.bin, `told`: faults that the client was told of,
    `first_cause`: the tick in which something was first done to the arm.
    """
    end = recording.metadata.get("end", {})
    if not recording.whole or end.get("dropped") != "0" or end.get("ticks") != str(len(recording.ticks)):
        return [f"the recording is not complete: {end}, {len(recording.ticks)} ticks read"]
    ticks = recording.ticks
    if not ticks:
        return [
            f"slot {slot}: {count:.0f} drives are enabled, and nothing was recorded"
            for slot, count in enumerate(enabled)
            if count > 0
        ][:1]
    limits, reactions = (
        limits_of(recording.robot(), float(recording.metadata["run"]["period_s"])),
        reactions_by_hand(),
    )
    found = (
        missing_ticks(ticks),
        target_steps(ticks, limits),
        commands_out_of_time(ticks),
        commands_while_latched(ticks, retracts_by_hand()),
        states_not_documented(ticks, reactions),
        enabling_unasked(ticks),
        faults_gone_unasked(ticks),
        weak_reactions(ticks, reactions),
        quick_stops_cut_short(ticks, reactions),
        stops_not_confirmed(ticks),
        faults_not_latched(ticks, limits),
        faults_not_told(ticks, told),
        false_alarms(ticks, limits, first_cause),
        torque_while_off(ticks, enabled),
        drums_moving_while_off(ticks, left_out),
    )
    return [complaint for complaints in found for complaint in complaints[:3]]
