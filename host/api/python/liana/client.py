"""One connection to lianad's API socket (docs/reference/api.md): requests with their answers, states, events.

Angles are in degrees where a name ends in `_deg`, lengths in metres, poses `[x, y, z, qw, qx, qy, qz]` of the tip in
the base frame. Times named `_s` of states are arm time: in virtual time it stands still while a lockstep client thinks.
"""
from __future__ import annotations

import json
import os
import select
import socket
import time
from types import TracebackType
from typing import Any, Callable, Iterable, Mapping, Optional, Union

Message = dict[str, Any]
Path = Union[str, "os.PathLike[str]"]

PACKET_BYTES = 1 << 18  # more than lianad ever sends in one packet
PATIENCE_S = 120.0  # wall clock after which a program counts as hung; nothing is measured by it
MOST_PACKET_BYTES = 131072  # of the API (docs/reference/api.md)
JOINT_OF_TEST_MOVE = 8
ROUNDING_S = 1e-6  # a sum of times that should be a state's own time may be a little over it


class LianaError(Exception):
    """Everything that this package complains about."""


class RequestRefused(LianaError):
    """lianad answered a request with an error; the text is the daemon's own."""

    def __init__(self, op: str, answer: Message) -> None:
        self.op, self.answer = op, answer
        self.code: str = answer.get("code", "")
        self.message: str = answer.get("message", "")
        super().__init__(f"{op}: {self.message} ({self.code})")


class NotReached(LianaError):
    """A state that was waited for did not come within its arm time; `state` is the last one."""

    def __init__(self, limit_s: float, state: Message) -> None:
        self.state = state
        super().__init__(f"not reached in {limit_s:g} s of arm time: {brief(state)}")


class TimedOut(LianaError, TimeoutError):
    """Nothing came within PATIENCE_S of wall clock."""


class ConnectionClosed(LianaError, ConnectionError):
    """lianad closed the connection: it has ended, or this client read too slowly."""


def nothing() -> None:
    """The check of who has nothing to look after."""


def wait_until(done: Callable[[], bool], what: str, check: Callable[[], None] = nothing) -> None:
    """Returns when done() is true, asking every 5 ms; TimedOut after PATIENCE_S. `check` may raise to end the wait."""
    deadline = time.monotonic() + PATIENCE_S
    while not done():
        check()
        if time.monotonic() > deadline:
            raise TimedOut(f"waited for {what} in vain")
        time.sleep(0.005)


def brief(state: Mapping[str, Any]) -> str:
    """What matters of a state when something went wrong, on one line."""
    keys = ("tick", "state", "owner", "is_busy", "at_rest", "stop_category", "faults", "not_homed", "events")
    return json.dumps({key: state.get(key) for key in keys})


def packet_of(message: Message) -> bytes:
    """The message as JSON; LianaError for numbers that are not finite and for more than a packet holds."""
    try:
        packet = json.dumps(message, allow_nan=False).encode()
    except ValueError as error:
        raise LianaError(f"{message.get('op')}: a number is not finite: give finite ones ({error})") from error
    if len(packet) > MOST_PACKET_BYTES:
        raise LianaError(f"{message.get('op')}: {len(packet)} bytes: allowed {MOST_PACKET_BYTES}: send less at once")
    return packet


class Connection:
    """Packets to and from lianad, without a hello; for tests of the API itself. Others use Client."""

    def __init__(self, path: Path, check: Callable[[], None] = nothing) -> None:
        """Waits until `path` listens. `check` is called every second that nothing comes, and may raise."""
        self.check = check
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.socket.settimeout(PATIENCE_S)
        try:  # the path is there a moment before somebody listens
            wait_until(lambda: self.socket.connect_ex(os.fspath(path)) == 0, f"{path} to listen", check)
        except BaseException:
            self.close()
            raise

    def send(self, message: Union[bytes, Message]) -> None:
        """One packet: bytes as they are, or an object as JSON; LianaError for what no packet can hold, which lianad
        could answer only without saying which request it means."""
        self.socket.send(message if isinstance(message, bytes) else packet_of(message))

    def receive(self) -> Message:
        """The next packet; TimedOut when none comes, ConnectionClosed when none will."""
        deadline = time.monotonic() + PATIENCE_S
        readable = select.poll()  # select() takes no descriptor over 1023
        readable.register(self.socket, select.POLLIN)
        while not readable.poll(1000):
            self.check()
            if time.monotonic() > deadline:
                raise TimedOut(f"lianad sent nothing for {PATIENCE_S:g} s")
        packet = self.socket.recv(PACKET_BYTES)
        if not packet:
            raise ConnectionClosed("lianad closed the connection")
        message: Message = json.loads(packet)
        return message

    def close(self) -> None:
        self.socket.close()


class Client(Connection):
    """A named client. `state` is the newest state, `events` every event of the run that came, oldest first."""

    def __init__(
        self,
        path: Path,
        name: str = "python",
        role: str = "client",
        lockstep: bool = False,
        subscribe: Iterable[str] = ("state", "event"),
        check: Callable[[], None] = nothing,
        events_from: int = 1,
    ) -> None:
        """Says hello; `welcome` is the answer. RequestRefused when lianad does not take this client. Who comes back
        gives the sequence after the last event that he has seen.
        """
        super().__init__(path, check)
        self.lockstep = lockstep
        self.state: Message = {}
        self.answers: dict[int, Message] = {}  # by request, until they are asked for
        self.complaints: list[Message] = []  # what came without a number: errors about packets that had none
        self.events: list[Message] = []  # docs/reference/formats.md, Events; subscribers of `event` have them
        self.events_lost = 0  # of which lianad no longer had the text when this client read on
        self.faults_told: set[tuple[int, int, int]] = set()  # (number, index, tick) of every fault in any state
        self.last_id = 0
        topics = list(subscribe)
        hello = {"op": "hello", "name": name, "role": role, "lockstep": lockstep, "subscribe": topics}
        if "event" in topics:
            hello["events_from"] = events_from
        try:
            self.send(hello)
            self.welcome = self.receive()
            if self.welcome["op"] == "error":
                raise RequestRefused("hello", self.welcome)
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Client:
        return self

    def __exit__(
        self, kind: Optional[type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()

    # ---- states ----

    def next_state(self) -> Message:
        """Receives until a state comes; what comes before is kept."""
        while True:
            message = self.receive()
            if message["op"] == "state":
                self._keep_state(message)
                return message
            if message["op"] == "event":
                self.events.append(message)
            elif message["op"] == "events_lost":
                self.events_lost += message["count"]
            elif "id" in message:
                self.answers[message["id"]] = message
            else:
                self.complaints.append(message)

    def _keep_state(self, state: Message) -> None:
        self.state = state
        self.faults_told.update((fault["number"], fault["index"], fault["tick"]) for fault in state["faults"])

    @property
    def is_ending(self) -> bool:
        """lianad has said that it ends: after its last state it waits 30 s for a `shutdown`, and nothing else comes."""
        return any(event["kind"] == "shutdown" for event in self.events)

    def step(self) -> Message:
        """The next state; in lockstep the present one is answered first, which lets time go on."""
        if self.lockstep and self.state:
            self.send({"op": "done", "tick": self.state["tick"]})
        return self.next_state()

    def until(self, wanted: Callable[[Message], Any], limit_s: float = 30.0) -> Message:
        """Goes on until wanted(state); NotReached after `limit_s` of arm time."""
        start_s = (self.state or self.step())["time_s"]
        while not wanted(self.state):
            if self.state["time_s"] - start_s > limit_s:
                raise NotReached(limit_s, self.state)
            self.step()
        return self.state

    def go_on(self, seconds: float) -> Message:
        """Lets so much arm time pass."""
        end_s = (self.state or self.step())["time_s"] + seconds - ROUNDING_S
        return self.until(lambda state: state["time_s"] >= end_s, seconds + 1)

    # ---- requests ----

    def request(self, op: str, **fields: Any) -> int:
        """Sends a request and does not wait; its number, by which `answers` will have the answer."""
        self.last_id += 1
        self.send({"op": op, "id": self.last_id, **fields})
        return self.last_id

    def ask(self, op: str, **fields: Any) -> Message:
        """Sends a request and goes on until its answer is there; the answer, `ok` or `error`."""
        number = self.request(op, **fields)
        while number not in self.answers:
            self.step()
        return self.answers.pop(number)

    def call(self, op: str, **fields: Any) -> Message:
        """As `ask`, but RequestRefused when the answer is an error."""
        answer = self.ask(op, **fields)
        if answer["op"] != "ok":
            raise RequestRefused(op, answer)
        return answer

    def enable(self) -> Message:
        """Owns motion, waits until the drives are there, enables, and waits until the arm is enabled and at rest."""
        self.call("acquire")
        self.until(lambda state: state["state"] != "BOOTING" and state["is_homed"])
        self.call("state_command", command="enable")
        return self.until(lambda state: state["state"] == "ENABLED" and state["at_rest"])

    def start_moving(self, change_deg: float = 6.0, joint: int = JOINT_OF_TEST_MOVE) -> Message:
        """A move of one theta (from 0; the ninth) by minus `change_deg`, well under way when this returns."""
        goal_deg = list(self.state["setpoint_js_deg"])
        begin_deg = goal_deg[joint]
        goal_deg[joint] -= change_deg
        self.call("move_jp", goal_deg=goal_deg)
        return self.until(lambda state: abs(state["setpoint_js_deg"][joint] - begin_deg) > 0.3)
