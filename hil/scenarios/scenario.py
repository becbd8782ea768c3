"""Scenarios on the embedded bus: their files (README.md), and what runs each."""
from arms import ARMS, CABLE_ARM
from embedded import EmbeddedStand
from host_run import HostRun
from run_scenario import Run
from scenario_file import BadScenario, check_during, check_fields, TIME_LIMIT_S, read
from source_tree import SCENARIOS

FIELDS = {
    "about": str,
    "during": str,
    "faults": list,
    "bus_script": list,
    "cause_tick": int,  # of what neither bench nor bus does: a bug that is planted into the controller
    "expect": dict,
    "reduced": bool,
    "host": dict,
    "robot": str,
    "start": dict,
    "stop_after_s": (int, float),
    "time_limit_s": (int, float),
}
START = {"pose": str, "in_pose": str, "cross_wired": list}
EXPECTED = {
    "fault": (int, type(None)),
    "index": int,
    "detail": int,
    "within_ticks": int,
    "state": str,
    "stopped_within_ticks": int,
    "travel_deg": (int, float),
    "after_clear": str,
    "events": list,
    "late_commands": bool,
    "boot_order": bool,
    "also": list,
    "refused": list,
}
HOST = {"action": str, "program": str, "bytes": int}
HOST_EXPECTED = {"outcome": str, "says": list}


class Scenario:
    def __init__(self, path):
        self.name = f"{path.parent.name}/{path.stem}"
        content = read(path)
        check_fields(self.name, content, FIELDS, ("about", "during", "expect"))
        expect = content["expect"]
        self.host, self.time_limit_s = content.get("host"), content.get("time_limit_s", TIME_LIMIT_S)
        if self.host is None:
            check_fields(f"{self.name}: expect", expect, EXPECTED, ("fault", "state"))
            self.check_fault(expect, content["during"])
        else:
            check_fields(f"{self.name}: host", self.host, HOST, ("action", "program"))
            check_fields(f"{self.name}: expect", expect, HOST_EXPECTED, ("outcome",))
        self.start = content.get("start", {})
        check_fields(f"{self.name}: start", self.start, START, ())
        self.robot, self.stop_after_s = content.get("robot", CABLE_ARM), content.get("stop_after_s")
        if self.robot not in ARMS:
            raise BadScenario(f"{self.name}: robot is {self.robot}; allowed are {', '.join(ARMS)}")
        if self.stop_after_s is not None and content["during"] == "boot":
            raise BadScenario(f"{self.name}: stop_after_s is of an arm that is enabled: during has to be rest or move")
        if "refused" in expect and content["during"] != "boot":
            raise BadScenario(f"{self.name}: expect: refused is of an arm that is never enabled: during has to be boot")
        check_during(self.name, content["during"])
        self.during, self.expect = content["during"], expect
        self.numbers = [expect["fault"]] if expect.get("fault") is not None else []
        self.faults, self.bus_script = content.get("faults"), content.get("bus_script")
        self.cause_tick = content.get("cause_tick")
        self.about, self.reduced = content["about"], content.get("reduced", False)

    def check_fault(self, expect, during):
        if expect["fault"] is not None and not {"index", "within_ticks"} <= expect.keys():
            raise BadScenario(f"{self.name}: expect: a fault needs index and within_ticks")
        if expect["fault"] is not None and during != "boot" and "stopped_within_ticks" not in expect:
            raise BadScenario(f"{self.name}: expect: a fault of an enabled arm needs stopped_within_ticks")

    def run(self):
        return Run(self, EmbeddedStand(self.robot)) if self.host is None else HostRun(self)

    def strangers_nodes(self):
        """Nodes in whose name a scripted stranger speaks: what the log says of them is not what controller and drive
        said.
        """
        return [int(rule["id"], 16) & 0x7F for rule in self.bus_script or [] if rule["action"] == "send"]

    def fault_count(self):
        return (
            len(self.faults or [])
            + len(self.bus_script or [])
            + (self.host is not None)
            + ("cross_wired" in self.start)
        )

    def words(self):
        """What lianad and the bench are told of the start."""
        start = self.start
        bench = (["--start-pose", start["pose"], "--jig"] if "pose" in start else []) + (
            ["--cross-wired", ",".join(map(str, start["cross_wired"]))] if "cross_wired" in start else []
        )
        return {"lianad": ["--in-pose", start["in_pose"]] if "in_pose" in start else [], "bench": bench}


def all_scenarios(folder=SCENARIOS):
    """In bring-up order."""
    return [Scenario(path) for path in sorted(folder.glob("[0-9]*/*.json"))]
