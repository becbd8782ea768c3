"""Drives of several makers on one arm, each type as the bench has its dictionary: boot, home, move, fault, recovery."""
import json
import unittest

from support import SOURCE, SystemTest
from liana.client import brief
from liana.system import System, table

JOINT, MOVE_DEG = 3, 2.0
ARM = {"robot": "micro", "scene": "none"}


def shipped():
    """Those that follow positions: drives of another mode are no drives of this arm."""
    return sorted(
        path.stem for path in (SOURCE / "lua" / "drives").glob("*.lua") if not path.stem.startswith("liana_cst")
    )


class DriveTypes(SystemTest):
    def test_every_shipped_type_runs_one_joint_of_an_arm_and_recovers_from_its_fault(self):
        types = shipped()
        self.assertGreaterEqual(len(types), 5)
        drives = ", ".join(f"{{ type = '{name}', nodes = {{ {i + 1} }} }}" for i, name in enumerate(types))
        when = {"enabled": True, "moving": True, "for_slots": 50}
        for drive in range(len(types)):
            with self.subTest(types[drive]):
                faults = [{"drive": drive + 1, "kind": "fault", "when": when}]
                with System(bus=self.bus_of(drives), faults=faults, **ARM) as system:
                    client = system.client()
                    client.enable()
                    goal_deg = list(client.state["setpoint_js_deg"])
                    goal_deg[JOINT] -= MOVE_DEG
                    client.call("move_jp", goal_deg=goal_deg)
                    client.until(lambda state: state["state"] == "FAULT")
                    self.assert_fault(client.state, 3003, drive)
                    client.call("state_command", command="clear")
                    client.until(lambda state: state["state"] == "DISABLED")
                    client.enable()
                    client.go_on(0.2)
                    self.assertEqual(client.state["state"], "ENABLED", brief(client.state))

    def test_a_drive_with_another_dictionary_is_refused_with_all_reasons_at_once(self):
        # It says that it is what the type expects, but it lacks 6072 and cannot be told 6066.
        with System(bus=self.bus_of("{ type = 'cia402_csp', bench = 'maxon_epos4', nodes = { 2 } }"), **ARM) as system:
            client = system.client()
            client.call("acquire")
            client.until(lambda state: state["state"] == "FAULT")
            self.assertEqual([(each["number"], each["index"]) for each in client.state["faults"]], [(3007, 1)])
            text = client.state["faults"][0]["text"]
            for word in ("drive 2 (node 2) on can0", "0x1018:1", "expected 19529", "found 251", "0x6076"):
                self.assertIn(word, text)

    def test_the_bus_table_carries_the_types_that_it_names(self):
        carried = json.loads(table("buses", self.bus_of("{ type = 'elmo_gold', nodes = { 1 } }")))["drive_types"]
        self.assertEqual(list(carried), ["elmo_gold"])


if __name__ == "__main__":
    unittest.main()
