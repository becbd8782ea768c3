"""The same scenarios against real drives (`./dev hil --drives BUSES`): lianad alone on a lab's own interfaces, nothing
stands in for the drives.
"""
import json
import pathlib
import socket

from can import can_scenario
from can.stand import CanStand
from can.system import CanSystem
from liana.client import Client
from liana.system import run, table
from scenario_file import BadScenario

KIND = "drives"
SKIPPED = "breaks, watches or needs what the bench stands in for; on real drives do it by hand"


class Witness(Client):
    """Keeps of every state whether some drive had torque, and the measured angles."""

    def __init__(self, *words, seen):
        self.seen = seen
        super().__init__(*words)

    def next_state(self):
        state = super().next_state()
        self.seen.append(
            (any(drive["state"] == "operation_enabled" for drive in state["drives"]), state["measured_js_deg"])
        )
        return state


class RealDrives(CanSystem):
    """`buses`: the lab's table, by name or file. Its interfaces are up and have their bit rate. `calibration`: file of
    `liana calibrate`, or None.
    """

    def __init__(self, buses, calibration):
        super().__init__(bus=buses, lianad=["--calibration", calibration] if calibration else [])
        self.seen = []
        self.ours = [bus["name"] for bus in json.loads(table("buses", buses))["buses"]]

    def start_bench(self):
        pass

    def client(self):
        self.clients.append(Witness(self.api, "scenario", "client", seen=self.seen))
        return self.clients[-1]

    def torque(self):
        """As BenchOnCan's, from what lianad told: no truth exists here."""
        with_torque = [torque for torque, _ in self.seen]
        last = max((index for index, torque in enumerate(with_torque) if torque), default=0)
        after = [angles for _, angles in self.seen[last:]]
        return with_torque, max(max(abs(now - then) for now, then in zip(angles, after[0])) for angles in after)


class DrivesStand(CanStand):
    def __init__(self, buses, calibration):
        super().__init__()
        self.buses, self.calibration = buses, calibration

    def start(self, scenario):
        return RealDrives(self.buses, self.calibration)


class Item:
    """A scenario on CAN interfaces, as real drives see it."""

    def __init__(self, scenario):
        self.scenario, self.name, self.reduced = scenario, f"{scenario.name}/{KIND}", scenario.reduced

    def runs(self):
        return KIND in self.scenario.on

    def fault_count(self):
        return self.scenario.fault_count() if self.runs() else 0


def all_items():
    return [Item(one) for one in can_scenario.all_scenarios()]


def check_buses(buses, calibration):
    """Refuses a table that lianad could not use with SocketCAN, interfaces that are not there, and a file that cannot
    be read.
    """
    done = run("liana-mission", "eval", "buses", buses)
    if done.returncode != 0:
        raise BadScenario(f"--drives: {done.stderr.strip()}")
    backend = json.loads(done.stdout)["backend"]
    if backend != "socketcan":
        raise BadScenario(
            f"--drives: {buses} has the back end {backend}; give a table with socketcan (copy lua/buses/vcan.lua)"
        )
    for bus in json.loads(done.stdout)["buses"]:
        try:
            socket.if_nametoindex(bus["name"])
        except OSError:
            raise BadScenario(
                f"--drives: {buses}: interface {bus['name']} does not exist here; see liana doctor"
            ) from None
    if calibration and not pathlib.Path(calibration).is_file():
        raise BadScenario(
            f"--calibration: {calibration}: there is no such file; give what liana calibrate --out has written"
        )


def run_all(items, buses, calibration, report):
    """Runs one after the other; calls report(row) as rows come. What real drives cannot serve is skipped, by name."""
    rows = []
    for item in items:
        skipped = {"outcome": "skipped", "seconds": 0.0, "why": SKIPPED, "notes": []}
        row = can_scenario.row(item.scenario, KIND, DrivesStand(buses, calibration)) if item.runs() else skipped
        rows.append(
            {
                "name": item.name,
                "where": f"real drives: {buses}",
                **{key: row[key] for key in ("outcome", "seconds", "why", "notes")},
            }
        )
        report(rows[-1])
    return rows
