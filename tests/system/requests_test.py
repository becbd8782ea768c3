"""Targets no arm can reach and packets nobody can read: one clear answer each, and the arm stays where it is."""
import json
import math
import unittest

from support import SystemTest
from liana.client import LianaError
from liana.system import System

UPRIGHT = [1.0, 0.0, 0.0, 0.0]


class Requests(SystemTest):
    """One running system for all; every test leaves the arm enabled, at rest, and another client served."""

    @classmethod
    def setUpClass(cls):
        cls.system = cls.enterClassContext(System())
        cls.client = cls.system.client()
        cls.other = cls.system.client("other", "observer", lockstep=False)
        cls.client.enable()

    def setUp(self):
        self.client.until(lambda state: state["at_rest"] and not state["is_busy"])
        self.client.complaints.clear()
        self.start_deg = list(self.client.state["setpoint_js_deg"])

    def tearDown(self):
        self.client.go_on(0.3)
        self.assert_holds(self.client.state)
        self.assertEqual(self.client.state["faults"], [])
        for now, before in zip(self.client.state["setpoint_js_deg"], self.start_deg):
            self.assertAlmostEqual(now, before, delta=1e-3)
        tick = self.client.state["tick"]
        while self.other.next_state()["tick"] < tick:
            pass

    def tip(self):
        return list(self.client.state["setpoint_cp"])

    def test_a_tip_target_out_of_reach_is_refused_with_the_reach(self):
        for op in ("move_cp", "servo_cp"):
            self.assert_refused(self.client.ask(op, goal=[3.5, 3.5, 0.0] + UPRIGHT), "out_of_range", "reaches 4")

    def test_huge_numbers_are_refused_with_the_allowed_range(self):
        for op in ("move_cp", "servo_cp"):
            for i in range(7):
                for huge in (1e300, -1e300, 1.7976931348623157e308):
                    goal = self.tip()
                    goal[i] = huge
                    self.assert_refused(self.client.ask(op, goal=goal), "out_of_range", f"goal[{i}]", "allowed")
        self.assert_refused(
            self.client.ask("move_jp", goal_deg=[1e300] + [0.0] * 9), "out_of_range", "goal_deg[0]", "allowed"
        )

    def test_nan_and_infinity_are_not_json_and_are_refused(self):
        for op, field, count in (("move_cp", "goal", 7), ("servo_cp", "goal", 7), ("move_jp", "goal_deg", 10)):
            for word in (math.nan, math.inf, -math.inf):
                message = {"op": op, field: [word] * count}
                with self.assertRaisesRegex(LianaError, op):
                    self.client.send(message)
                self.client.send(json.dumps(message).encode())
                self.client.step()
                self.client.step()
                self.assert_refused(self.client.complaints.pop(), "bad_request", "not JSON")
                self.assertEqual(self.client.complaints, [])

    def test_numbers_beyond_a_double_are_refused(self):
        for number in ("1e999", "-1e400"):
            self.client.send(f'{{"op":"move_jp","goal_deg":[0,{number},0,0,0,0,0,0,0,0]}}'.encode())
            self.client.step()
            self.client.step()
            self.assert_refused(self.client.complaints.pop(), "out_of_range", f"goal_deg[1]: {number}: allowed")

    def test_words_instead_of_numbers_are_refused(self):
        for word in ("NaN", None, True, [], {}):
            self.assert_refused(
                self.client.ask("move_cp", goal=[word] + self.tip()[1:]), "bad_request", "goal[0]", "number"
            )
            self.assert_refused(
                self.client.ask("move_jp", goal_deg=[0.0] * 9 + [word]), "bad_request", "goal_deg[9]", "number"
            )

    def test_the_wrong_number_of_values_is_refused(self):
        for op, field, counts in (
            ("move_cp", "goal", (0, 6, 8)),
            ("servo_cp", "goal", (0, 6, 8)),
            ("move_jp", "goal_deg", (0, 9, 11, 80)),
        ):
            for count in counts:
                self.assert_refused(self.client.ask(op, **{field: [0.1] * count}), "bad_request", field, "array of")
            self.assert_refused(self.client.ask(op), "bad_request", field, "missing")

    def test_a_quaternion_that_is_not_of_unit_length_is_refused(self):
        for op in ("move_cp", "servo_cp"):
            for quaternion in ([0.0] * 4, [1.0, 0.01, 0.0, 0.0], [0.5] * 3 + [0.4999]):
                self.assert_refused(
                    self.client.ask(op, goal=self.tip()[:3] + quaternion), "out_of_range", "quaternion", "1e-6"
                )

    def test_angles_over_the_limits_are_refused_with_the_limits(self):
        for i in range(10):
            for angle in (20.01, -20.01, 179.0):
                goal = list(self.start_deg)
                goal[i] = angle
                self.assert_refused(
                    self.client.ask("move_jp", goal_deg=goal), "out_of_range", f"goal_deg[{i}] (theta {i + 1})", "20"
                )

    def test_rates_over_the_limit_are_refused(self):
        for rate in (2.1, 0.0, -1.0, 1e300):
            self.assert_refused(
                self.client.ask("move_jp", goal_deg=self.start_deg, rate_deg_s=rate), "out_of_range", "rate_deg_s", "2"
            )

    def test_held_angles_and_nodes_out_of_range_are_refused(self):
        self.assert_refused(
            self.client.ask("hold_theta", held=[{"theta": 11, "target_deg": 0}]), "out_of_range", "theta"
        )
        self.assert_refused(
            self.client.ask("hold_theta", held=[{"theta": 9, "target_deg": 21}]), "out_of_range", "target_deg"
        )
        self.assert_refused(self.client.ask("hold_theta", held=[7]), "bad_request")
        self.assert_refused(
            self.client.ask("shape", nodes=[{"node": 5, "position_m": [0, 0, 0]}]), "out_of_range", "node"
        )
        self.assert_refused(
            self.client.ask("shape", nodes=[{"node": 3, "position_m": [0, 0]}]), "bad_request", "position_m"
        )
        self.assert_refused(
            self.client.ask("shape", nodes=[{"node": 3, "position_m": [1, 0, 0], "wieght": 2}]),
            "bad_request",
            "wieght",
            "weight",
        )
        self.assert_refused(
            self.client.ask("shape", nodes=[], keep_clear=[{"center_m": [0, 0, 99], "distance_m": 0.1}]),
            "out_of_range",
            "center_m",
        )
        self.assert_refused(
            self.client.ask("shape", nodes=[], keep_clear=[{"centre_m": [1, 0, 0], "distance_m": 0.1}]),
            "bad_request",
            "centre_m",
            "center_m",
        )
        self.assert_refused(
            self.client.ask("shape", nodes=[], keep_clear=[{"center_m": [1, 0, 0]}]), "bad_request", "distance_m"
        )
        self.assert_refused(
            self.client.ask("shape", nodes=[], keep_clear=[{"center_m": [1, 0, 0], "distance_m": 0.1}] * 5),
            "bad_request",
            "keep_clear",
        )

    def test_an_unknown_op_is_named(self):
        self.assert_refused(self.client.ask("fly"), "bad_request", "fly")
        self.assert_refused(self.client.ask("x" * 5000), "bad_request", "op")

    def test_packets_that_are_no_request_get_one_clear_answer_each(self):
        packets = {
            b"\x00\xff\xfe": "JSON",
            b"hello": "JSON",
            b"{": "JSON",
            b"[1,2]": "object",
            b"7": "object",
            b"{}": "op",
            b'{"op":7}': "op",
            b'{"op":"hello","name":"twice","role":"client"}': "already",
            b'{"op":"hold","id":"x"}': "id",
            b'{"op":"\xc3\x28"}': "JSON",
            b"[" * 60000: "JSON",
            b" " * 140000: "131072",
        }
        for packet, word in packets.items():
            self.client.send(packet)
            self.client.step()
            self.client.step()
            self.assertEqual(len(self.client.complaints), 1, packet[:40])
            self.assert_refused(self.client.complaints.pop(), "bad_request", word)

    def test_who_does_not_say_hello_properly_is_told_how(self):
        hellos = [
            ({"op": "acquire"}, "hello"),
            ({"op": "hello", "role": "client"}, "name"),
            ({"op": "hello", "name": "x", "role": "king"}, "king"),
            ({"op": "hello", "name": "x", "role": "client", "subscribe": ["weather"]}, "subscribe"),
            ({"op": "hello", "name": 5, "role": "client"}, "name"),
            ({"op": "hello", "name": "x", "role": "client", "subscribe": 5}, "subscribe"),
        ]
        for hello, word in hellos:
            stranger = self.system.stranger()
            stranger.send(hello)
            self.client.go_on(0.1)
            self.assert_refused(stranger.receive(), "bad_request", word)
            stranger.close()

    def test_only_a_camera_sends_pictures_and_only_a_mission_announces(self):
        self.assert_refused(self.client.ask("camera", capture_time_s=0, slit=None, rod=None), "bad_request", "camera")
        self.assert_refused(self.client.ask("announce", step=None), "bad_request", "mission")

    def test_a_device_nobody_serves_is_refused(self):
        self.assert_refused(self.client.ask("use_device", device="vr"), "no_device", "connected: none")
        self.assert_refused(self.client.ask("use_device", device="piano"), "no_device", "piano")

    def test_an_observer_that_asks_for_motion_does_not_get_it(self):
        self.client.call("release")
        number = self.other.request("acquire")
        self.client.go_on(0.1)
        while number not in self.other.answers:
            self.other.next_state()
        self.assert_refused(self.other.answers.pop(number), "not_owner", "observer")
        self.client.call("acquire")


def between(a, b, share):
    """A pose on the way from a to b: straight, and turning about one axis."""
    cosine = sum(x * y for x, y in zip(a[3:], b[3:]))
    end = [y if cosine >= 0 else -y for y in b[3:]]
    half_turn = math.acos(min(1.0, abs(cosine)))
    first, second = (1 - share, share)
    if half_turn > 1e-6:
        first, second = (math.sin(part * half_turn) / math.sin(half_turn) for part in (1 - share, share))
    quaternion = [first * x + second * y for x, y in zip(a[3:], end)]
    return [x + share * (y - x) for x, y in zip(a[:3], b[:3])] + [q / math.hypot(*quaternion) for q in quaternion]


def stream_to(client, goal):
    """Leads the tip's goal away in the largest steps that one servo_cp may make; the last answer."""
    start = list(client.state["setpoint_cp"])
    turn_deg = 2 * math.degrees(math.acos(min(1.0, abs(sum(x * y for x, y in zip(start[3:], goal[3:]))))))
    count = math.ceil(max(math.dist(start[:3], goal[:3]) / 0.049, turn_deg / 9.9, 1))
    for i in range(count):
        answer = client.ask("servo_cp", goal=between(start, goal, (i + 1) / count))
        if answer["op"] != "ok":
            break
    return answer


class StreamsOfTipGoals(SystemTest):
    """Sequence, time to live and jumps of servo_cp: nothing stale is accepted, nobody's stillness goes unseen."""

    @classmethod
    def setUpClass(cls):
        cls.system = cls.enterClassContext(System())
        cls.client = cls.system.client()
        cls.client.enable()

    def raised(self, height_m):
        return [value + (height_m if i == 2 else 0.0) for i, value in enumerate(self.client.state["setpoint_cp"])]

    def test_an_owner_that_stands_still_in_the_middle_of_a_stream_is_named_and_the_arm_holds_in_time(self):
        for number in range(1, 30):
            self.client.call("servo_cp", goal=self.raised(0.02), sequence=number, ttl_s=0.2)
        last = self.client.state
        self.assertFalse(last["at_rest"])
        told = self.client.until(lambda state: any("stands still" in event["text"] for event in state["events"]), 1.0)
        event = next(event for event in told["events"] if "stands still" in event["text"])
        self.assert_names(event["text"], "test", "servo_cp", "0.2 s", "ttl_s")
        self.assertLessEqual((event["tick"] - last["tick"]) * self.client.welcome["period_s"], 0.2)
        self.assert_holds(self.client.until(lambda state: state["at_rest"]))
        self.assert_refused(self.client.ask("servo_cp", goal=self.raised(0), sequence=29), "refused", "sequence", "30")
        self.client.call("servo_cp", goal=self.raised(0), sequence=30)

    def test_a_goal_that_jumps_is_refused_with_the_bound_and_the_way_out(self):
        self.client.until(lambda state: state["at_rest"])
        self.assert_refused(
            self.client.ask("servo_cp", goal=self.raised(-0.06)), "out_of_range", "goal", "0.05 m", "move_cp"
        )
        self.client.go_on(0.2)
        self.assert_holds(self.client.state)


class TargetsTheArmCannotFollow(SystemTest):
    def test_targets_in_range_that_the_arm_cannot_take_end_in_a_hold_or_a_named_cable_fault(self):
        with System() as system:
            client = system.client()
            client.enable()
            first = client.state["tick"]
            for goal in ([-3.9, 0.1, 0.2] + UPRIGHT, [0.0, 0.0, 0.0] + UPRIGHT, [3.99, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]):
                answer = stream_to(client, goal)
                self.assertIn(answer.get("code"), (None, "fault"), answer)
                client.go_on(1.0)
                self.assertEqual(client.state["state"], "ENABLED")
                self.assertLessEqual({fault["name"] for fault in client.state["faults"]}, {"cable_slack"})
                client.ask("hold")
                client.until(lambda state: state["at_rest"])
            client.call("state_command", command="disable")
            client.until(lambda state: state["state"] in ("DISABLED", "FAULT"))
            client.go_on(3.0)
            system.shut_down(client)
            truth = system.truth()
            self.assertLess(
                max(abs(angle) for row in range(first, len(truth.rows), 25) for angle in truth.theta_deg(row)), 20.5
            )
            self.assertLess(max(truth.column("contact_force_N")), 5.0)
            # With cables slack little pulls the arm back, and nothing damps it: it swings for minutes, up to 0.03 deg
            # in half a second and 0.16 deg since the brakes began to close. Drums that run free would show degrees.
            off = max(row for row, count in enumerate(truth.column("enabled")) if count > 0)
            self.assert_stopped(truth, off, stop_deg=0.5, swing_deg=0.1)

    # req:C12
    def test_a_stream_into_the_arm_itself_ends_in_a_hold_from_which_the_arm_retracts(self):
        with System(scene="none", bench=("--start-pose", "panel_edge")) as system:
            client = system.client()
            client.enable()
            goal, node_m = list(client.state["setpoint_cp"]), client.state["node_m"][0]
            way_m = math.dist(node_m, goal[:3])
            step_m = [0.0016 * (b - a) / way_m for a, b in zip(goal, node_m)]
            while not client.state["refusals"]:
                goal = [*(x + step for x, step in zip(goal, step_m)), *goal[3:]]
                self.assertEqual(client.ask("servo_cp", goal=goal)["op"], "ok")
                client.step()
            self.assertEqual(client.state["verdict"]["name"], "self_contact")
            client.until(lambda state: state["at_rest"])
            self.assert_holds(client.state)
            client.call("retract")
            client.until(lambda state: state["retract"]["phase"] in ("back", "done"))


class Shapes(SystemTest):
    # req:A43
    def test_a_search_finds_the_shape_that_brings_a_node_to_its_target_while_the_tip_stays(self):
        with System() as system:
            client = system.client()
            client.enable()
            tip, node = client.state["setpoint_cp"], client.state["node_m"][2]
            target = [node[0], node[1] + 0.1, node[2] + 0.1]
            client.call("shape", nodes=[{"node": 3, "position_m": target, "threshold_m": 0.0}], search=True)
            client.go_on(1.0)
            self.assert_refused(client.ask("shape", nodes=[], search=True), "busy", "rest")
            client.until(lambda state: math.dist(state["node_m"][2], target) < 0.005, limit_s=200.0)
            self.assertLess(math.dist(client.state["setpoint_cp"][:3], tip[:3]), 1e-5)


if __name__ == "__main__":
    unittest.main(verbosity=2)
