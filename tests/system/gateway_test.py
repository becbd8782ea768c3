"""The console's gateway against lianad and the simulated arm (docs/reference/console-protocol.md)."""
import contextlib
import json
import os
import pathlib
import re
import signal
import socket
import struct
import subprocess
import tempfile
import threading
import time
import unittest

from support import SystemTest
from console_client import BINARY, Closed, Console, Refused, WebSocket, http_get
from gateway_support import Gateway, GatewayAloneTest
from liana.client import wait_until
from liana.system import System, program


class GatewayTest(SystemTest):
    """A system whose time one lockstep client lets go on: `pace` of them a second while the block runs."""

    def setUp(self):
        self.system = self.enterContext(System())
        self.keeper = self.system.client("keeper", "client")
        self.gateway = Gateway(self, self.system.api)
        self.states = {}  # by tick, as lianad tells them
        self.over = False
        self.thread = threading.Thread(target=self.keep_going)
        self.thread.start()
        self.addCleanup(self.stop_keeping)

    def keep_going(self):
        with contextlib.suppress(OSError):
            while not self.over:
                state = self.keeper.step()
                self.states[state["tick"]] = state
                time.sleep(0.004)

    def stop_keeping(self):
        self.over = True
        self.thread.join()

    def console(self, name="anna", **options):
        console = Console(self.gateway.address, name, **options)
        self.addCleanup(console.close)
        return console


class WhatAClientSees(GatewayTest):
    # req:A21
    def test_records_and_facts_say_what_lianads_state_says(self):
        console = self.console().until(lambda me: len(me.sequences) > 5 and me.facts.get("is_homed"))
        self.assertEqual(console.welcome["protocol"], 1)
        self.assertEqual((console.welcome["role"], console.welcome["name"]), ("operate", "anna"))
        self.assertEqual(console.welcome["robot"], self.keeper.welcome["robot"])
        wait_until(lambda: console.state["tick"] in self.states, "the same state")
        said = self.states[console.state["tick"]]
        flat = {
            "measured_js_deg": said["measured_js_deg"],
            "setpoint_cp": said["setpoint_cp"],
            "tension_N": said["tension_N"],
            "node_m": sum(said["node_m"], []),
            "drives.position_m": [drive["position_m"] for drive in said["drives"]],
            "drives.torque_permille": [drive["torque_permille"] for drive in said["drives"]],
            "buses.frames": [bus["frames"] for bus in said["buses"]],
            "friction.mu": [said["friction"]["mu"]],
        }
        for name, numbers in flat.items():
            with self.subTest(name):
                self.assertEqual(console.state[name], [struct.unpack("f", struct.pack("f", n))[0] for n in numbers])
        self.assertEqual(console.state["time_s"], said["time_s"])
        console.until(lambda me: me.header[1] == me.facts_number)
        wait_until(lambda: console.state["tick"] in self.states, "the state of the facts")
        for name in ("state", "is_homed", "owner", "held", "faults"):
            self.assertEqual(console.facts[name], self.states[console.state["tick"]][name], name)
        self.assertNotIn("measured_js_deg", console.facts)

    def test_metrics_are_samples_that_prometheus_reads_and_say_what_the_state_says(self):
        self.console().until(lambda me: me.facts.get("is_homed"))
        status, headers, body = http_get(self.gateway.address, "/metrics")
        self.assertEqual(status, 200)
        self.assertIn("version=0.0.4", headers)
        samples = {}
        for line in body.decode().splitlines():
            if line.startswith("# "):
                self.assertRegex(line, r"^# (HELP|TYPE) liana_[a-z_]+ .+$")
                continue
            found = re.fullmatch(r'(liana_[a-z_]+(?:\{(?:[a-z]+="[^"]*",?)+\})?) (-?[0-9.e+-]+)', line)
            self.assertTrue(found, line)
            self.assertNotIn(found[1], samples)
            samples[found[1]] = float(found[2])
        self.assertEqual((samples["liana_up"], samples["liana_gateway_clients"], samples["liana_faults"]), (1, 1, 0))
        self.assertEqual(sum(value for name, value in samples.items() if name.startswith("liana_state{")), 1)
        self.assertEqual(samples['liana_state{state="DISABLED"}'], 1)
        said = min(self.states.values(), key=lambda state: abs(state["time_s"] - samples["liana_arm_time_seconds"]))
        tensions = [samples[f'liana_tension_newtons{{cable="{i}"}}'] for i in range(1, 16)]
        self.assertEqual(len(said["tension_N"]), len(tensions))
        for mine, his in zip(tensions, said["tension_N"]):
            self.assertAlmostEqual(mine, his, delta=1.0)

    def test_states_go_out_as_datagrams_until_an_interrupt(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as plot:
            plot.bind(("127.0.0.1", 0))
            plot.settimeout(30)
            words = [program("liana"), "status", "--api", self.system.api, "--json"]
            words += ["--udp", f"127.0.0.1:{plot.getsockname()[1]}"]
            with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as sender:
                told = [json.loads(plot.recv(65536)) for _ in range(20)]
                sender.send_signal(signal.SIGINT)
                said = json.loads(sender.communicate(timeout=30)[0])
        self.assertEqual(sender.returncode, 0)
        self.assertGreaterEqual(said["sent"], 20)
        self.assertEqual(said["unheard"], 0)
        times = [state["timestamp"] for state in told]
        self.assertEqual(times, sorted(set(times)))
        wait_until(lambda: told[0]["tick"] in self.states, "the same state")
        self.assertEqual(told[0]["measured_js_deg"], self.states[told[0]["tick"]]["measured_js_deg"])

    def test_events_come_in_order_each_once_and_those_kept_come_to_a_latecomer(self):
        first = self.console().until(lambda me: me.facts.get("is_homed"))
        first.stop("look")
        first.until(lambda me: any("look" in event["text"] for event in me.events))
        late = self.console("late").until(lambda me: len(me.events) >= len(first.events))
        for console in (first, late):
            sequences = [event["sequence"] for event in console.events]
            self.assertEqual(sequences, list(range(1, len(sequences) + 1)))
        self.assertEqual(late.events[: len(first.events)], first.events)

    def test_who_answers_no_record_gets_four_and_after_that_the_newest(self):
        console = self.console(answers=False).until(lambda me: len(me.sequences) == 4)
        other = self.console("other").until(lambda me: len(me.sequences) > 60)
        console.socket.settimeout(0.3)
        with self.assertRaises(TimeoutError):
            console.until(lambda me: len(me.sequences) > 4)
        console.socket.settimeout(60)
        console.answer_record()
        console.until(lambda me: len(me.sequences) == 5)
        self.assertGreaterEqual(console.sequences[4], other.sequences[-1] - 1)

    def test_a_slower_pace_is_kept(self):
        console = self.console().until(lambda me: len(me.sequences) > 3)
        console.say({"op": "pace", "hz": 4})
        seen = len(console.sequences)
        console.until(lambda me: len(me.sequences) == seen + 4)  # so many may have been under way
        begin = time.monotonic()
        console.until(lambda me: len(me.sequences) == seen + 12)
        self.assertGreater(time.monotonic() - begin, 0.75)  # 2 s, less the four that may wait when this test was slow


class WhatAClientMayDo(GatewayTest):
    def test_each_client_owns_motion_itself_and_its_death_is_a_hold(self):
        owner, other = self.console("owner"), self.console("other")
        owner.enable()
        answer = other.ask("acquire")
        self.assertEqual((answer["ok"], answer["code"]), (False, "not_owner"))
        self.assertIn("owner", answer["message"])
        goal = list(owner.state["setpoint_js_deg"])
        goal[8] -= 6.0
        owner.call("move_jp", goal_deg=goal)
        other.until(lambda me: me.facts["is_busy"] and abs(me.state["setpoint_js_deg"][8] - goal[8]) < 5.5)
        owner.close()
        other.until(lambda me: me.facts["owner"] == "")
        other.until(lambda me: me.facts["at_rest"] and not me.facts["is_busy"])
        self.assertEqual(other.facts["state"], "ENABLED")
        self.assertGreater(abs(other.state["setpoint_js_deg"][8] - goal[8]), 1.0)
        other.call("acquire")

    def test_a_stop_of_another_client_is_confirmed_by_lianad_and_takes_the_drives_power(self):
        owner, other = self.console("owner"), self.console("other")
        owner.enable()
        number = other.stop("hand on the key")
        other.until(lambda me: number in me.answers)
        self.assertTrue(other.answers[number]["ok"])
        other.until(lambda me: me.facts["stop"] and me.facts["state"] == "DISABLED")
        self.assertEqual((other.facts["stop"]["by"], other.facts["stop"]["reason"]), ("other", "hand on the key"))

    def test_a_stop_that_is_no_proper_message_is_a_stop(self):
        console = self.console().until(lambda me: me.facts)
        console.send('{"op":"stop","reason":"in a hurry", ')
        console.until(lambda me: me.facts["stop"])
        self.assertEqual(console.facts["stop"]["reason"], "in a hurry")

    def test_two_clients_of_one_name_are_told_apart(self):
        self.assertEqual(self.console("anna").until(lambda me: me.welcome).welcome["name"], "anna")
        self.assertEqual(self.console("anna").until(lambda me: me.welcome).welcome["name"], "anna-2")

    # req:A21
    def test_device_samples_reach_lianad_beside_motion_requests(self):
        console = self.console("pilot")
        console.enable()
        console.call("use_device", device="vr")
        hand = {"valid": True, "trigger": 0, "pose": [0, 0, 0, 1, 0, 0, 0]}
        before = console.state["device_samples"][0]
        for i in range(20):
            console.call("device", device="vr", samples=[{"t_us": 11111 * i, "right": hand, "left": hand}])
        console.until(lambda me: me.state["device_samples"][0] >= before + 20)

    def test_the_owner_alone_plans_a_way_and_lianad_carries_it_out(self):
        owner, other = self.console("owner"), self.console("other")
        owner.enable()
        goal = [angle + 1.0 for angle in owner.state["setpoint_js_deg"]]
        self.assertEqual(other.ask("plan", number=1, goal_deg=goal)["code"], "not_owner")
        owner.call("plan", number=1, goal_deg=goal)
        owner.until(lambda me: any(said.get("phase") == "found" for said in me.complaints))
        way = owner.complaints[-1]
        self.assertLess(max(abs(a - b) for a, b in zip(way["points_deg"][-1], goal)), 1e-9)
        owner.call("move_path", points_deg=way["points_deg"])
        owner.until(lambda me: max(abs(a - b) for a, b in zip(me.state["setpoint_js_deg"], goal)) < 1e-3)

    def test_a_planner_ends_with_its_client(self):
        owner = self.console("owner")
        owner.enable()
        pid = self.gateway.process.pid
        children = pathlib.Path(f"/proc/{pid}/task/{pid}/children")
        owner.call("plan", number=1, goal_deg=[0.0] * len(owner.state["setpoint_js_deg"]))
        owner.close()
        wait_until(lambda: children.read_text() == "", "the end of the planner")
        self.assertIsNone(self.gateway.process.poll())

    def test_what_lianad_refuses_is_answered_in_its_words(self):
        console = self.console().until(lambda me: me.facts)
        console.enable()
        answer = console.ask("move_jp", goal=[1])
        self.assertEqual((answer["ok"], answer["code"]), (False, "bad_request"))
        self.assertIn("goal", answer["message"])
        for op in ("hello", "done", "shutdown"):
            self.assertEqual(console.ask(op)["code"], "not_allowed")


class WhenSomethingEnds(GatewayTest):
    def test_a_gateway_that_was_killed_and_started_again_goes_on_and_the_arm_held_meanwhile(self):
        console = self.console("owner")
        console.enable()
        tick = console.state["tick"]
        self.gateway.end()
        with self.assertRaises(OSError):
            console.until(lambda me: False)
        wait_until(lambda: self.keeper.state["owner"] == "", "the hold")
        port = self.gateway.address.rsplit(":", 1)[1].strip("/")

        def starts_again():
            self.gateway = Gateway(self, self.system.api, listen=f"127.0.0.1:{port}")
            return self.gateway.address  # none while somebody else's connection goes out by this port

        wait_until(starts_again, "its successor at this port")
        again = self.console("owner").until(lambda me: me.state.get("tick", 0) > tick)
        self.assertEqual(again.facts["state"], "ENABLED")
        again.call("acquire")

    def test_the_end_of_lianad_is_told_and_what_was_asked_is_answered(self):
        console = self.console().until(lambda me: me.facts)
        self.stop_keeping()
        self.system.kill("lianad")
        console.until(lambda me: me.away)
        self.assertIn("lianad", console.away)
        self.assertEqual(console.ask("acquire")["code"], "away")
        number = console.stop()
        console.until(lambda me: number in me.answers)
        self.assertFalse(console.answers[number]["ok"])
        self.assertIn("cut the power", console.answers[number]["message"])


class WhoIsLetIn(GatewayAloneTest):
    """Refusals that need no lianad."""

    def refused_at_start(self, *words):
        """The one sentence of a gateway that does not start."""
        call = [program("liana-gateway"), "--api", str(self.api), *map(str, words)]
        done = subprocess.run(call, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        return done.stderr

    def assert_upgrade_refused(self, gateway, status, what, **options):
        with self.assertRaises(Refused) as refused:
            WebSocket(gateway.address, **options)
        self.assertEqual(refused.exception.status, status)
        wait_until(lambda: f"refused {what} from" in gateway.log(), f"{what} in {gateway.log()!r}")

    def console(self, address, **options):
        console = Console(address, **options)
        self.addCleanup(console.close)
        return console

    def assert_closed(self, console, code):
        with contextlib.closing(console), self.assertRaises(Closed) as closed:
            console.until(lambda me: False)
        self.assertEqual(closed.exception.code, code, closed.exception.reason)

    def test_beyond_loopback_it_needs_tokens_and_a_certificate(self):
        beyond = ["--listen", "0.0.0.0:0"]
        self.assertIn("--token-file", self.refused_at_start(*beyond))
        self.assertIn("--cert", self.refused_at_start(*beyond, "--token-file", self.tokens))
        self.assertIn("--listen", self.refused_at_start("--listen", "somewhere:80"))

    def test_a_token_file_that_others_may_read_or_that_is_no_token_file_is_refused(self):
        words = ["--listen", "127.0.0.1:0", "--token-file", self.tokens]
        self.write_tokens("anna operate operates-the-arm-0001\n", 0o640)
        self.assertIn("chmod 600", self.refused_at_start(*words))
        for line in ("anna captain operates-the-arm-0001", "anna operate short", "anna operate", ""):
            self.write_tokens(line + "\n")
            self.assertIn("--token-file", self.refused_at_start(*words))
        self.write_tokens("anna operate operates-the-arm-0001\nanna watch operates-the-arm-0002\n")
        error = self.refused_at_start(*words)
        self.assertIn("line 2", error)
        self.assertNotIn("operates-the-arm", error)

    def test_no_token_a_wrong_one_and_a_proof_of_before_are_refused(self):
        gateway = Gateway(self, self.api, "--token-file", self.tokens)
        first = self.console(gateway.address, token_name="anna", token="operates-the-arm-0001")
        first.until(lambda me: me.away)
        self.assert_closed(Console(gateway.address, "anna"), 1008)
        self.assert_closed(Console(gateway.address, token_name="anna", token="operates-the-arm-0002"), 1008)
        self.assert_closed(Console(gateway.address, token_name="eve", token="operates-the-arm-0001"), 1008)
        self.assert_closed(Console(gateway.address, hello=first.hello), 1008)
        for what in ("no_token", "wrong_proof"):
            self.assertIn(f"refused {what} from 127.0.0.1: ", gateway.log())

    def test_what_a_role_may_not_ask_is_refused_and_logged(self):
        gateway = Gateway(self, self.api, "--token-file", self.tokens)
        watcher = self.console(gateway.address, token_name="will", token="watches-the-arm-00002")
        self.assertEqual(watcher.ask("acquire")["code"], "not_allowed")
        self.assertEqual(watcher.ask("device")["code"], "not_allowed")
        self.assert_names(gateway.log(), "wrong_role", "127.0.0.1", "will", "watch", "acquire")

    def test_pages_of_others_and_names_of_others_are_refused(self):
        gateway = Gateway(self, self.api)
        port = gateway.address.rsplit(":", 1)[1].strip("/")
        for origin in ("http://evil.example", f"https://127.0.0.1:{port}", "http://127.0.0.1:1", "null"):
            self.assert_upgrade_refused(gateway, 403, "cross_origin", origin=origin)
        for host in ("evil.example", f"evil.example:{port}", "127.0.0.1:1"):
            self.assert_upgrade_refused(gateway, 403, "host", host=host)
            self.assertEqual(http_get(gateway.address, headers=[f"Host: {host}"])[0], 403)
        WebSocket(gateway.address, origin=gateway.address.rstrip("/")).close()
        WebSocket(gateway.address, host=f"localhost:{port}", origin=f"http://localhost:{port}").close()

    def test_nothing_but_the_page_is_there(self):
        gateway = Gateway(self, self.api, "--page", self.tokens)
        self.assertIn(b"operates-the-arm", http_get(gateway.address)[2])  # what --page names, and nothing beside it
        for path in ("/tokens", "/../tokens", "/%2e%2e/tokens", "//etc/passwd", "/run/../../etc/passwd"):
            status, _, body = http_get(gateway.address, path)
            self.assertIn(status, (403, 404), path)
            self.assertNotIn(b"root:", body)
        self.assertIn("refused path from", gateway.log())
        self.assertEqual(http_get(gateway.address, method="POST")[0], 405)
        self.assert_upgrade_refused(gateway, 404, "path", path="/")
        self.assert_upgrade_refused(gateway, 400, "protocol", protocol="liana-console-9")
        self.assert_upgrade_refused(gateway, 400, "protocol", protocol=None)

    def test_recorded_runs_are_shown_by_name_and_nothing_beside_them(self):
        for name in ("older", "newer", "unfinished"):
            (self.folder / "runs" / name).mkdir(parents=True)
        for changed_s, name in enumerate(("older", "newer")):
            (self.folder / "runs" / name / "page.html").write_text(f"page of {name}")
            os.utime(self.folder / "runs" / name, (changed_s, changed_s))
        os.utime(self.folder / "runs" / "unfinished", (9, 9))
        (self.folder / "page.html").write_text("nobody may read this")
        gateway = Gateway(self, self.api, "--runs", self.folder / "runs")
        runs = json.loads(http_get(gateway.address, "/runs")[2])
        self.assertEqual([(run["name"], run["page"]) for run in runs][0], ("unfinished", False))
        self.assertEqual([(run["name"], run["page"]) for run in runs][1:], [("newer", True), ("older", True)])
        self.assertEqual(http_get(gateway.address, "/run/older")[2], b"page of older")
        for name in ("unfinished", "none", "", ".", "older/page.html", "older%00"):
            self.assertNotEqual(http_get(gateway.address, f"/run/{name}")[0], 200, name)
        for name in ("..", "../page.html", "%2e%2e", "..%2f", "%2e%2e%2fpage.html", "..%5cpage.html"):
            self.assertFalse(b"nobody may read this" in http_get(gateway.address, f"/run/{name}")[2], name)

    def test_a_page_of_a_run_is_sandboxed_and_a_link_or_pipe_in_its_place_is_none(self):
        for name in ("foreign", "link", "pipe"):
            (self.folder / "runs" / name).mkdir(parents=True)
        (self.folder / "runs" / "foreign" / "page.html").write_text("<script>new WebSocket('ws://' + location.host)")
        (self.folder / "runs" / "link" / "page.html").symlink_to(self.tokens)
        os.mkfifo(self.folder / "runs" / "pipe" / "page.html")
        gateway = Gateway(self, self.api, "--runs", self.folder / "runs")
        policies = [
            line.partition(":")[2]
            for line in http_get(gateway.address, "/run/foreign")[1].lower().splitlines()
            if line.startswith("content-security-policy:")
        ]
        sandbox = next(
            policy.partition("sandbox")[2].partition(";")[0].split() for policy in policies if "sandbox" in policy
        )
        self.assertEqual(sandbox, ["allow-scripts", "allow-downloads"])  # above all no allow-same-origin
        self.assertTrue(any("connect-src data: blob:" in policy for policy in policies))  # without 'self'
        self.assertNotIn("sandbox", http_get(gateway.address)[1])
        for name in ("link", "pipe"):
            self.assertEqual(http_get(gateway.address, f"/run/{name}")[0], 404)

    def test_where_tokens_are_asked_for_each_run_takes_its_ticket_of_the_list_while_its_client_is_connected(self):
        for name in ("one", "two"):
            (self.folder / "runs" / name).mkdir(parents=True)
            (self.folder / "runs" / name / "page.html").write_text(f"page of {name}")
        with System() as system:
            gateway = Gateway(self, system.api, "--runs", self.folder / "runs", "--token-file", self.tokens)
            self.assertEqual(http_get(gateway.address, "/runs")[0], 403)
            self.assertEqual(http_get(gateway.address, "/metrics")[0], 403)
            self.assertEqual(http_get(gateway.address, f"/run/one?ticket={'0' * 64}")[0], 403)
            system.client("keeper").step()
            watcher = self.console(gateway.address, token_name="will", token="watches-the-arm-00002")
            ticket = watcher.until(lambda me: me.welcome).welcome["ticket"]
            runs = json.loads(http_get(gateway.address, f"/runs?ticket={ticket}")[2])
            one = next(run["ticket"] for run in runs if run["name"] == "one")
            self.assertEqual(http_get(gateway.address, f"/run/one?ticket={one}")[2], b"page of one")
            for path in (f"/run/two?ticket={one}", f"/runs?ticket={one}", f"/run/one?ticket={ticket}"):
                self.assertEqual(http_get(gateway.address, path)[0], 403, path)  # a page reads its own address
            self.assertEqual(http_get(gateway.address, f"/metrics?ticket={ticket}")[0], 200)
            watcher.close()
            wait_until(lambda: http_get(gateway.address, f"/run/one?ticket={one}")[0] == 403, "the end of the ticket")

    def test_a_message_that_is_too_long_ends_the_connection(self):
        gateway = Gateway(self, self.api)
        console = self.console(gateway.address)
        console.until(lambda me: me.away)
        console.send(json.dumps({"op": "pace", "hz": 10, "more": "x" * (128 * 1024 - 100)}))
        console.send(" " * (128 * 1024 + 1))
        self.assert_closed(console, 1009)
        self.assertIn("refused too_large from", gateway.log())

    def test_who_does_not_say_hello_is_closed_and_the_33rd_client_has_no_place(self):
        gateway = Gateway(self, self.api)
        silent, early = WebSocket(gateway.address), WebSocket(gateway.address)
        silent.receive()
        early.receive()
        early.send('{"op":"stop"}')
        with contextlib.closing(early), self.assertRaises(Closed):
            early.receive()
        with contextlib.ExitStack() as places:
            for _ in range(32):
                console = places.enter_context(contextlib.closing(Console(gateway.address)))
                console.until(lambda me: me.away)
            self.assert_upgrade_refused(gateway, 503, "too_many")
        self.assertIn("refused no_hello from", gateway.log())
        with contextlib.closing(silent), self.assertRaises(Closed):
            silent.receive()

    def test_strangers_make_room_for_each_other(self):
        gateway = Gateway(self, self.api)
        strangers = [WebSocket(gateway.address) for _ in range(17)]
        strangers[0].receive()
        with self.assertRaises(Closed) as closed:
            strangers[0].receive()
        self.assertEqual(closed.exception.code, 1013)
        strangers[1].receive()
        for stranger in strangers:
            stranger.close()

    def test_over_tls_a_request_in_the_clear_is_refused_and_one_that_is_not_is_served(self):
        gateway = Gateway(self, self.api, "--token-file", self.tokens, *self.certificate(), listen="0.0.0.0:0")
        address = gateway.address.replace("0.0.0.0", "127.0.0.1")
        self.assertTrue(address.startswith("https://"))
        self.assertEqual(http_get(address)[0], 200)
        console = self.console(address, token_name="anna", token="operates-the-arm-0001", origin=address.rstrip("/"))
        self.assertEqual((console.challenge["loopback"], console.challenge["proof"]), (False, True))
        console.until(lambda me: me.away)
        clear = address.replace("https://", "http://")
        self.assertEqual(http_get(clear)[0], 403)
        with self.assertRaises(Refused) as refused:
            WebSocket(clear)
        self.assertEqual(refused.exception.status, 403)
        self.assertEqual(gateway.log().count("refused plain_http from"), 2)


class WhoMisbehaves(GatewayTest):
    """What one client does is its own affair: others go on, and memory stays bounded."""

    MAX_MORE_K_B = 4096  # of resident memory

    def setUp(self):
        super().setUp()
        self.other = self.console("other").until(lambda me: len(me.sequences) > 20 and me.facts.get("is_homed"))
        self.resident_kB = self.gateway.resident_kB()

    def assert_others_go_on(self):
        seen = len(self.other.sequences)
        self.other.until(lambda me: len(me.sequences) > seen + 50)
        self.assertLess(self.gateway.resident_kB(), self.resident_kB + self.MAX_MORE_K_B)

    def in_background(self, work):
        """Does it beside the test, until the connection ends."""

        def tried():
            with contextlib.suppress(OSError):
                work()

        thread = threading.Thread(target=tried)
        thread.start()
        self.addCleanup(thread.join)

    def flood(self, message, count, kind=1):
        """Sends as long as it is let; the client."""
        client = self.console("flood")
        client.until(lambda me: me.welcome)
        with contextlib.suppress(OSError):
            for _ in range(count):
                client.send(message, kind)
        return client

    def test_a_flood_of_malformed_messages_ends_that_connection_alone(self):
        for message in (b"{", b"[]", b"\xff\xfe", b'{"op":"dance"}', b"[" * 5000, b'{"op":"request","request":7}'):
            client = self.flood(message, 3000)
            with self.assertRaises(OSError):
                client.until(lambda me: False)
        client = self.flood(b"12345", 3000, BINARY)
        with self.assertRaises(OSError):
            client.until(lambda me: False)
        self.assert_others_go_on()
        lines = self.gateway.log().splitlines()
        self.assertTrue(any("refused malformed from" in line for line in lines))
        self.assertLess(len(lines), 200)

    def test_who_asks_much_and_reads_nothing_is_closed_and_its_memory_is_bounded(self):
        client = self.console("deaf", receive_bytes=4096)
        request = json.dumps({"op": "request", "id": 1, "request": {"op": "move_jp", "goal": "x" * 1000}})
        self.in_background(lambda: [client.send(request) for _ in range(3000)])
        self.other.until(lambda me: "refused silent from" in self.gateway.log())
        self.assert_others_go_on()

    def test_stops_beside_floods_are_confirmed_within_the_time_of_one(self):
        stuck = [self.console("stuck", answers=False) for _ in range(8)]
        self.in_background(lambda: self.flood(b'{"op":"request","request":{"op":"hold"}}', 2000))
        confirmed = 0
        for _ in range(5):  # one may fall into a moment in which this machine does something else
            number = self.other.stop("beside floods")
            self.other.until(lambda me: number in me.answers)
            confirmed += self.other.answers[number]["ok"]  # the gateway says that there was none after 0.9 s
        self.assertGreater(confirmed, 0)
        self.assertEqual(len(stuck), 8)
        self.assert_others_go_on()


class TheCommandConsole(SystemTest):
    """`liana console`, in a runtime directory of its own."""

    def setUp(self):
        # Programs whose console is killed go by themselves, and the recorder writes to its end.
        folder = tempfile.TemporaryDirectory(prefix="liana-home-", ignore_cleanup_errors=True)
        self.home = self.enterContext(folder)
        homes = {"XDG_RUNTIME_DIR": self.home, "XDG_STATE_HOME": self.home, "TMPDIR": self.home}
        self.environment = {**os.environ, **homes}

    def start(self, *words):
        """`liana` with these words, ended when the test ends."""
        process = subprocess.Popen(
            [program("liana"), *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=self.environment,
        )
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def interrupt(self, process):
        """Ctrl-C; the exit code and what it said last."""
        process.send_signal(signal.SIGINT)
        _, error = process.communicate(timeout=60)
        return process.returncode, error

    def console(self, address, **options):
        console = Console(address, **options)
        self.addCleanup(console.close)
        return console

    def children_of(self, process, name):
        """Processes of that name which this one has started."""
        found = []
        for path in pathlib.Path("/proc").glob("[0-9]*/stat"):
            with contextlib.suppress(OSError):  # it has ended meanwhile
                words = path.read_text().split()
                found += [int(words[0])] if words[1] == f"({name})" and int(words[3]) == process.pid else []
        return found

    def processes(self):
        """Programs of this test that still run."""
        found = []
        for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
            with contextlib.suppress(OSError):
                found += [path] if self.home.encode() in path.read_bytes() else []
        return found

    def test_without_a_system_it_shows_a_simulated_arm_that_the_page_enables_and_ctrl_c_ends_all(self):
        process = self.start("console", "--listen", "127.0.0.1:0")
        process.stdout.readline()
        console = self.console(process.stdout.readline().strip())
        console.enable()
        self.assertEqual(console.facts["owner"], "test")
        self.assertTrue(console.welcome["practice"])
        self.assertEqual(
            console.call("practice", faults=[{"kind": "late", "drive": 2, "cycles": 1}])["on"][0]["drives"], [2]
        )
        self.assertEqual(console.call("practice", end=True)["on"], [])
        (recorder,) = self.children_of(process, "liana-archive")
        os.kill(recorder, signal.SIGKILL)
        wait_until(lambda: self.children_of(process, "liana-archive") not in ([], [recorder]), "another recorder")
        tick = console.state["tick"]
        console.until(lambda me: me.state["tick"] > tick + 250)
        second = self.start("console", "--robot", "micro", "--listen", "127.0.0.1:0")
        self.assertIn("--simulate", second.communicate(timeout=60)[1])
        self.assertEqual(second.returncode, 2)
        code, error = self.interrupt(process)
        self.assertEqual(code, 0, error)
        wait_until(lambda: not self.processes(), "the end of all programs")
        (run,) = (pathlib.Path(self.home) / "liana" / "runs").iterdir()
        self.assertIn(str(run), error)
        self.assert_names(error, "liana-archive", "started again")
        self.assertTrue((run / "archive.db").exists())

    def test_with_a_system_it_shows_that_one_and_a_gateway_that_dies_comes_back(self):
        owner = self.start("console", "--listen", "127.0.0.1:0", "--json")
        api = json.loads(owner.stdout.readline())["api"]
        process = self.start("console", "--listen", "127.0.0.1:0", "--json")
        told = json.loads(process.stdout.readline())
        self.assertEqual(told["api"], api)
        console = self.console(told["address"]).until(lambda me: me.state)
        self.assertNotIn("practice", console.welcome)  # this gateway knows of no simulator
        self.assertEqual(console.ask("practice", faults=[])["code"], "refused")
        os.kill(*self.children_of(process, "liana-gateway"), signal.SIGKILL)
        with self.assertRaises(OSError):
            console.until(lambda me: False)

        def comes_back():
            try:
                self.console(told["address"]).until(lambda me: me.state)
            except OSError:
                return False
            return True

        wait_until(comes_back, "its successor at this address")
        code, error = self.interrupt(process)
        self.assertEqual(code, 0, error)
        self.assertIn("started again", error)
        self.assertIsNone(owner.poll())

    def test_a_gateway_that_was_stopped_by_a_signal_is_ended_and_started_again(self):
        process = self.start("console", "--listen", "127.0.0.1:0", "--json")
        json.loads(process.stdout.readline())
        (gateway,) = self.children_of(process, "liana-gateway")
        os.kill(gateway, signal.SIGSTOP)
        wait_until(lambda: self.children_of(process, "liana-gateway") not in ([], [gateway]), "its successor")
        code, error = self.interrupt(process)
        self.assertEqual(code, 0, error)
        self.assert_names(error, "liana-gateway", "15 s", f"process {gateway}", "started again")

    def test_a_mission_goes_on_when_its_gateway_dies_again_and_again_and_gets_another(self):
        process = self.start("run", "slit_crossing", "--time", "paced", "--console", "--json", "-")
        address = process.stderr.readline().split()[-1]
        for _ in range(2):
            console = self.console(address).until(lambda me: me.state)
            (gateway,) = self.children_of(process, "liana-gateway")
            os.kill(gateway, signal.SIGKILL)
            with self.assertRaises(OSError):
                console.until(lambda me: False)
            wait_until(lambda: self.children_of(process, "liana-gateway") not in ([], [gateway]), "another gateway")
            wait_until(lambda: self.answers(address), "its address")
        console = self.console(address).until(lambda me: me.state)
        self.assertIsNone(process.poll())
        number = console.stop("seen")
        console.until(lambda me: number in me.answers)
        report = json.loads(process.communicate(timeout=60)[0])
        self.assert_names(report["reason"], "emergency stop", "test", "seen")

    def test_a_gateway_that_stands_still_is_ended_and_started_again(self):
        owner = self.start("console", "--listen", "127.0.0.1:0", "--json")
        address = json.loads(owner.stdout.readline())["address"]
        (gateway,) = self.children_of(owner, "liana-gateway")
        os.kill(gateway, signal.SIGSTOP)
        time.sleep(11)  # longer than one turn of its loop may take
        os.kill(gateway, signal.SIGCONT)
        wait_until(lambda: self.children_of(owner, "liana-gateway") not in ([], [gateway]), "another gateway")
        wait_until(lambda: self.answers(address), "its address")

    def answers(self, address):
        try:
            return http_get(address)[0] == 200
        except OSError:
            return False

    def test_a_mission_tells_the_address_and_is_seen(self):
        process = self.start("run", "slit_crossing", "--time", "paced", "--console", "--json", "-")
        console = self.console(process.stderr.readline().split()[-1])
        console.until(lambda me: me.facts.get("step") and me.facts["step"]["index"] == 1)
        number = console.stop("seen")
        console.until(lambda me: number in me.answers)
        report = json.loads(process.communicate(timeout=60)[0])
        self.assert_names(report["reason"], "emergency stop", "test", "seen")


if __name__ == "__main__":
    unittest.main()
