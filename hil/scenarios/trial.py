"""One system in lockstep with faults of bench and bus, recorded whole, and every safety rule over what it left behind."""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "system"))

import predicates  # noqa: E402
import recorded_rules  # noqa: E402
from liana_system import System, run  # noqa: E402
from recording import Recording  # noqa: E402

kSelfReports = ("noisy", "encoder_jump", "late", "stuck")  # what these drives report is not where their drums are


def drives_of(fault, count):
    drives = fault["drive"]
    return range(count) if drives == "all" else drives if isinstance(drives, list) else [drives]


class Trial:
    """`complaints` says which rules were broken, `recording` what happened."""

    def __init__(self, faults=(), bus_script=(), seed=1):
        self.faults, self.bus_script, self.seed = list(faults), list(bus_script), seed
        self.complaints, self.recording, self.truth, self.courses = [], None, None, []

    def go(self, act, replay=False):
        """Runs it: `act(client)` is the operator. With `replay` the recording must replay bit for bit."""
        with System(expect="client,archive", faults=self.faults, bus_script=self.bus_script, seed=self.seed) as system:
            system.start("liana-archive", "--api", system.api, "--record", system.directory)
            client = system.client()
            act(client)
            codes = system.shut_down(client)
            codes["liana-archive"] = system.ended("liana-archive")
            self.complaints += [f"{name} ended with {code}" for name, code in codes.items() if code != 0]
            self.judge(system, client.faults_told)
            if replay:
                self.complaints += replay_complaints(system.directory)
        return self

    def judge(self, system, told):
        self.truth, self.recording = system.truth(), Recording(system.directory / "ticks.mcap")
        self.courses = system.json("bench_summary.json")["faults"]
        enabled = self.truth.column("enabled")
        left_out = {drive for fault in self.faults if fault["kind"] in kSelfReports for drive in drives_of(fault, len(system.json("bench_summary.json")["drives"]))}
        self.complaints += predicates.numbers_that_are_none(self.truth.rows)
        self.complaints += recorded_rules.all_complaints(self.recording, enabled, told, left_out)

    def latched(self):
        """Every fault of the recording, in the order in which they were latched."""
        found = []
        for tick in self.recording.ticks:
            found += [fault[:2] + (fault.tick,) for fault in tick.faults if fault[:2] + (fault.tick,) not in found]
        return found


def replay_complaints(directory):
    """The recording replays bit for bit."""
    done = run("liana", "replay", directory, "--json")
    said = json.loads(done.stdout) if done.returncode in (0, 1) and done.stdout else {}
    if done.returncode != 0 or said.get("differing_ticks") != 0 or said.get("missing_ticks") != 0:
        return [f"the recording does not replay: exit {done.returncode}, {said.get('differing_ticks')} ticks differ, {done.stderr.strip()}"]
    return []
