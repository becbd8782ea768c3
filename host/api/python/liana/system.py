"""Liana's programs as `liana run` starts them, in virtual time and a folder of their own, for scenarios and tests.

Programs are those in $LIANA_BIN; without it, of the prefix that this is installed in, or of this tree (build/bin).
"""
from __future__ import annotations

import collections
import functools
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
from types import TracebackType
from typing import Any, Iterable, Optional

from liana import client as clients
from liana.client import Client, Connection, LianaError, Message, wait_until
from liana.recordings import Event, Truth, read_events

HERE = pathlib.Path(__file__).resolve()
IS_INSTALLED = HERE.parents[2] == HERE.parents[4] / "share" / "liana"
BINARIES = HERE.parents[4] / "bin" if IS_INSTALLED else HERE.parents[4] / "build" / "bin"
LUA = HERE.parents[2 if IS_INSTALLED else 4] / "lua"
BAD_INPUT = 2  # exit code of every program that refuses what it was given


class ProgramRefused(LianaError):
    """A program ended because of what it was given; the text is what it said."""


def binaries() -> pathlib.Path:
    """The folder of the programs."""
    return pathlib.Path(os.environ.get("LIANA_BIN") or BINARIES).absolute()


def program(name: str) -> str:
    """Path of a program."""
    return str(binaries() / name)


def run(*words: Any, **options: Any) -> subprocess.CompletedProcess[str]:
    """A program to its end: the completed process with text output. `options` are those of subprocess.run; `timeout` is
    PATIENCE_S where none is given."""
    options.setdefault("timeout", clients.PATIENCE_S)
    call = [program(str(words[0])), *map(str, words[1:])]
    return subprocess.run(call, capture_output=True, text=True, check=False, **options)


@functools.lru_cache(maxsize=None)
def table(kind: str, name: str) -> str:
    """Canonical JSON of a table under lua/: kind `robot`, `scene` or `buses`; ProgramRefused when there is none."""
    done = run("liana-mission", "eval", kind, name)
    if done.returncode != 0:
        raise ProgramRefused(done.stderr.strip())
    return done.stdout


class System:
    """All programs of one run; `with System() as system:` starts them, and ends them when the block ends.

    `directory` holds what they write: NAME.log of each program, tables, events.txt, truth.bin, bench_summary.json, bus
    logs.
    """

    def __init__(
        self,
        expect: str = "client",
        faults: Optional[list[Message]] = None,
        bus_script: Optional[list[Message]] = None,
        seed: int = 1,
        bus: str = "embedded",
        lianad: Iterable[Any] = (),
        bench: Iterable[Any] = (),
        robot: str = "zhu2022",
        scene: str = "panel_slit",
        events: Optional[clients.Path] = None,
        retract_path: Optional[clients.Path] = None,
    ) -> None:
        """`expect`: roles whom virtual time waits for; `faults`, `bus_script`: docs/how-to/run-hil.md; `lianad`,
        `bench`: further words for these programs; `events`: the file of events, events.txt in `directory` unless given;
        `retract_path`: the file that keeps the verified path, retract_path.bin there unless given.
        """
        self.directory = pathlib.Path(tempfile.mkdtemp(prefix="liana-sys-"))
        self.api, self.bus_socket = self.directory / "api", self.directory / "bus"
        self.events_file = pathlib.Path(events or self.directory / "events.txt")
        self.commands = self.directory / "commands.txt"
        self.retract_path = pathlib.Path(retract_path or self.directory / "retract_path.bin")
        self.children: dict[str, subprocess.Popen[bytes]] = {}
        self.clients: list[Client] = []
        self.expect, self.faults, self.script, self.seed = expect, faults, bus_script, seed
        self.robot, self.scene, self.bus = robot, scene, bus
        self.lianad_words, self.bench_words = list(lianad), list(bench)

    # ---- start ----

    def __enter__(self) -> System:
        try:
            self.write_tables()
            self.start_programs()
            return self
        except BaseException:
            self.__exit__(*sys.exc_info())
            raise

    def write_tables(self) -> None:
        """What the programs are given, as files."""
        for kind, name in (("robot", self.robot), ("scene", self.scene), ("buses", self.bus)):
            (self.directory / f"{kind}.json").write_text(table(kind, name))
        for name, content in (("faults", self.faults), ("script", self.script)):
            if content is not None:
                (self.directory / f"{name}.json").write_text(json.dumps(content))

    def tables(self) -> list[Any]:
        """The words that name these files."""
        kinds = ("robot", "scene", "buses")
        return [word for kind in kinds for word in (f"--{kind}", self.directory / f"{kind}.json")]

    def optional(self, option: str, name: str) -> list[Any]:
        """The words that name a file, if there is one."""
        path = self.directory / f"{name}.json"
        return [option, path] if path.exists() else []

    def start(self, name: str, *words: Any) -> None:
        """A program with these words; what it says goes to NAME.log."""
        with open(self.directory / f"{name}.log", "ab") as log:
            call = [program(name), *map(str, words)]
            self.children[name] = subprocess.Popen(call, stdin=subprocess.DEVNULL, stdout=log, stderr=log)

    def start_programs(self) -> None:
        """Bus, lianad and bench, each when the one before listens."""
        self.start_bus()
        self.start_lianad()
        self.start_bench()

    def start_bus(self) -> None:
        words = ["--socket", self.bus_socket, "--buses", self.directory / "buses.json", "--time", "fast"]
        words += ["--log", self.directory, "--stats", self.directory / "bus_stats.json"]
        self.start("liana-bus", *words, *self.optional("--script", "script"))
        wait_until(self.bus_socket.exists, "liana-bus to listen", self.check_running)

    def start_lianad(self) -> None:
        words = ["--api", self.api, "--bus-socket", self.bus_socket, "--time", "fast", "--expect", self.expect]
        words += ["--events", self.events_file, "--commands", self.commands, "--retract-path", self.retract_path]
        self.start("lianad", *self.tables(), *words, *self.lianad_words)
        wait_until(self.api.exists, "lianad to listen", self.check_running)

    def start_bench(self) -> None:
        words = ["--bus-socket", self.bus_socket, "--api", self.api, "--seed", self.seed, *self.reports_of_bench()]
        self.start("liana-bench", *self.tables(), *words, *self.optional("--faults", "faults"), *self.bench_words)

    def reports_of_bench(self) -> list[Any]:
        return ["--truth", self.directory / "truth.bin", "--summary", self.directory / "bench_summary.json"]

    def start_archive(self) -> None:
        """Records into `directory`; with "archive" in `expect` the whole run."""
        self.start("liana-archive", "--api", self.api, "--record", self.directory)

    def start_operator(self, lockstep: bool = True) -> None:
        """The simulated person at the hand controllers."""
        recordings, scene = LUA / "recordings", self.directory / "scene.json"
        words = ["--api", self.api, "--recordings", recordings, "--scene", scene, "--seed", self.seed]
        self.start("liana-operator", *words, *(["--lockstep"] if lockstep else []))

    def start_mission(self, mission: Any, lockstep: bool = True) -> None:
        """A mission script; its report is mission.json."""
        words = ["--api", self.api, "--mission", mission, "--report", self.directory / "mission.json"]
        self.start("liana-mission", "run", *words, *(["--lockstep"] if lockstep else []))

    def client(self, name: str = "test", role: str = "client", lockstep: bool = True, **options: Any) -> Client:
        """A client of this system; closed when the system ends. `options` are those of Client."""
        self.clients.append(Client(self.api, name, role, lockstep, check=self.check_refused, **options))
        return self.clients[-1]

    def stranger(self) -> Connection:
        """A connection that has not said hello."""
        return Connection(self.api)

    # ---- end ----

    def __exit__(
        self, kind: Optional[type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        """Kills what still runs; when the block failed, tells the last words of every program."""
        self.kill_all()
        for each in self.clients:
            each.close()
        if kind is not None:
            for name, child in self.children.items():
                print(f"--- {name}: exit {child.returncode}: {self.log(name)[-600:]}", file=sys.stderr)
        shutil.rmtree(self.directory, ignore_errors=True)

    def kill_all(self) -> None:
        for child in list(self.children.values()):
            if child.poll() is None:
                child.kill()
            child.wait()

    def check_refused(self) -> None:
        """Nobody has to wait for a program that has refused its input."""
        for name, child in self.children.items():
            if child.poll() == BAD_INPUT:
                raise ProgramRefused(self.log(name).strip()[-600:])

    def check_running(self) -> None:
        """While programs start: one that has ended will not listen any more."""
        for name, child in self.children.items():
            if child.poll():
                raise ProgramRefused(self.log(name).strip()[-600:])

    def kill(self, name: str) -> None:
        """Ends a program as `kill -9` does."""
        self.children[name].send_signal(signal.SIGKILL)
        self.children[name].wait()

    def ended(self, name: str) -> int:
        """Waits for a program's end: its exit code."""
        return self.children[name].wait(timeout=clients.PATIENCE_S)

    def shut_down(self, client: Client) -> dict[str, int]:
        """Ends lianad, then bus and bench, which write their summaries; their exit codes."""
        self.end_lianad(client)
        return {name: self.ended(name) for name in ("lianad", "liana-bus", "liana-bench")}

    def end_lianad(self, client: Client) -> None:
        """Asks lianad to end, and reads on until it has."""
        client.request("shutdown")
        try:
            while True:
                client.step()
        except OSError:  # the connection is closed
            pass

    # ---- what is left behind ----

    def log(self, name: str) -> str:
        """What a program said."""
        path = self.directory / f"{name}.log"
        return path.read_text() if path.exists() else ""

    def json(self, name: str) -> Any:
        """The content of a JSON file in `directory`."""
        return json.loads((self.directory / name).read_text())

    def truth(self) -> Truth:
        """What really happened to the arm; whole when liana-bench has ended."""
        return Truth(self.directory / "truth.bin")

    def events(self) -> list[Event]:
        """What happened and why, as lianad wrote it; whole when lianad has ended."""
        return read_events(self.events_file)

    def bus_logs(self) -> list[pathlib.Path]:
        """Every frame of every bus; whole when liana-bus has ended."""
        return sorted(self.directory.glob("can*.log"))

    def emergencies(self) -> dict[int, list[int]]:
        """EMCY codes in the bus logs, by node."""
        codes = collections.defaultdict(list)
        for path in self.bus_logs():
            for line in path.read_text().splitlines():
                identifier, data = line.split()[2].split("#")
                if 0x080 < int(identifier, 16) < 0x100:
                    codes[int(identifier, 16) - 0x080].append(int(data[2:4] + data[0:2], 16))
        return dict(codes)
