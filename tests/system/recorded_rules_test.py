"""Each safety rule over a recording can fail: good ticks pass it, one thing changed breaks it. Pairs of faults: what
is expected first.
"""
import re
import unittest

import support  # noqa: F401
from message import Messages

import campaign
import dispatch_rules
import pairs
import predicates
import recorded_rules as rules
import slit_truth
import truth_rules
import wire_ages
from liana.recordings import Fault, Tick, offsets

ENABLED, SWITCH_ON_DISABLED, IN_FAULT = 0x1237, 0x0250, 0x0218
LIMITS = rules.Limits(
    step_counts=36,
    following_counts=700,
    newtons_per_permille=0.6,
    heartbeat_ticks=75,
    slack_N=1.0,
    alarm_N=400.0,
    overload_N=600.0,
)
REACTIONS = {
    3002: rules.AT_ONCE,
    3003: rules.AT_ONCE,
    3004: rules.AT_ONCE,
    5001: rules.HOLD,
    5002: rules.OFF,
    6001: rules.AT_ONCE,
}
GOOD = Tick(
    tick=0,
    lost_ticks=0,
    lost_buses=0,
    twice=0,
    request="none",
    sequence=7,
    first_tick=0,
    expiry_tick=10**6,
    statusword=(ENABLED, ENABLED),
    torque=(70, 70),
    position=(1000, 2000),
    age=(0, 0),
    heartbeat_age=(5, 5),
    operational=(1, 1),
    state="ENABLED",
    stop_category=0,
    at_rest=1,
    active_sequence=0,
    faults=(),
    dropped=0,
    controlword=(0x0F, 0x0F),
    target=(1000, 2000),
    theta_rate=(0.0, 0.0),
)


def ticks(count, **fields):
    return [GOOD._replace(tick=i, **fields) for i in range(count)]


def changed(at, count=10, **fields):
    """Good ticks, from `at` on with these fields."""
    return [tick._replace(**fields) if tick.tick >= at else tick for tick in ticks(count)]


def fault(number, index=1, tick=5):
    return Fault(number, index, 0, tick)


STOPPED = {
    "faults": (fault(3003),),
    "state": "STOPPING",
    "stop_category": 2,
    "controlword": (0x02, 0x00),
    "statusword": (ENABLED, IN_FAULT),
}


class Rules(unittest.TestCase):
    def broken(self, complaints, *words):
        self.assertEqual(len(complaints) > 0, True, "the rule did not see it")
        for word in words:
            self.assertIn(word, complaints[0])

    def test_a_missing_tick_is_found_and_lost_deadlines_are_none(self):
        self.assertEqual(rules.missing_ticks(ticks(4)), [])
        self.broken(rules.missing_ticks(ticks(2) + [GOOD._replace(tick=3)]), "tick 3")
        self.assertEqual(rules.missing_ticks(ticks(2) + [GOOD._replace(tick=3, lost_ticks=1)]), [])

    def test_a_target_that_steps_too_far_is_found_where_the_drive_has_torque(self):
        self.assertEqual(rules.target_steps(changed(5, target=(1036, 2000)), LIMITS), [])
        self.broken(rules.target_steps(changed(5, target=(1000, 1963)), LIMITS), "tick 5", "drive 2 (node 2)")
        self.assertEqual(rules.target_steps(changed(5, target=(9000, 2000), controlword=(0, 0)), LIMITS), [])

    def test_a_target_that_lets_go_may_jump_so_far_and_not_again_and_again(self):
        limits = LIMITS._replace(let_go_counts=5000)
        self.assertEqual(rules.target_steps(changed(5, target=(6000, 2000)), limits), [])
        self.broken(rules.target_steps(changed(5, target=(6001, 2000)), limits), "tick 5", "drive 1 (node 1)")
        to_and_fro = [GOOD._replace(tick=i, target=(1000 + 3000 * (i % 2), 2000)) for i in range(10)]
        self.broken(rules.target_steps(to_and_fro, limits), "tick 7", "drive 1 (node 1)")

    def test_a_telecommand_before_its_time_after_its_expiry_or_never_released_is_found(self):
        self.assertEqual(rules.commands_out_of_time(ticks(10, active_sequence=7)), [])
        self.broken(rules.commands_out_of_time(ticks(10, active_sequence=7, expiry_tick=9)), "tick 9", "telecommand 7")
        self.broken(rules.commands_out_of_time(ticks(10, active_sequence=7, first_tick=1)), "tick 0")
        self.broken(rules.commands_out_of_time(ticks(10, active_sequence=8)), "telecommand 8")

    def test_a_telecommand_or_motion_while_a_fault_is_latched_is_found(self):
        held = (fault(5001),)
        self.assertEqual(rules.commands_while_latched(changed(5, faults=held)), [])
        self.broken(rules.commands_while_latched(changed(5, faults=held, active_sequence=7)), "tick 5")
        self.assertEqual(
            rules.commands_while_latched(changed(5, 6, faults=(fault(6001),), active_sequence=7)),
            [],
            "the gate is last",
        )
        long = changed(5, 600, faults=held, theta_rate=(0.0, 0.01))
        self.broken(rules.commands_while_latched(long), f"tick {5 + rules.PATH_STOP_TICKS + 1}", "still moves")

    def test_a_state_or_a_fault_that_is_not_documented_is_found(self):
        self.assertEqual(rules.states_not_documented(changed(5, **STOPPED), REACTIONS), [])
        self.broken(rules.states_not_documented(changed(5, state="FAULT"), REACTIONS), "FAULT follows ENABLED")
        self.broken(rules.states_not_documented(changed(5, faults=(fault(1234),)), REACTIONS), "1234")

    def test_enabling_that_nobody_asked_for_is_found(self):
        off = [GOOD._replace(tick=i, state="DISABLED", controlword=(0, 0)) for i in range(5)]
        begins = GOOD._replace(tick=5, state="ENABLING", controlword=(6, 6), request="enable")
        self.assertEqual(rules.enabling_unasked([*off, begins]), [])
        self.broken(rules.enabling_unasked([*off, begins._replace(request="none")]), "asked for is none")
        self.broken(rules.enabling_unasked([*off, begins._replace(faults=(fault(3002),))]), "1 faults")
        self.broken(rules.enabling_unasked([*off, off[0]._replace(tick=5, controlword=(0, 0x0F))]), "in DISABLED")

    def test_a_fault_that_goes_away_without_a_clear_is_found(self):
        faulty = [GOOD._replace(tick=i, state="FAULT", faults=(fault(3003),)) for i in range(5)]
        cleared = GOOD._replace(tick=5, state="DISABLED")
        self.broken(rules.faults_gone_unasked([*faulty, cleared]), "3003", "without a clear")
        faulty[3] = faulty[3]._replace(request="clear")
        self.assertEqual(rules.faults_gone_unasked([*faulty, cleared]), [])
        self.broken(rules.faults_gone_unasked([*faulty, cleared._replace(faults=(fault(3003),))]), "FAULT is left")

    def test_a_reaction_weaker_than_the_highest_latched_fault_asks_for_is_found(self):
        self.assertEqual(rules.weak_reactions(changed(5, **STOPPED), REACTIONS), [])
        for weaker, said in (
            ({"state": "ENABLED"}, "ENABLED"),
            ({"controlword": (0x0F, 0x00)}, "enable operation"),
            ({"controlword": (0x07, 0x00)}, "quick stop"),
            ({"stop_category": 1}, "category"),
            ({"faults": (fault(5001), fault(5002)), "stop_category": 3}, "disable voltage"),
        ):
            self.broken(rules.weak_reactions(changed(5, **{**STOPPED, **weaker}), REACTIONS), said)
        ramp = [tick._replace(state="ENABLING") for tick in ticks(5)] + [
            GOOD._replace(tick=5, **{**STOPPED, "controlword": (0x07, 0x00)})
        ]
        self.broken(rules.weak_reactions(ramp, REACTIONS), "quick stop")
        self.assertEqual(rules.weak_reactions(changed(5, faults=(fault(5001),), stop_category=1), REACTIONS), [])
        self.broken(
            rules.weak_reactions(changed(5, **{**STOPPED, "faults": (fault(5001),)}), REACTIONS),
            "keeps the drives",
        )

    def test_a_quick_stop_that_is_cut_short_is_found(self):
        stopping = [*ticks(5), *(GOOD._replace(tick=i, **STOPPED) for i in range(5, 9))]
        cut = GOOD._replace(tick=9, **{**STOPPED, "controlword": (0x00, 0x00)})
        self.broken(rules.quick_stops_cut_short([*stopping, cut], REACTIONS), "drive 1 (node 1)", "0x00")
        self.assertEqual(
            rules.quick_stops_cut_short(
                [*stopping, cut._replace(statusword=(SWITCH_ON_DISABLED, IN_FAULT))], REACTIONS
            ),
            [],
        )
        self.assertEqual(rules.quick_stops_cut_short([*stopping, cut._replace(faults=(fault(5002),))], REACTIONS), [])

    def test_a_stop_that_no_drive_confirmed_is_found(self):
        stopping = GOOD._replace(tick=4, **STOPPED)
        ended = GOOD._replace(tick=5, **{**STOPPED, "state": "FAULT", "statusword": (SWITCH_ON_DISABLED, IN_FAULT)})
        self.assertEqual(rules.stops_not_confirmed([stopping, ended]), [])
        self.broken(rules.stops_not_confirmed([stopping, ended._replace(age=(3, 0))]), "drive 1 (node 1)", "3008")
        self.broken(
            rules.stops_not_confirmed([stopping, ended._replace(statusword=(ENABLED, IN_FAULT))]), "drive 1 (node 1)"
        )
        self.assertEqual(
            rules.stops_not_confirmed([stopping, ended._replace(age=(3, 0), faults=(fault(3003), fault(3008, 0)))]), []
        )

    def test_everything_that_reports_show_wrong_has_to_be_latched(self):
        for number, wrong in (
            (3002, {"age": (0, 3)}),
            (3001, {"heartbeat_age": (0, 76)}),
            (3007, {"operational": (1, 0)}),
            (3003, {"statusword": (ENABLED, IN_FAULT)}),
            (3004, {"statusword": (ENABLED, SWITCH_ON_DISABLED)}),
            (5001, {"torque": (70, 1)}),
            (5002, {"torque": (70, 1001)}),
            (5003, {"torque": (70, 700)}),
            (3006, {"position": (1000, 2701)}),
        ):
            found = rules.faults_not_latched(changed(5, 60, **wrong), LIMITS)
            self.broken(found, f"({number}, 1)")
            every = tuple(fault(known) for known in (3001, 3002, 3003, 3004, 3006, 3007, 5001, 5002, 5003))
            self.assertEqual(rules.faults_not_latched(changed(5, 60, **wrong, faults=every), LIMITS), [])
        self.broken(rules.faults_not_latched(changed(5, lost_buses=2), LIMITS), "(4001, 1)")
        self.broken(rules.faults_not_latched(changed(5, twice=2), LIMITS), "(3009, 1)")
        self.broken(rules.faults_not_latched(changed(5, lost_ticks=3), LIMITS), "(2001, -1)")

    def test_a_serial_arms_encoder_that_jumps_and_a_joint_out_of_its_range_have_to_be_latched(self):
        limits = LIMITS._replace(jump_counts=500, ranges_counts=((0, 5000), (0, 5000)), following_counts=10**6)
        jumped = changed(5, position=(1000, 2501))
        self.broken(rules.faults_not_latched(jumped, limits), "(2003, 1)")
        self.assertEqual(rules.faults_not_latched(changed(5, position=(1000, 2500)), limits), [])
        self.assertEqual(rules.faults_not_latched(changed(5, position=(1000, 2501), faults=(fault(2003),)), limits), [])
        pushed = [tick._replace(position=(1000, 4000 + 400 * tick.tick)) for tick in ticks(5)]
        self.broken(rules.faults_not_latched(pushed, limits), "tick 4", "(2002, 1)")
        self.assertEqual(rules.faults_not_latched(pushed[:4], limits), [], "one reading is no joint out of its range")

    def test_slide_and_roll_of_a_base_have_no_slack_cable_but_jump_and_are_overloaded_on_either_side(self):
        limits = LIMITS._replace(base_jump_counts=(500,), following_counts=10**6)
        force = lambda permille: changed(5, 60, torque=(permille, 70))
        self.assertEqual(rules.faults_not_latched(force(0), limits), [], "no cable is slack")
        most = int(limits.overload_N / limits.newtons_per_permille)
        for side in (1, -1):
            self.assertEqual(rules.faults_not_latched(force(side * most), limits), [])
            self.broken(rules.faults_not_latched(force(side * (most + 1)), limits), "(5002, 0)")
        self.broken(rules.faults_not_latched(changed(5, position=(1501, 2000)), limits), "(2003, 0)")
        self.assertEqual(rules.faults_not_latched(changed(5, position=(1500, 3000)), limits), [])

    def test_limits_of_a_serial_arm_are_its_joints_and_no_cables(self):
        joint = {"low_deg": -90.0, "high_deg": 180.0, "rate_deg_s": 4.0}
        drives = {"counts_per_turn": 3600, "gear": 1, "zero_counts": [100, 100], "direction": [1, -1]}
        limits = rules.limits_of({"kind": "serial", "joints": [joint, joint], "drives": drives}, 0.004)
        self.assertEqual([[round(end) for end in ends] for ends in limits.ranges_counts], [[-810, 1910], [-1710, 1010]])
        self.assertAlmostEqual(limits.step_counts, 4.0 * 0.004 * 10 + 2)
        self.assertEqual((limits.slack_N, limits.overload_N), (-float("inf"), float("inf")))

    def test_a_drive_that_was_never_there_is_no_fault(self):
        self.assertEqual(
            rules.faults_not_latched(ticks(10, age=(0, 3), heartbeat_age=(0, 99), operational=(1, 0)), LIMITS), []
        )

    def test_a_fault_that_was_told_but_not_recorded_or_the_other_way_round_is_found(self):
        latched = changed(5, 40, faults=(fault(3002),))
        self.assertEqual(rules.faults_not_told(latched, {(3002, 1, 5)}), [])
        self.broken(rules.faults_not_told(latched, set()), "never told")
        self.broken(rules.faults_not_told(latched, {(3002, 1, 5), (3001, 1, 9)}), "not recorded")

    def test_torque_and_drums_that_move_while_the_arm_is_off_are_found(self):
        off = ticks(20, state="FAULT", controlword=(0, 0))
        self.assertEqual(rules.torque_while_off(off, [15] * 5 + [0] * 15), [])
        self.broken(rules.torque_while_off(off, [0] * 12 + [1] + [0] * 7), "slot 12")
        self.assertEqual(rules.drums_moving_while_off(off, ()), [])
        rolling = [tick._replace(position=(1000, 2000 + 2 * (tick.tick > 10))) for tick in off]
        self.broken(rules.drums_moving_while_off(rolling, ()), "drive 2 (node 2)")
        self.assertEqual(rules.drums_moving_while_off(rolling, {1}), [])

    def test_reactions_are_those_of_the_page_written_by_hand_and_each_has_its_reason(self):
        found = rules.reactions_by_hand()
        self.assertEqual((found[5001], found[3002], found[5002]), (rules.HOLD, rules.AT_ONCE, rules.OFF))
        numbers = {int(number) for number in re.findall(r"^\| (\d{4}) \|", FAULTS_PAGE.read_text(), re.MULTILINE)}
        self.assertEqual(numbers - found.keys(), set(), "each fault needs a row written by hand")
        for number, row in rules.page_of_reactions().items():
            self.assertGreater(len(row["why"]), 20, number)
            self.assertFalse(row["retract"] and row["reaction"] != "hold", number)
        self.assertEqual(
            rules.retracts_by_hand(), {1001, 2004, 2005, 5001, 5003, 5004, 5005, 5007, 5008, 5009, 5010, 5011}
        )

    def test_a_way_back_is_no_command_out_of_time_where_all_that_is_latched_allows_it(self):
        held = changed(5, faults=(fault(5001),), active_sequence=7)
        self.assertEqual(rules.commands_while_latched(held, {5001}), [])
        both = changed(5, faults=(fault(5001), fault(3002)), active_sequence=7)
        self.broken(rules.commands_while_latched(both, {5001}), "tick 5")
        self.broken(rules.commands_while_latched([tick._replace(dropped=1) for tick in held], {5001}), "tick 5")

    def test_an_arm_on_its_way_back_has_as_long_to_stop_as_any_other(self):
        both = (fault(5001), fault(3002)._replace(tick=300))
        moving = [
            GOOD._replace(tick=tick, faults=both if tick >= 300 else both[:1], theta_rate=(0.1, 0.0))
            for tick in range(200, 310)
        ]
        self.assertEqual(rules.commands_while_latched(moving, {5001}), [])
        late = [tick._replace(tick=tick.tick + rules.PATH_STOP_TICKS) for tick in moving]
        late = [tick._replace(faults=both if tick.tick >= 300 else both[:1]) for tick in late]
        self.broken(rules.commands_while_latched(late, {5001}), f"tick {301 + rules.PATH_STOP_TICKS}", "3002")

    def test_a_full_list_of_faults_hides_nothing(self):
        weak = changed(5, **{**STOPPED, "stop_category": 0, "dropped": 3})
        self.broken(rules.weak_reactions(weak, REACTIONS), "the stop category is 0")
        silent = changed(5, age=(3, 3), faults=(fault(3002, 0),))
        self.broken(rules.faults_not_latched(silent, LIMITS), "(3002, 1)")
        self.assertEqual(rules.faults_not_latched([tick._replace(dropped=1) for tick in silent], LIMITS), [])
        cleared = [tick._replace(dropped=1) for tick in silent] + [GOOD._replace(tick=len(silent) + 1)]
        self.assertEqual(rules.faults_not_latched(cleared, LIMITS), [], "an operator's clear emptied the full list")
        stopping = GOOD._replace(tick=4, **STOPPED)
        ended = GOOD._replace(tick=5, **{**STOPPED, "state": "FAULT", "age": (3, 3), "dropped": 1})
        self.broken(rules.stops_not_confirmed([stopping, ended]), "drive 2 (node 2)", "3008")
        self.assertEqual(rules.stops_not_confirmed([stopping, ended._replace(dropped=2)]), [])

    def test_a_false_alarm_is_found(self):
        alarm = changed(5, faults=(fault(3002),))
        self.broken(rules.false_alarms(alarm, LIMITS, 0), "no report shows why")
        self.assertEqual(rules.false_alarms(changed(5, faults=(fault(3002),), age=(0, 3)), LIMITS, 0), [])
        self.broken(rules.false_alarms(changed(5, faults=(fault(5006),)), LIMITS, 8), "nothing has happened yet")
        self.assertEqual(rules.false_alarms(changed(5, faults=(fault(5006),)), LIMITS, 5), [])


class Wire(unittest.TestCase):
    def test_ages_are_counted_from_what_was_on_the_wire(self):
        least, most = wire_ages.ages([9, 10, 11, 15], 11, 6)
        self.assertEqual(least, [0, 0, 1, 2, 0, 0])
        self.assertEqual(most, [0, 0, 1, 2, 3, 0])

    def test_a_report_that_never_was_on_the_wire_is_found_and_one_that_was_and_is_taken_for_lost(self):
        logs = [
            "".join(f"({slot * 0.004 + 0.001:.6f}) can0 18{node}#3712E803000046FF\n" for slot in range(10))
            for node in (1, 2)
        ]
        arrivals = wire_ages.Arrivals(logs, predicates.LINE, 0.004)
        self.assertEqual(wire_ages.wrong_ages(ticks(10), arrivals), [])
        believed = wire_ages.wrong_ages(ticks(20), arrivals)
        self.assertIn("tick 11", believed[0])
        lost = wire_ages.wrong_ages(changed(5, age=(0, 3)), arrivals)
        self.assertIn("drive 2 (node 2)", lost[0])
        self.assertEqual(wire_ages.wrong_ages(changed(5, age=(0, 3)), arrivals, {1}), [])
        short = [logs[0], logs[1].replace("46FF", "46")]
        self.assertIn(
            "drive 2 (node 2)", wire_ages.wrong_ages(ticks(10), wire_ages.Arrivals(short, predicates.LINE, 0.004))[0]
        )


class FakeTruth:
    """Rows of a truth in which all is well, but for `wrong`: column -> value from row 70 on."""

    columns = ["theta_deg_1", "theta_deg_2", "clearance_m", "contact_force_N", "tension_min_N", "tension_motor_min_N"]
    columns += ["tension_motor_max_N", "tip_speed_m_s", "fastest_deg_s", "slit_depth_m"]

    def __init__(self, **wrong):
        good = dict(zip(self.columns, (1.0, -2.0, 0.02, 0.0, 5.0, 20.0, 80.0, 0.03, 1.0, -1.0)))
        self.rows = [tuple({**good, **(wrong if i >= 70 else {})}.values()) for i in range(100)]

    def theta_deg(self, row):
        return self.rows[row][:2]

    def column(self, name):
        return [row[self.columns.index(name)] for row in self.rows]


class TruthRules(unittest.TestCase):
    ROBOT = {
        "segments": [{"theta_limit_deg": 20}],
        "tension": {"floor_motor_N": 15, "floor_anywhere_N": 1, "hard_limit_N": 600},
        "limits": {"theta_rate_deg_s": 2, "tip_speed_m_s": 0.1, "tip_speed_slit_m_s": 0.03},
    }

    def complaints(self, faults=(), begun=None, recorded=None, nominal=True, **wrong):
        courses = [{"begun_slot": begun} for _ in faults]
        return truth_rules.all_complaints(
            FakeTruth(**wrong), recorded or ticks(100), self.ROBOT, faults, courses, nominal
        )

    def test_each_rule_finds_what_breaks_it(self):
        self.assertEqual(self.complaints(), [])
        for wrong, words in (
            ({"contact_force_N": 0.1}, "contact"),
            ({"clearance_m": 0.0}, "clearance"),
            ({"tension_min_N": 0.9}, "along a cable"),
            ({"tension_motor_min_N": 14.9}, "at a motor"),
            ({"tension_motor_max_N": 601.0}, "601 N"),
            ({"theta_deg_2": -20.3}, "theta 2"),
            ({"tip_speed_m_s": 0.111}, "the tip moves"),
            ({"tip_speed_m_s": 0.032, "slit_depth_m": 0.1}, "the tip moves"),
            ({"fastest_deg_s": 2.6}, "an angle turns"),
        ):
            found = self.complaints(**wrong)
            self.assertEqual(len(found), 1, wrong)
            self.assertIn("slot 70", found[0])
            self.assertIn(words, found[0])

    def test_tension_at_motors_is_judged_where_cables_are_as_planned_with(self):
        self.assertEqual(self.complaints(tension_motor_min_N=14.0, nominal=False), [])
        self.assertEqual(len(self.complaints(tension_motor_min_N=0.5, nominal=False)), 1)

    def test_damage_excuses_what_comes_after_it_and_faults_of_reports_nothing(self):
        broken, silent = {"kind": "cable_break"}, {"kind": "silent"}
        self.assertEqual(self.complaints([broken], 70, contact_force_N=3.0, tension_min_N=0.0), [])
        self.assertEqual(len(self.complaints([broken], 71, contact_force_N=3.0)), 1)
        self.assertEqual(len(self.complaints([silent], 10, contact_force_N=3.0)), 1)
        self.assertEqual(len(self.complaints([broken], None, contact_force_N=3.0)), 1, "it never began")

    def test_speeds_and_tensions_are_those_of_an_arm_under_command(self):
        stopped = [now._replace(state="STOPPING") if now.tick > 60 else now for now in ticks(100)]
        self.assertEqual(self.complaints(recorded=stopped, fastest_deg_s=9.0, tension_motor_min_N=3.0), [])


FAULTS_PAGE = support.SOURCE / "docs" / "reference" / "faults.md"
TIPS = [  # angles and tip of the bench's truth
    (
        [
            -8.517465857,
            0.003947056,
            -11.980051075,
            -0.026629581,
            7.997419565,
            -1.989276557,
            12.990021081,
            0.035630328,
            12.035636236,
            -2.001238218,
        ],
        [0.644058122, -1.521263449, 0.021571347],
    ),
    (
        [
            -4.528717304,
            -9.5587893,
            1.557622364,
            -0.076246303,
            3.850827601,
            10.378454202,
            -0.009450221,
            7.296119564,
            0.028607905,
            -4.760977983,
        ],
        [2.343745603, -0.733744265, 0.513246383],
    ),
]


class SlitTruth(unittest.TestCase):
    def test_links_are_where_the_golden_arm_has_its_tip(self):
        robot = {"segments": [{"modules": 8, "module_length_m": 0.1}] * 5}
        self.assertEqual([round(x, 12) for x in slit_truth.joint_centres_m(robot, [0.0] * 10)[-1]], [4.0, 0.0, 0.0])
        for theta_deg, tip_m in TIPS:
            for got, wanted in zip(slit_truth.joint_centres_m(robot, theta_deg)[-1], tip_m):
                self.assertAlmostEqual(got, wanted, 6)


class Recordings(unittest.TestCase):
    def test_fields_of_arrays_of_structures_lie_one_structure_after_the_other(self):
        found = offsets([("tick", 8), ("drive[2].word", 2), ("drive[2].place[2]", 4), ("end", 1)])
        self.assertEqual(found["drive.word"], [(8, 2), (18, 2)])
        self.assertEqual(found["drive.place"], [(10, 4), (14, 4), (20, 4), (24, 4)])
        self.assertEqual(found["end"], [(28, 1)])


class Pairs(unittest.TestCase):
    def test_every_pair_of_the_members_is_there_once_and_delays_reach_50_ticks(self):
        found = pairs.all_pairs()
        count = len(pairs.MEMBERS)
        self.assertGreaterEqual(count, 12)
        self.assertEqual(
            len({frozenset(member.name for member in pair.members) for pair in found}), count * (count - 1) // 2
        )
        self.assertEqual({pair.delay for pair in found}, set(pairs.DELAYS))
        self.assertEqual(sum(pair.reduced for pair in found), len(pairs.REDUCED))

    def test_the_one_that_is_found_sooner_is_expected_first_and_in_one_tick_the_lower_index(self):
        member = {member.name: member for member in pairs.MEMBERS}
        self.assertEqual(pairs.Pair(member["silent"], member["fault"], 3).expected_first(), [(3002, 3)])
        self.assertEqual(pairs.Pair(member["silent"], member["fault"], 1).expected_first(), [(3003, 10)])
        self.assertEqual(pairs.Pair(member["missing"], member["silent"], 0).expected_first(), [(3002, 3)])
        self.assertEqual(pairs.Pair(member["slack"], member["cable_break"], 5).expected_first(), [(5006, 9)])
        self.assertEqual(pairs.Pair(member["operator_stop"], member["sto"], 5).expected_first(), [(3004, 1)])


class Campaign(unittest.TestCase):
    def test_a_seed_always_gives_the_same_one_to_four_faults_and_another_seed_others(self):
        def faults(seed):
            sequence = campaign.Sequence(seed)
            return sequence.bench_faults + sequence.bus_script

        found = [faults(seed) for seed in range(1, 201)]
        self.assertEqual(found, [faults(seed) for seed in range(1, 201)])
        self.assertEqual({len(one) for one in found}, {1, 2, 3, 4})
        self.assertEqual(
            {fault["kind"] for one in found for fault in one if "kind" in fault}, set(campaign.BENCH_KINDS)
        )
        self.assertEqual(
            {fault["action"] for one in found for fault in one if "action" in fault}, set(campaign.BUS_ACTIONS)
        )
        self.assertGreater(len({str(one) for one in found}), 190)

    def test_what_the_operator_does_depends_on_the_seed_and_the_state(self):
        state = {"state": "ENABLED", "setpoint_js_deg": [18.0] * 10, "setpoint_cp": [0, 0, 4, 1, 0, 0, 0]}
        actions = [campaign.Sequence(seed).action(state) for seed in range(1, 101)]
        self.assertEqual(actions, [campaign.Sequence(seed).action(state) for seed in range(1, 101)])
        moves = [fields["goal_deg"] for op, fields in filter(None, actions) if op == "move_jp"]
        self.assertGreater(len(moves), 10)
        self.assertLessEqual(max(abs(theta) for goal in moves for theta in goal), 19.0)


class Dispatch(Messages, unittest.TestCase):
    """Telecommand 7 of GOOD, and what commands.txt has to say of it."""

    def complaints(self, *stages, ticks=(GOOD._replace(tick=20),)):
        lines = ["# heading"] + [
            "\t".join([str(tick), stage, "7", number, "", "", "", ""]) for tick, stage, number in stages
        ]
        return dispatch_rules.unverified(ticks, lines)

    def test_what_both_ends_passed_and_was_released_is_well(self):
        life = [(10, "setpoint", "2"), (10, "execution", ""), (10, "simulation", ""), (10, "release", "15")]
        self.assertEqual(self.complaints(*life), [])
        self.assertEqual(self.complaints(*life, ticks=[]), [])

    def test_a_command_that_nobody_released_is_named_once(self):
        good = GOOD._replace(tick=20)
        found = self.complaints((10, "setpoint", "2"), ticks=[good, good._replace(tick=21)])
        self.assertEqual(len(found), 1)
        self.assert_names(found[0], "tick 20", "command 7", "never released")
        active = good._replace(sequence=0, active_sequence=7)
        self.assertEqual(len(self.complaints(ticks=[active])), 1)

    def test_a_release_needs_both_ends(self):
        for stage in ("execution", "simulation"):
            other = "simulation" if stage == "execution" else "execution"
            for verdict in ([], [(10, stage, "208")]):
                life = [(10, "setpoint", "2"), (10, other, ""), *verdict, (10, "release", "15")]
                (found,) = self.complaints(*life)
                self.assert_names(found, "tick 10", "command 7", "without", stage)

    def test_what_an_earlier_setpoint_of_the_same_number_passed_does_not_count(self):
        life = [(9, "setpoint", "2"), (9, "execution", ""), (9, "simulation", ""), (10, "setpoint", "2")]
        self.assertEqual(len(self.complaints(*life, (10, "release", "15"))), 1)

    def test_a_command_comes_after_its_release(self):
        life = [(30, "setpoint", "2"), (30, "execution", ""), (30, "simulation", ""), (30, "release", "35")]
        (found,) = self.complaints(*life)
        self.assert_names(found, "tick 20", "command 7", "before")


if __name__ == "__main__":
    unittest.main(verbosity=2)
