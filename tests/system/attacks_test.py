"""What people of the same user can do to a running system, tried: each attack ends as docs/explanation/security.md
says.
"""
import contextlib
import os
import pathlib
import socket
import unittest

from support import SystemTest, start_run
from liana.client import Client, RequestRefused, wait_until
from liana.system import System, run

REST_BYTES = 64 << 20  # that lianad may grow by, whatever is done to it


def resident_bytes(pid):
    """Memory of a process that is in use now."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) * 1024


class Api(SystemTest):
    """One running system for all; every test leaves it running, and its client served."""

    @classmethod
    def setUpClass(cls):
        cls.system = cls.enterClassContext(System())
        cls.client = cls.system.client()
        cls.client.enable()

    def setUp(self):
        self.start_deg = list(self.client.go_on(0.1)["setpoint_js_deg"])
        self.open = self.enterContext(contextlib.ExitStack())

    def tearDown(self):
        self.client.go_on(0.2)
        self.assert_holds(self.client.state)
        for now, before in zip(self.client.state["setpoint_js_deg"], self.start_deg):
            self.assertAlmostEqual(now, before, delta=1e-3)

    def attacker(self, role="observer", **options):
        """A client outside lockstep, closed when the test ends."""
        client = Client(self.system.api, "attacker", role, subscribe=options.pop("subscribe", ()), **options)
        self.open.callback(client.close)
        return client

    def raw(self, packets=()):
        """A connection that says nothing but these packets, and reads nothing."""
        connection = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.open.callback(connection.close)
        connection.setblocking(False)
        connection.connect(str(self.system.api))
        for packet in packets:
            with contextlib.suppress(BlockingIOError):
                connection.send(packet)
        return connection

    def answer_to(self, client, op, **fields):
        """What a client outside lockstep is answered, while time goes on."""
        number = client.request(op, **fields)
        for _ in range(50):
            self.client.step()
            with contextlib.suppress(BlockingIOError):
                client.socket.setblocking(False)
                message = client.receive()
                if message.get("id") == number:
                    return message
        return self.fail(f"{op} was not answered")

    def test_an_observer_cannot_end_the_system(self):
        self.assert_refused(self.answer_to(self.attacker(), "shutdown"), "not_owner", "observer", "client")

    def test_a_second_client_of_a_role_that_one_has_is_refused_with_who_has_it(self):
        for role in ("camera", "operator", "mission", "archive"):
            if role != "camera":  # the bench is one
                self.attacker(role)
            with self.assertRaisesRegex(RequestRefused, f"role {role}: .* has it .process [1-9]"):
                self.attacker(role)

    def test_a_mission_that_comes_and_leaves_does_not_end_a_run_that_nobody_started_with_one(self):
        self.attacker("mission").close()
        self.client.go_on(2.0)
        self.assertFalse(self.client.state["stopping"])

    def test_twenty_eight_silent_connections_do_not_keep_a_stop_out(self):
        with System() as system:
            client = system.client()
            client.enable()
            silent = [system.stranger() for _ in range(28)]
            system.start("liana", "estop", "--api", system.api)
            client.until(lambda state: state["state"] == "DISABLED")
            self.assertEqual(system.ended("liana"), 0, system.log("liana"))
            self.assertEqual(client.state["stop"]["by"], "liana estop")
            for each in silent:
                each.close()

    def test_memory_stays_bounded_whatever_is_sent_and_whoever_reads_nothing(self):
        pid = self.system.children["lianad"].pid
        before = resident_bytes(pid)
        hello = b'{"op":"hello","name":"a","role":"client","subscribe":["state","event","camera"]}'
        numbers = b'{"op":"move_jp","id":1,"goal_deg":[' + b"0," * 60000 + b"0]}"
        deep = b'{"op":' + b'[{"a":' * 20000 + b"1" + b"}]" * 20000 + b"}"
        texts = b'"' + b"x" * 130000
        worst = 0
        for _ in range(6):
            for kind in (numbers, deep, texts, b'{"op":"timing","id":3}'):
                for greeting in ([hello], []):
                    self.raw(greeting + [kind] * 600)
                self.client.step()
            worst = max(worst, resident_bytes(pid))
        self.assertLess(worst - before, REST_BYTES)


class WhatKilledRunsLeave(SystemTest):
    def test_folders_of_killed_runs_are_swept_by_the_next_one_and_those_of_others_stay(self):
        process = start_run(self, "slit_crossing", "--time", "paced")
        folders = lambda: {path.name for path in process.home.glob("liana-run-*")}  # noqa: E731
        wait_until(lambda: any(process.home.glob("liana-run-*/api")), "lianad to listen")
        (process.home / "liana-run-notours").mkdir()
        left = folders()
        environment = {**os.environ, "TMPDIR": str(process.home), "XDG_STATE_HOME": str(process.home)}
        refused = run("liana", "run", "no_such_mission", env=environment)
        self.assertEqual((refused.returncode, folders()), (2, left), "one that runs keeps its folder")
        process.kill()
        process.wait()

        def swept():  # once the processes that were started are gone, too
            run("liana", "run", "no_such_mission", env=environment)
            return folders() == {"liana-run-notours"}

        wait_until(swept, "the sweep")


if __name__ == "__main__":
    unittest.main()
