"""One system in lockstep with faults of bench and bus, recorded whole; every safety rule over what it left behind."""
import json

import dispatch_rules
import predicates
import recorded_rules
import truth_rules
import wire_ages
from liana.recordings import Recording
from liana.system import System, run

NEVER = 10**9
SELF_REPORTS = (
    "noisy",
    "encoder_jump",
    "late",
    "stuck",
    "duplicate_node_id",
)  # what these drives report is not where their drums are


def drives_of(fault, count):
    """Indices of a fault's drives, which its list counts from 1."""
    drives = fault.get("drive", [])  # those of the camera have none
    return range(count) if drives == "all" else [n - 1 for n in (drives if isinstance(drives, list) else [drives])]


def self_reporting(faults, count):
    """Drives whose faults are in what they report."""
    return {drive for fault in faults if fault["kind"] in SELF_REPORTS for drive in drives_of(fault, count)}


class Trial:
    """`complaints` says which rules were broken, `recording` what happened."""

    def __init__(self, faults=(), bus_script=(), seed=1, cause_tick=None):
        self.faults, self.bus_script, self.seed = list(faults), list(bus_script), seed
        self.cause_tick = cause_tick  # of what neither bench nor bus does
        self.complaints, self.recording, self.truth, self.courses = [], None, None, []

    def go(self, act, replay=False):
        """Runs it: `act(client)` is the operator. With `replay` the recording must replay bit for bit."""
        with System(expect="client,archive", faults=self.faults, bus_script=self.bus_script, seed=self.seed) as system:
            system.start_archive()
            client = system.client()
            act(client)
            codes = system.shut_down(client)
            self.complaints += [f"{name} ended with {code}" for name, code in codes.items() if code != 0]
            self.judge(system, client.faults_told)
            if replay and self.recording.ticks:  # without a boot there are none
                self.complaints += replay_complaints(system.directory)
        return self

    def judge(self, system, told):
        """Over what a system that has ended left behind; `told`: the faults that its client was told of."""
        code = system.ended("liana-archive")
        if code != 0:
            self.complaints.append(f"liana-archive ended with {code}")
        self.truth, self.recording = system.truth(), Recording(system.directory / "ticks.mcap")
        summary, robot = system.json("bench_summary.json"), system.json("robot.json")
        period_s = 1.0 / system.json("buses.json")["rate_hz"]
        self.courses = summary["faults"]
        left_out = self_reporting(self.faults, len(summary["drives"]))
        self.complaints += predicates.numbers_that_are_none(self.truth.rows)
        enabled = self.truth.column("enabled")
        self.complaints += recorded_rules.all_complaints(self.recording, enabled, told, left_out, self.first_cause())
        ticks = self.recording.ticks
        self.complaints += truth_rules.all_complaints(
            self.truth,
            ticks,
            robot,
            self.faults,
            self.courses,
            summary.get("physics") != "worn",
            self.first_foreign_command(),
        )
        arrivals = wire_ages.Arrivals([log.read_text() for log in system.bus_logs()], predicates.LINE, period_s)
        self.complaints += wire_ages.wrong_ages(ticks, arrivals, self.strangers()) if ticks else []
        self.complaints += dispatch_rules.unverified(ticks, system.commands.read_text().splitlines())

    def first_cause(self):
        """The slot in which bench or bus first did something to drives, arm or wires; where nothing ever did, none."""
        if self.cause_tick is not None:
            return self.cause_tick
        begun = [course["begun_slot"] for course in self.courses if course["begun_slot"] is not None]
        return min(begun + [rule["from_slot"] for rule in self.bus_script], default=NEVER)

    def first_foreign_command(self):
        """The slot in which a rule of the bus first sends a drive a target (RPDO1); None, where none does."""
        sent = [rule for rule in self.bus_script if rule["action"] == "send" and 0x200 < int(rule["id"], 16) < 0x280]
        return min((rule["from_slot"] for rule in sent), default=None)

    def strangers(self):
        """Drives in whose name a rule of the bus speaks; all, where cables are exchanged: nobody is where he was."""
        if any(rule["action"] == "swap" for rule in self.bus_script):
            return set(range(len(self.recording.ticks[0].age)))
        ids = [
            int(rule["id"], 16) for rule in self.bus_script if rule["action"] in ("send", "duplicate") and "id" in rule
        ]
        return {(identifier & 0x7F) - 1 for identifier in ids}

    def latched(self):
        """Every fault of the recording, in the order in which they were latched."""
        found = {}
        for tick in self.recording.ticks:
            found.update(((fault.number, fault.index, fault.tick), None) for fault in tick.faults)
        return list(found)


def replay_complaints(directory):
    """The recording replays bit for bit."""
    done = run("liana", "replay", directory, "--json")
    said = json.loads(done.stdout) if done.returncode in (0, 1) and done.stdout else {}
    if done.returncode != 0 or said.get("differing_ticks") != 0 or said.get("missing_ticks") != 0:
        return [
            f"the recording does not replay: exit {done.returncode}, {said.get('differing_ticks')} ticks differ,"
            f" {said.get('missing_ticks')} are missing, {done.stderr.strip()}"
        ]
    return []
