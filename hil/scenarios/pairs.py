"""Every pair of these faults, the second 0 to 50 ticks after the first, into a moving arm: what is latched first, what
wins (docs/explanation/fault-detection.md), and that it ends at rest.
"""
import collections
import itertools

import trial
from embedded import start_move
from liana.client import NotReached, brief
from run_scenario import expect_refused
from scenario_file import Failed, expect_that

BEGIN_TICK = 2000  # the arm is enabled at about 900; by now the move is well under way
DELAYS = (0, 1, 2, 3, 5, 8, 13, 21, 34, 50)
FOREVER = 1000000
RESTED_S = 1.0  # arm time for which the end state is watched
END_S = 60  # arm time; the slowest detection takes a third of it
SWING_DEG = 2.0  # in the last half second: brakes hold the drums, but on its elastic cables the arm swings on
REDUCED = ({"silent", "fault"}, {"slack", "overload"}, {"bus_lost", "operator_stop"})

# Fault of the bench or the bus; number and index it latches alone, and from how many ticks after its begin until how
# many. `or_else`: another number and index that may be sooner, where two detectors see it nearly at once.
Member = collections.namedtuple(
    "Member", "name bench bus number index earliest latest travel_deg or_else", defaults=(2.0, None)
)


def bench(drive, kind, **values):
    """`drive`: an index, as in the faults of the state."""
    return {"drive": drive + 1, "kind": kind, **values}


def drop(bus, **rule):
    return {"bus": bus, **rule, "to_slot": FOREVER, "action": "drop"}


MEMBERS = (
    Member("silent", bench(3, "silent"), None, 3002, 3, 2, 2),
    Member("missing", bench(5, "missing"), None, 3002, 5, 2, 2),
    Member("reboot", bench(8, "reboot"), None, 3007, 8, 0, 0),
    Member("fault", bench(10, "fault"), None, 3003, 10, 0, 0),
    Member("sto", bench(1, "sto"), None, 3004, 1, 0, 0),
    Member("encoder_jump", bench(6, "encoder_jump", counts=5000), None, 5005, 6, 2, 10, 5.0, (3006, 6)),
    Member("overload", bench(0, "encoder_jump", counts=60000), None, 5002, 0, 2, 8, 5.0),
    Member("motor_saturation", bench(12, "motor_saturation", tension_N=5), None, 3006, 12, 300, 4000, 6.0),
    Member("stuck", bench(13, "stuck"), None, 3006, 13, 60, 800),
    Member("slack", bench(4, "slack"), None, 5004, 3, 20, 150, 13.0, (5001, 4)),
    Member("cable_break", bench(9, "cable_break"), None, 5006, 9, 2, 4, 16.0),
    Member("bus_lost", None, drop(1), 4001, 1, 2, 2),
    Member("no_master", None, drop(0, id="0x77F"), 4001, 0, 45, 80),
    Member("no_targets", None, drop(1, id="0x20C"), 3004, 11, 4, 4),
    Member("operator_stop", None, None, None, None, 0, 0),
)


class Pair:
    """Looks like a scenario to the program that runs them."""

    def __init__(self, first, second, delay):
        self.members, self.delay = (first, second), delay
        self.name = f"60_pairs/{first.name}+{second.name}"
        self.reduced = {first.name, second.name} in REDUCED

    def begins(self):
        return BEGIN_TICK, BEGIN_TICK + self.delay

    def fault_count(self):
        return len(self.bench_faults()) + len(self.bus_script())

    def bench_faults(self):
        return [
            {**member.bench, "at_slot": begin} for member, begin in zip(self.members, self.begins()) if member.bench
        ]

    def bus_script(self):
        return [{**member.bus, "from_slot": begin} for member, begin in zip(self.members, self.begins()) if member.bus]

    def stop_tick(self):
        """When the operator stops the arm; None: never."""
        return next((begin for member, begin in zip(self.members, self.begins()) if member.number is None), None)

    def expected_first(self):
        """(number, index) of those that may be latched first: both, where either could be. In one tick buses come
        first, then the lower index.
        """
        faults = [
            (begin + member.earliest, begin + member.latest, member)
            for member, begin in zip(self.members, self.begins())
            if member.number
        ]
        soonest = min(latest for _, latest, _ in faults)
        able = [(earliest, latest, member) for earliest, latest, member in faults if earliest <= soonest]
        if len({(earliest, latest) for earliest, latest, _ in able}) == 1 and able[0][0] == able[0][1]:
            able = [min(able, key=lambda one: (one[2].number != 4001, one[2].index))]
        return [(member.number, member.index) for _, _, member in able] + [
            member.or_else for _, _, member in able if member.or_else
        ]

    def run(self):
        return PairRun(self)


def all_pairs():
    """Each once; delays, and which of the two begins, go round."""
    pairs = []
    for i, (one, other) in enumerate(itertools.combinations(MEMBERS, 2)):
        first, second = (one, other) if i % 2 == 0 else (other, one)
        pairs.append(Pair(first, second, DELAYS[i % len(DELAYS)]))
    return pairs


def ended(state):
    return state["state"] == "FAULT" or (state["stop"] and state["state"] == "DISABLED")


class PairRun:
    """A pair under way; the fields are those of run_scenario.Run."""

    def __init__(self, pair):
        self.pair, self.notes, self.violations = pair, [], []

    def go(self):
        done = trial.Trial(self.pair.bench_faults(), self.pair.bus_script()).go(self.operate)
        self.violations += done.complaints
        self.judge(done)
        expect_that(not self.violations, "; ".join(self.violations))

    def operate(self, client):
        client.call("acquire")
        client.until(lambda state: state["faults"] or (state["state"] != "BOOTING" and state["is_homed"]))
        client.call("state_command", command="enable")
        client.until(lambda state: state["faults"] or state["state"] == "ENABLED")
        expect_that(not client.state["faults"], f"a fault before the first of the pair: {brief(client.state)}")
        start_move(client)
        self.wait_for_the_end(client)
        self.stay(client)
        in_fault = client.state["state"] == "FAULT"
        answer = client.ask("state_command", command="clear")
        if answer["op"] == "error":
            lost = [fault["number"] for fault in client.state["faults"] if fault["number"] == 5006]
            expect_that(in_fault and lost, f"the clear was refused: {answer}")
            return
        client.until(lambda state: not in_fault or any("cleared" in event["text"] for event in state["events"]))
        client.go_on(1.0)
        expect_that(
            client.state["state"] in ("FAULT", "DISABLED"),
            f"after the clear the state is not documented: {brief(client.state)}",
        )

    def wait_for_the_end(self, client):
        stop = self.pair.stop_tick()
        if stop is not None:
            client.until(lambda state: state["tick"] >= stop, END_S)
            client.call("stop", reason="one of a pair")
        try:
            client.until(ended, END_S)
        except NotReached as error:
            raise Failed(f"it does not come to an end: {error}") from None

    @staticmethod
    def stay(client):
        """Nothing clears itself, and nothing moves or enables without a clear."""
        state = client.state["state"]
        client.go_on(RESTED_S)
        expect_that(
            client.state["state"] == state or client.state["state"] == "FAULT",
            f"{state} did not stay: {brief(client.state)}",
        )
        expect_refused(client, "after the pair")

    def judge(self, done):
        latched = done.latched()
        if latched:
            first = latched[0]
            self.notes.append(
                f"{self.pair.delay} ticks apart, first {first[0]} of {first[1]} after {first[2] - BEGIN_TICK} ticks"
            )
            expect_that(
                first[:2] in self.pair.expected_first(), f"first is {first[:2]}, expected {self.pair.expected_first()}"
            )
        expect_that(latched or self.pair.stop_tick() is not None, "no fault was latched")
        missing = [course["kind"] for course in done.courses if course["begun_slot"] is None]
        expect_that(not missing, f"never began: {', '.join(missing)}")
        end = len(done.truth.rows)
        swing, travel = done.truth.travel_deg(end - 125, end), done.truth.travel_deg(BEGIN_TICK, end)
        allowed = max(member.travel_deg for member in self.pair.members)
        self.notes.append(f"travel {travel:.2f} deg, at the end {swing:.3f}")
        expect_that(travel <= allowed, f"the arm travelled {travel:.2f} deg, allowed are {allowed}")
        expect_that(swing <= SWING_DEG, f"the arm swings by {swing:.2f} deg at the end, allowed are {SWING_DEG}")
