"""Scenarios on CAN interfaces: their files (README.md), and what runs each."""
from can import calibrate_run, mission_run, real_kills
from can.stand import CanStand
from can.system import BenchOnCan, INTERFACES
from run_scenario import Run, outcome
from scenario_file import BadScenario, check_during, check_fields, TIME_LIMIT_S, read
from source_tree import SCENARIOS

README = "hil/scenarios/can/README.md"
FIELDS = {
    "about": str,
    "on": list,
    "during": str,
    "do": list,
    "restart": str,
    "mend": list,
    "calibrate": dict,
    "mission": dict,
    "expect": dict,
    "reduced": bool,
    "only_in_vm": bool,
}
EXPECTED = {
    "fault": (int, list, type(None)),
    "state": str,
    "within_ticks": int,
    "after_clear": str,
    "travel_deg": (int, float),
    "overruns": int,
}
KINDS = (*INTERFACES, "drives")


class CanScenario:
    def __init__(self, path):
        self.name = f"can/{path.parent.name}/{path.stem}"
        content = read(path)
        self.calibrate, self.mission = content.get("calibrate"), content.get("mission")
        is_scenario = not self.calibrate and not self.mission
        check_fields(
            self.name, content, FIELDS, ("about", "on", "expect", *(["during"] if is_scenario else [])), README
        )
        if self.mission:
            check_fields(f"{self.name}: mission", self.mission, mission_run.FIELDS, ("name", "bus"), README)
            check_fields(f"{self.name}: expect", content["expect"], mission_run.EXPECTED, ("outcome",), README)
        elif self.calibrate:
            check_fields(f"{self.name}: calibrate", self.calibrate, calibrate_run.FIELDS, ("poses",), README)
            check_fields(f"{self.name}: expect", content["expect"], calibrate_run.EXPECTED, ("code",), README)
        else:
            check_fields(f"{self.name}: expect", content["expect"], EXPECTED, ("fault", "state"), README)
            check_during(self.name, content["during"])
        if not content["on"] or not set(content["on"]) <= set(KINDS):
            raise BadScenario(f"{self.name}: on is {content['on']}; allowed are {', '.join(KINDS)}")
        self.on, self.during, self.expect = content["on"], content.get("during"), content["expect"]
        self.do, self.mend = content.get("do", []), content.get("mend", [])
        self.restart, self.reduced = content.get("restart"), content.get("reduced", False)
        self.time_limit_s = TIME_LIMIT_S
        self.only_in_vm = content.get("only_in_vm", False)
        number = self.expect.get("fault")
        self.numbers = [] if number is None else number if isinstance(number, list) else [number]

    def fault_count(self):
        mission = self.mission or {}
        planted = self.do or "cross_wired" in (self.calibrate or {}) or "planted" in mission
        return len(mission.get("faults", [])) or (1 if planted else 0)

    def run(self, stand):
        if self.mission:
            return mission_run.MissionRun(self, stand)
        return calibrate_run.CalibrateRun(self, stand) if self.calibrate else Run(self, stand)


def all_scenarios(folder=SCENARIOS / "can"):
    """In bring-up order; those drawn by seed last."""
    return [CanScenario(path) for path in sorted(folder.glob("[0-9]*/*.json"))] + real_kills.all_real_kills()


class BenchStand(CanStand):
    """With the bench at the other end of a kind of bus."""

    def __init__(self, kind):
        super().__init__()
        self.kind = kind

    def start(self, scenario):
        return BenchOnCan(self.kind)


def row(scenario, kind, stand):
    """Runs it on a stand: name, kind, outcome, seconds, why, notes."""
    return {"name": scenario.name, "on": kind, **outcome(scenario.run(stand))}


def rows(words):
    """Runs what these words (NAME@KIND) name, in bring-up order."""
    for scenario in all_scenarios():
        for kind in scenario.on:
            if f"{scenario.name}@{kind}" in words:
                found = row(scenario, kind, BenchStand(kind))
                notes = ", ".join(found["notes"])
                said = (found["outcome"], f"{found['name']} ({kind})", f"{found['seconds']:.1f} s", notes, found["why"])
                print("  ".join(said), flush=True)
                yield found
