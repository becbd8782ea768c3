"""Drives that are missing, wrong, silent, in fault or without power: a named message and a safe arm."""
import unittest

from support import SystemTest
from liana.client import brief
from liana.system import System

FAULT_SLOT = 2500  # the move that start_moving begins is under way then; checked in each test
DRIVE, NODE = 3, 4
OTHER_MODE = 3010


def fault(kind, at_slot=FAULT_SLOT):
    return [{"drive": DRIVE + 1, "kind": kind, "at_slot": at_slot}]


def says(state, *parts):
    """One event of the state has all the parts."""
    return any(all(part in event["text"] for part in parts) for event in state["events"])


class DrivesThatDoNotBoot(SystemTest):
    def refused_boot(self, kind, number, *words):
        with System(faults=fault(kind, 0)) as system:
            client = system.client()
            client.call("acquire")
            state = client.until(lambda state: state["state"] == "FAULT")
            self.assertTrue(
                any(all(word in event["text"] for word in words) for event in state["events"]), brief(state)
            )
            self.assertEqual([(fault["number"], fault["index"]) for fault in state["faults"]], [(number, DRIVE)])
            for word in words:
                self.assertIn(word, state["faults"][0]["text"])
            for command in ("enable", "home"):
                self.assert_refused(client.ask("state_command", command=command), "fault", *words)
            self.assert_refused(client.ask("move_jp", goal_deg=[0] * 10), "not_enabled")
            client.call("state_command", command="clear")
            client.until(lambda state: state["state"] == "BOOTING")
            client.until(lambda state: state["state"] == "FAULT")
            self.assertEqual(
                [fault["number"] for fault in client.state["faults"]], [number], "asked again it is as wrong as before"
            )
            client.go_on(0.5)
            self.assertEqual(system.shut_down(client), {"lianad": 0, "liana-bus": 0, "liana-bench": 0})
            truth = system.truth()
            self.assertEqual(max(truth.column("enabled")), 0)
            self.assert_still(truth, 0)

    # req:C2
    def test_a_missing_drive_is_named_and_nothing_is_enabled(self):
        self.refused_boot("missing", 3001, "drive 4 (node 4, segment 2) on can0", "no boot-up")

    def test_a_wrong_identity_is_named_with_what_was_expected_and_found(self):
        self.refused_boot(
            "wrong_identity", 3007, "drive 4 (node 4, segment 2) on can0", "0x1018:2", "expected 1", "found 2"
        )


class FaultsInMotion(SystemTest):
    """What a moving arm does after a fault of its drives."""

    def ended(self, system, client, stop_deg=1.0):
        self.assertEqual(system.shut_down(client), {"lianad": 0, "liana-bus": 0, "liana-bench": 0})
        truth = system.truth()
        self.assertGreater(truth.travel_deg(FAULT_SLOT - 50, FAULT_SLOT), 0.03, "the fault has to meet a moving arm")
        self.assert_stopped(truth, FAULT_SLOT, stop_deg)

    def assert_usable_again(self, client):
        """After a clear that was asked for: the arm can be enabled and disabled."""
        client.until(lambda state: state["state"] == "DISABLED" and not state["faults"])
        client.call("state_command", command="enable")
        client.until(lambda state: state["state"] == "ENABLED" and state["at_rest"])
        client.call("state_command", command="disable")
        client.until(lambda state: state["state"] == "DISABLED")


class DrivesThatFailInMotion(FaultsInMotion):
    def moving_into(self, kind):
        """A system whose drive fails while the arm moves; the state some time after it."""
        system = self.enterContext(System(faults=fault(kind)))
        client = system.client()
        client.enable()
        client.start_moving()
        self.assertLess(client.state["tick"], FAULT_SLOT - 5, "the move must be under way before the fault")
        client.until(lambda state: state["faults"])
        self.assertLess(
            client.state["tick"],
            FAULT_SLOT + 250,
            "slack is debounced for 25 ticks, and the cable needs some to come loose",
        )
        return system, client

    def in_fault(self, client):
        client.until(lambda state: state["state"] == "FAULT")
        self.assertIn(client.state["stop_category"], ("stop", "off"))
        goal = client.state["setpoint_js_deg"]
        self.assert_refused(client.ask("move_jp", goal_deg=goal), "fault", "clear")
        self.assert_refused(client.ask("state_command", command="enable"), "fault", "clear")

    def test_a_silent_drive_is_fault_3002_and_stays_latched_while_it_is_silent(self):
        system, client = self.moving_into("silent")
        self.assert_fault(client.state, 3002, DRIVE)
        self.in_fault(client)
        client.call("state_command", command="clear")
        client.until(lambda state: says(state, "not cleared", "checked: "))
        client.go_on(1.0)
        self.assertEqual(client.state["state"], "FAULT")
        self.assert_fault(client.state, 3002, DRIVE)
        self.ended(system, client)

    def test_a_drive_that_loses_power_is_fault_3002(self):
        system, client = self.moving_into("missing")
        self.assert_fault(client.state, 3002, DRIVE)
        self.in_fault(client)
        self.ended(system, client)

    def test_a_drive_in_fault_is_3003_with_its_emergency_code_and_clear_makes_it_usable_again(self):
        system, client = self.moving_into("fault")
        self.assert_fault(client.state, 3003, DRIVE)
        self.assertEqual(client.state["faults"][0]["detail"], 0x2310)
        self.in_fault(client)
        client.go_on(1.0)
        self.assertEqual(client.state["state"], "FAULT", "nothing clears itself")
        client.call("state_command", command="clear")
        client.until(lambda state: says(state, "faults cleared; checked: "))
        self.assert_usable_again(client)
        self.ended(system, client)
        self.assertEqual(system.emergencies()[NODE][:2], [0x2310, 0])

    def test_an_emergency_of_a_drive_that_goes_on_is_an_event_and_no_fault(self):
        emergency = [{"drive": DRIVE + 1, "kind": "emcy", "code": 0x4210, "at_slot": FAULT_SLOT}]
        with System(faults=emergency) as system:
            client = system.client()
            client.enable()
            client.start_moving()
            client.until(lambda state: says(state, f"drive {DRIVE + 1} (node 4, segment 2) sent emergency 0x4210: "))
            self.assertEqual(client.state["faults"], [])
            client.until(lambda state: not state["is_busy"])
            self.assert_holds(client.state)

    def test_safe_torque_off_is_3004_and_a_drive_without_power_is_not_enabled_again(self):
        system, client = self.moving_into("sto")
        self.assert_fault(client.state, 3004, DRIVE)
        self.in_fault(client)
        client.call("state_command", command="clear")
        client.until(lambda state: state["state"] == "DISABLED")
        client.call("state_command", command="enable")
        client.until(lambda state: state["state"] == "FAULT")
        self.assert_fault(client.state, 3005, DRIVE)
        self.ended(system, client)
        self.assertEqual(system.emergencies(), {NODE: [0xFF01]})

    def test_a_cable_that_comes_loose_contradicts_its_segment_first_a_hold_and_when_it_stays_slack_a_stop(self):
        system, client = self.moving_into("slack")
        self.assert_fault(client.state, 5004, DRIVE)
        self.assertEqual(client.state["stop_category"], "hold")
        self.assertEqual(client.state["state"], "ENABLED")
        client.until(lambda state: state["stop_category"] == "stop")
        self.assertIn(5001, {fault["number"] for fault in client.state["faults"]})
        client.until(lambda state: state["state"] == "FAULT")
        client.go_on(1.0)
        self.assertEqual(client.state["stop_category"], "stop")
        self.assertEqual(system.shut_down(client), {"lianad": 0, "liana-bus": 0, "liana-bench": 0})
        truth = system.truth()
        self.assertEqual(truth.column("enabled")[-1], 0)
        # 20 mm of cable at 25 mm from the axes of 8 joints let the segment give way by 5.7 deg; a swing about that
        # place reaches twice as far.
        self.assertLess(truth.travel_deg(FAULT_SLOT, None), 12.0)


class TwoAxesOnANode(FaultsInMotion):
    """15 drives on 8 nodes: drive 3 is node 2, drive 4 its axis 2."""

    def started(self, **changes):
        system = self.enterContext(System(bus="embedded_two_axes", **changes))
        return system, system.client()

    def moving_into(self, **kind):
        system, client = self.started(faults=[{"drive": DRIVE + 1, "at_slot": FAULT_SLOT, **kind}])
        client.enable()
        client.start_moving()
        self.assertLess(client.state["tick"], FAULT_SLOT - 5, "the move must be under way before the fault")
        client.until(lambda state: state["state"] == "FAULT")
        return system, client

    def found(self, client, number):
        return [fault["index"] for fault in client.state["faults"] if fault["number"] == number]

    # req:C2
    def test_an_arm_whose_drives_are_pairs_boots_is_enabled_and_moves(self):
        system, client = self.started()
        client.enable()
        places = [(drive["node"], drive["axis"]) for drive in client.state["drives"]]
        self.assertEqual(places, [(1 + i // 2, 1 + i % 2) for i in range(15)])
        enabled_tick = client.state["tick"]
        client.start_moving()
        client.until(lambda state: not state["is_busy"])
        self.assertEqual(client.state["faults"], [])
        self.assert_holds(client.state)
        self.assertEqual(system.shut_down(client), {"lianad": 0, "liana-bus": 0, "liana-bench": 0})
        self.assertGreater(system.truth().travel_deg(enabled_tick, None), 1.0)

    def test_a_node_that_is_missing_at_boot_is_one_fault_that_names_both_axes(self):
        _, client = self.started(faults=fault("missing", 0))
        client.call("acquire")
        client.until(lambda state: state["state"] == "FAULT")
        self.assertEqual([(each["number"], each["index"]) for each in client.state["faults"]], [(3001, DRIVE - 1)])
        for name in ("drive 3 (node 2, segment 1)", "drive 4 (node 2, axis 2, segment 2)", "on can0"):
            self.assertIn(name, client.state["faults"][0]["text"])

    def test_a_node_that_is_lost_takes_both_axes_with_it_in_one_alarm(self):
        system, client = self.moving_into(kind="missing")
        self.assertEqual(self.found(client, 3002), [DRIVE - 1, DRIVE])
        silent = [fault for fault in client.state["faults"] if fault["number"] == 3002]
        self.assertEqual(silent[0]["tick"], silent[1]["tick"])
        self.assertEqual(
            [fault["where"] for fault in silent],
            ["drive 3 (node 2, segment 1)", "drive 4 (node 2, axis 2, segment 2)"],
        )
        self.ended(system, client)

    def test_a_fault_of_axis_2_is_its_own_and_clear_makes_it_usable_again(self):
        system, client = self.moving_into(kind="fault")
        self.assertEqual(self.found(client, 3003), [DRIVE])
        client.go_on(1.0)
        client.call("state_command", command="clear")
        self.assert_usable_again(client)
        self.ended(system, client)
        self.assertEqual(system.emergencies()[2][:2], [0x2310, 0])

    def test_axis_2_in_another_mode_is_found_alone(self):
        system, client = self.moving_into(kind="other_mode", mode=3)
        self.assertEqual(self.found(client, OTHER_MODE), [DRIVE])
        self.ended(system, client)

    def test_a_node_that_restarts_is_booted_again_with_both_axes(self):
        _, client = self.moving_into(kind="reboot")
        client.go_on(1.0)
        client.call("state_command", command="clear")
        client.until(lambda state: state["state"] == "DISABLED" and not state["faults"])
        client.enable()
        client.go_on(0.2)
        self.assertEqual(client.state["state"], "ENABLED", brief(client.state))


class DrivesWithoutTargets(SystemTest):
    def test_a_drive_without_targets_for_three_periods_stops_by_itself_with_emergency_8250(self):
        lost = [{"bus": 0, "id": hex(0x200 + NODE), "from_slot": FAULT_SLOT, "to_slot": 1000000, "action": "drop"}]
        with System(bus_script=lost) as system:
            client = system.client()
            client.enable()
            client.start_moving()
            state = client.until(lambda state: state["state"] == "FAULT")
            self.assert_fault(state, 3004, DRIVE)
            client.go_on(1.0)
            system.shut_down(client)
            self.assertEqual(system.emergencies(), {NODE: [0x8250]})
            self.assert_stopped(system.truth(), FAULT_SLOT)
            self.assertEqual(system.json("bench_summary.json")["drives"][DRIVE]["quick_stops"], 1)

    def test_drives_that_do_not_hear_the_master_stop_by_themselves_with_emergency_8130(self):
        lost = [{"bus": 1, "id": "0x77F", "from_slot": FAULT_SLOT, "to_slot": 1000000, "action": "drop"}]
        with System(bus_script=lost) as system:
            client = system.client()
            client.enable()
            client.start_moving()
            state = client.until(lambda state: state["state"] == "FAULT")
            self.assert_fault(state, 3002, 8)  # pre-operational (1029), so silent
            client.go_on(1.0)
            system.shut_down(client)
            self.assertEqual(
                {node: codes[0] for node, codes in system.emergencies().items()},
                {node: 0x8130 for node in range(9, 16)},
            )
            self.assert_stopped(system.truth(), FAULT_SLOT, stop_deg=2.0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
