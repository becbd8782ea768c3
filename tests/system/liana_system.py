"""Starts Liana's programs as `liana run` does, in virtual time, and speaks lianad's API (docs/api.md) with them."""
import collections
import functools
import json
import math
import os
import pathlib
import select
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("LIANA_BIN", SOURCE / "build" / "bin"))
PATIENCE_S = 120  # wall clock after which a program counts as hung; no test measures time
kPacketBytes = 1 << 18


def program(name):
    return str(BIN / name)


def run(*words, **options):
    """A program to its end: the completed process with text output."""
    return subprocess.run(
        [program(words[0]), *map(str, words[1:])],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
        **options,
    )


def start_run(test, *words):
    """`liana run` with these words, its runtime directory its own; ended when the test ends."""
    home = tempfile.mkdtemp(prefix="liana-home-")
    test.addCleanup(shutil.rmtree, home, ignore_errors=True)
    process = subprocess.Popen(
        [program("liana"), "run", *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=home,
        env={**os.environ, "XDG_RUNTIME_DIR": home, "TMPDIR": home},
    )
    process.home = pathlib.Path(home)
    test.addCleanup(process.communicate)
    test.addCleanup(process.kill)
    return process


kBadInput = 2  # exit code of every program that refuses what it was given


class Refused(AssertionError):
    """A program ended because of what it was given; the text is what it said."""


def wait_until(done, what, check=lambda: None):
    deadline = time.monotonic() + PATIENCE_S
    while not done():
        check()
        if time.monotonic() > deadline:
            raise AssertionError(f"waited for {what} in vain")
        time.sleep(0.005)


@functools.lru_cache(maxsize=None)
def table(kind, name):
    """Canonical JSON of a table under lua/."""
    done = run("liana-mission", "eval", kind, name)
    assert done.returncode == 0, done.stderr
    return done.stdout


def prepare_pose_deg():
    return json.loads(table("robot", "zhu2022"))["named_poses_deg"]["prepare"]


class Client:
    """One connection to the API. Answers are kept by id, everything else that is no state in `complaints`."""

    def __init__(self, path, name, role, lockstep=False, subscribe=("state",), check=lambda: None):
        """`check` is called every second that nothing comes."""
        self.check = check
        self.lockstep, self.state, self.answers, self.complaints, self.events = lockstep, None, {}, [], []
        self.last_id, self.faults_told = 0, set()
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.socket.settimeout(PATIENCE_S)
        wait_until(
            lambda: self.socket.connect_ex(str(path)) == 0, f"{path} to listen", check
        )  # the path is there a moment before
        if name is None:
            return
        self.send({"op": "hello", "name": name, "role": role, "lockstep": lockstep, "subscribe": list(subscribe)})
        self.welcome = self.receive()

    def send(self, message):
        self.socket.send(message if isinstance(message, bytes) else json.dumps(message).encode())

    def receive(self):
        deadline = time.monotonic() + PATIENCE_S
        while not select.select([self.socket], [], [], 1.0)[0] and time.monotonic() < deadline:
            self.check()
        packet = self.socket.recv(kPacketBytes)
        if not packet:
            raise ConnectionError("lianad closed the connection")
        return json.loads(packet)

    def next_state(self):
        """Receives until a state comes; what comes before is sorted."""
        while True:
            message = self.receive()
            if message["op"] == "state":
                self.state = message
                self.faults_told.update((fault["number"], fault["index"], fault["tick"]) for fault in message["faults"])
                self.events += [event for event in message["events"] if event not in self.events]
                return message
            if "id" in message:
                self.answers[message["id"]] = message
            else:
                self.complaints.append(message)

    def step(self):
        """The next state; in lockstep the present one is answered first."""
        if self.lockstep and self.state is not None:
            self.send({"op": "done", "tick": self.state["tick"]})
        return self.next_state()

    def request(self, op, **fields):
        self.last_id += 1
        self.send({"op": op, "id": self.last_id, **fields})
        return self.last_id

    def ask(self, op, **fields):
        """Sends a request and goes on until its answer is there."""
        number = self.request(op, **fields)
        while number not in self.answers:
            self.step()
        return self.answers.pop(number)

    def until(self, wanted, limit_s=30.0):
        """Goes on until wanted(state); AssertionError with the state after `limit_s` of arm time."""
        start_s = (self.state or self.step())["time_s"]
        while not wanted(self.state):
            if self.state["time_s"] - start_s > limit_s:
                raise AssertionError(f"not reached in {limit_s} s of arm time: {brief(self.state)}")
            self.step()
        return self.state

    def go_on(self, seconds):
        """Lets so much arm time pass."""
        end_s = self.state["time_s"] + seconds
        return self.until(lambda state: state["time_s"] >= end_s, seconds + 1)

    def enable(self):
        """Owns motion, waits for the drives, enables."""
        must(self.ask("acquire"))
        self.until(lambda state: state["state"] != "BOOTING" and state["is_homed"])
        must(self.ask("state_command", command="enable"))
        return self.until(lambda state: state["state"] == "ENABLED" and state["at_rest"])

    def start_moving(self, change_deg=6.0):
        """A joint move of some seconds, well under way when this returns."""
        goal = list(self.state["setpoint_js_deg"])
        goal[8] -= change_deg
        must(self.ask("move_jp", goal_deg=goal))
        begin = self.state["setpoint_js_deg"][8]
        return self.until(lambda state: abs(state["setpoint_js_deg"][8] - begin) > 0.3)

    def close(self):
        self.socket.close()


def must(answer):
    assert answer["op"] == "ok", answer
    return answer


def brief(state):
    keys = ("tick", "state", "owner", "is_busy", "at_rest", "stop_category", "faults", "events")
    return json.dumps({key: state.get(key) for key in keys})


class Truth:
    """truth.bin of the bench: one row per slot."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        end = data.index(b"\n") + 1
        self.columns = json.loads(data[:end])["columns"]
        width = 8 * len(self.columns)
        whole = (len(data) - end) // width
        self.rows = [struct.unpack_from(f"<{len(self.columns)}d", data, end + i * width) for i in range(whole)]

    def column(self, name):
        i = self.columns.index(name)
        return [row[i] for row in self.rows]

    def theta_deg(self, row):
        first = self.columns.index("theta_deg_1")
        return self.rows[row][first : first + 10]

    def travel_deg(self, first, last):
        """Largest change of any angle between any row and the first of the range."""
        start = self.theta_deg(first)
        rows = range(len(self.rows))[first:last]
        return max(abs(a - b) for row in rows for a, b in zip(self.theta_deg(row), start))


class System:
    """All programs of one run in a directory of their own; ends them when the `with` block ends."""

    def __init__(self, expect="client", faults=None, bus_script=None, seed=1, bus="embedded", lianad=(), bench=()):
        """`lianad`, `bench`: further words for these programs."""
        self.directory = pathlib.Path(tempfile.mkdtemp(prefix="liana-sys-"))
        self.api, self.bus_socket = self.directory / "api", self.directory / "bus"
        self.children, self.clients = {}, []
        self.expect, self.faults, self.script, self.seed, self.bus = expect, faults, bus_script, seed, bus
        self.lianad_words, self.bench_words = lianad, bench

    def tables(self):
        return [word for kind in ("robot", "scene", "buses") for word in (f"--{kind}", self.directory / f"{kind}.json")]

    def start(self, name, *words):
        log = open(self.directory / f"{name}.log", "ab")
        self.children[name] = subprocess.Popen(
            [program(name), *map(str, words)], stdin=subprocess.DEVNULL, stdout=log, stderr=log
        )
        log.close()

    def write_tables(self):
        for kind, name in (("robot", "zhu2022"), ("scene", "panel_slit"), ("buses", self.bus)):
            (self.directory / f"{kind}.json").write_text(table(kind, name))
        for name, content in (("faults", self.faults), ("script", self.script)):
            if content is not None:
                (self.directory / f"{name}.json").write_text(json.dumps(content))

    def __enter__(self):
        try:
            self.write_tables()
            script = ["--script", self.directory / "script.json"] if self.script is not None else []
            self.start(
                "liana-bus",
                "--socket",
                self.bus_socket,
                "--buses",
                self.directory / "buses.json",
                "--time",
                "fast",
                "--log",
                self.directory,
                "--stats",
                self.directory / "bus_stats.json",
                *script,
            )
            wait_until(self.bus_socket.exists, "liana-bus to listen", self.check_refused)
            self.start(
                "lianad",
                *self.tables(),
                "--api",
                self.api,
                "--bus-socket",
                self.bus_socket,
                "--time",
                "fast",
                "--expect",
                self.expect,
                *self.lianad_words,
            )
            wait_until(self.api.exists, "lianad to listen", self.check_refused)
            faults = ["--faults", self.directory / "faults.json"] if self.faults is not None else []
            self.start(
                "liana-bench",
                *self.tables(),
                "--bus-socket",
                self.bus_socket,
                "--api",
                self.api,
                "--seed",
                self.seed,
                "--truth",
                self.directory / "truth.bin",
                "--summary",
                self.directory / "bench_summary.json",
                *faults,
                *self.bench_words,
            )
            return self
        except BaseException:
            self.__exit__(*sys.exc_info())
            raise

    def __exit__(self, kind, *_):
        for child in self.children.values():
            if child.poll() is None:
                child.kill()
            child.wait()
        for client in self.clients:
            client.close()
        if kind not in (None, unittest.SkipTest):
            for name in self.children:
                print(f"--- {name}: exit {self.children[name].returncode}: {self.log(name)[-600:]}", file=sys.stderr)
        shutil.rmtree(self.directory, ignore_errors=True)

    def client(self, name="test", role="client", lockstep=True, **options):
        self.clients.append(Client(self.api, name, role, lockstep, check=self.check_refused, **options))
        return self.clients[-1]

    def stranger(self):
        """A connection that has not said hello."""
        return Client(self.api, None, None)

    def start_operator(self):
        self.start(
            "liana-operator",
            "--api",
            self.api,
            "--recordings",
            SOURCE / "lua" / "recordings",
            "--scene",
            self.directory / "scene.json",
            "--seed",
            self.seed,
            "--lockstep",
        )

    def start_mission(self, mission, lockstep=True):
        waits = ["--lockstep"] if lockstep else []
        self.start(
            "liana-mission",
            "run",
            "--api",
            self.api,
            "--mission",
            mission,
            "--report",
            self.directory / "mission.json",
            *waits,
        )

    def check_refused(self):
        """Nobody has to wait for a program that has refused its input."""
        for name, child in self.children.items():
            if child.poll() == kBadInput:
                raise Refused(self.log(name).strip()[-600:])

    def kill(self, name):
        self.children[name].send_signal(signal.SIGKILL)
        self.children[name].wait()

    def ended(self, name):
        """Waits for a program's end: its exit code."""
        return self.children[name].wait(timeout=PATIENCE_S)

    def shut_down(self, client):
        """Ends lianad, then bus and bench, which write their summaries."""
        client.request("shutdown")
        try:
            while True:
                client.step()
        except (ConnectionError, OSError):
            pass
        return {name: self.ended(name) for name in ("lianad", "liana-bus", "liana-bench")}

    def log(self, name):
        path = self.directory / f"{name}.log"
        return path.read_text() if path.exists() else ""

    def json(self, name):
        return json.loads((self.directory / name).read_text())

    def truth(self):
        return Truth(self.directory / "truth.bin")

    def emergencies(self):
        """EMCY codes in the bus logs, by node; the logs are whole when liana-bus has ended."""
        codes = collections.defaultdict(list)
        for path in sorted(self.directory.glob("can*.log")):
            for line in path.read_text().splitlines():
                identifier, data = line.split()[2].split("#")
                if 0x080 < int(identifier, 16) < 0x100:
                    codes[int(identifier, 16) - 0x080].append(int(data[2:4] + data[0:2], 16))
        return dict(codes)


class SystemTest(unittest.TestCase):
    """Assertions about a safe arm."""

    def assert_refused(self, answer, code, *words):
        self.assertEqual(answer["op"], "error", answer)
        self.assertEqual(answer["code"], code, answer)
        for word in words:
            self.assertIn(word, answer["message"])

    def assert_fault(self, state, number, index):
        found = [(fault["number"], fault["index"]) for fault in state["faults"]]
        self.assertIn((number, index), found, brief(state))

    def assert_holds(self, state):
        self.assertEqual(state["state"], "ENABLED", brief(state))
        self.assertTrue(state["at_rest"], brief(state))
        self.assertFalse(state["is_busy"], brief(state))

    def assert_still(self, truth, first, allowed_deg=0.02):
        """The true arm keeps its place from row `first` on, and all its numbers are finite."""
        self.assertTrue(all(math.isfinite(value) for value in truth.rows[-1]))
        self.assertLess(truth.travel_deg(first, None), allowed_deg)

    def assert_stopped(self, truth, event_slot, stop_deg=1.0, swing_deg=0.02):
        """Brakes closed at the end, little travel after the event, next to none in the last half second.

        Brakes hold the drums; on its elastic cables the arm swings on with what motion it had, and next to nothing
        damps it.
        """
        self.assertEqual(truth.column("enabled")[-1], 0)
        self.assertLess(truth.travel_deg(event_slot, None), stop_deg)
        self.assert_still(truth, len(truth.rows) - 125, swing_deg)
