"""The client against a daemon of the test's own that says what each test tells it."""
import json
import pathlib
import socket
import sys
import tempfile
import threading
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[4] / "host" / "api" / "python"))
sys.path.append(str(pathlib.Path(__file__).resolve().parents[3]))  # message.py

import liana.client  # noqa: E402
from message import Messages  # noqa: E402
from liana.client import Client, Connection, ConnectionClosed, NotReached, RequestRefused, TimedOut  # noqa: E402

WELCOME = {"op": "welcome", "time_mode": "fast"}


def state(tick, **fields):
    base = {"op": "state", "tick": tick, "time_s": tick * 0.02, "state": "ENABLED", "faults": [], "events": []}
    return {**base, **fields}


class Daemon:
    """Sends `first` to who connects, and for each packet what `answer(packet)` gives; keeps what it received."""

    def __init__(self, test, answer, first=()):
        self.path = str(pathlib.Path(test.enterContext(tempfile.TemporaryDirectory())) / "api")
        self.answer, self.first, self.received = answer, first, []
        self.listener = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.listener.bind(self.path)
        self.listener.listen()
        test.addCleanup(self.listener.close)
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        end, _ = self.listener.accept()
        with end:
            for message in self.first:
                end.send(json.dumps(message).encode())
            while packet := end.recv(1 << 16):
                self.received.append(json.loads(packet))
                for message in self.answer(self.received[-1]):
                    if message is None:
                        return
                    end.send(json.dumps(message).encode())


def greeting(answers=lambda packet: []):
    """Answers hello, and everything else as `answers` says."""
    return lambda packet: [WELCOME] if packet["op"] == "hello" else answers(packet)


class Requests(Messages, unittest.TestCase):
    def client(self, answers, **options):
        self.daemon = Daemon(self, greeting(answers))
        return self.enterContext(Client(self.daemon.path, "me", "observer", **options))

    def test_hello_says_who_the_client_is_and_what_it_wants(self):
        client = self.client(lambda packet: [], subscribe=("state", "camera"))
        wanted = {"op": "hello", "name": "me", "role": "observer", "lockstep": False, "subscribe": ["state", "camera"]}
        self.assertEqual((self.daemon.received, client.welcome), ([wanted], WELCOME))

    def test_who_comes_back_asks_for_the_events_that_he_has_not_seen(self):
        self.client(lambda packet: [], events_from=57)
        self.assertEqual(self.daemon.received[0]["subscribe"], ["state", "event"])
        self.assertEqual(self.daemon.received[0]["events_from"], 57)

    def test_a_hello_that_is_refused_raises_the_daemons_words(self):
        daemon = Daemon(self, lambda packet: [{"op": "error", "code": "bad_request", "message": "role: king"}])
        with self.assertRaises(RequestRefused) as caught:
            Client(daemon.path, "me", "king")
        self.assertEqual((caught.exception.code, caught.exception.message), ("bad_request", "role: king"))

    def test_an_answer_is_found_among_states_and_answers_to_others(self):
        def answers(packet):
            if packet["op"] == "late":
                return []
            return [state(1), {"op": "ok", "id": 1}, {"op": "ok", "id": packet["id"], "x": 7}, state(2)]

        client = self.client(answers)
        first = client.request("late")
        self.assertEqual(client.ask("hold")["x"], 7)
        self.assertEqual(client.answers, {first: {"op": "ok", "id": first}})

    def test_a_refusal_is_an_answer_to_ask_and_an_exception_of_call(self):
        refusal = {"op": "error", "code": "not_owner", "message": "'mission' owns motion"}
        client = self.client(lambda packet: [{**refusal, "id": packet["id"]}, state(1)])
        self.assertEqual(client.ask("hold")["code"], "not_owner")
        with self.assertRaises(RequestRefused) as caught:
            client.call("hold")
        self.assert_names(str(caught.exception), "hold", "mission", "not_owner")

    def test_what_has_no_number_is_a_complaint(self):
        client = self.client(lambda packet: [{"op": "error", "code": "bad_request", "message": "not JSON"}, state(1)])
        client.send({"op": "x"})
        client.step()
        self.assertEqual([one["message"] for one in client.complaints], ["not JSON"])

    def test_in_lockstep_a_state_is_answered_before_the_next_one_is_awaited(self):
        client = self.client(lambda packet: [state(packet.get("tick", 0) + 5)], lockstep=True)
        client.send({"op": "begin"})
        client.step(), client.step(), client.step()
        self.assertEqual([packet["tick"] for packet in self.daemon.received[2:]], [5, 10])
        self.assertEqual({packet["op"] for packet in self.daemon.received[2:]}, {"done"})


class States(unittest.TestCase):
    def client(self, states):
        return self.enterContext(Client(Daemon(self, lambda packet: [WELCOME, *states]).path))

    def test_until_stops_at_the_first_state_that_is_wanted(self):
        client = self.client([state(tick) for tick in range(1, 9)])
        self.assertEqual(client.until(lambda now: now["tick"] >= 3)["tick"], 3)

    def test_until_gives_up_after_its_arm_time_and_says_what_the_state_is(self):
        client = self.client([state(tick, owner="somebody") for tick in range(1, 200)])
        with self.assertRaises(NotReached) as caught:
            client.until(lambda now: False, limit_s=1.0)
        self.assertIn("somebody", str(caught.exception))
        self.assertEqual(caught.exception.state["tick"], 52)

    def test_going_on_for_some_time_ends_in_the_state_of_that_time_however_the_sum_is_rounded(self):
        client = self.client([state(tick) for tick in range(1, 400)])
        for tick in range(2, 300, 7):
            client.until(lambda now: now["tick"] >= tick)
            self.assertEqual(client.go_on(0.06)["tick"], tick + 3)

    def test_every_event_is_kept_and_faults_once_though_many_states_tell_them(self):
        events = [{"op": "event", "sequence": number, "tick": 1, "text": "x"} for number in (1, 2)]
        fault = {"number": 3002, "index": 3, "tick": 1}
        client = self.client([events[0], state(1, faults=[fault]), events[1], state(2, faults=[fault]), state(3)])
        client.go_on(0.04)
        self.assertEqual((client.events, client.faults_told), (events, {(3002, 3, 1)}))
        self.assertEqual(client.events_lost, 0)

    def test_events_that_the_daemon_no_longer_had_are_counted(self):
        client = self.client([{"op": "events_lost", "from": 1, "to": 7, "count": 7}, state(1)])
        client.step()
        self.assertEqual((client.events, client.events_lost, client.complaints), ([], 7, []))

    def test_a_daemon_that_ends_is_a_closed_connection(self):
        client = self.client([state(1), None])
        client.step()
        with self.assertRaises(ConnectionClosed):
            client.step()


class Patience(unittest.TestCase):
    def setUp(self):
        self.enterContext(mock.patch.object(liana.client, "PATIENCE_S", 0.05))

    def test_who_never_listens_and_who_never_speaks_is_not_waited_for_for_ever(self):
        with self.assertRaises(TimedOut):
            Connection("/nonexistent/api")
        silent = Connection(Daemon(self, lambda packet: []).path)
        self.addCleanup(silent.close)
        with self.assertRaises(TimedOut):
            silent.receive()

    def test_a_check_that_raises_ends_the_wait_at_once(self):
        def check():
            raise ValueError("the program refused its input")

        with self.assertRaisesRegex(ValueError, "refused its input"):
            Connection("/nonexistent/api", check)


if __name__ == "__main__":
    unittest.main(verbosity=2)
