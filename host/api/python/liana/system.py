"""Liana's programs as `liana run` starts them, in virtual time and a folder of their own, for scenarios and tests.

Programs are those in $LIANA_BIN where that is set. Else they are searched in PATH, in the prefix that this package is
installed in, and in the build folder of its source tree (build/bin), in this order.
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

TREE = pathlib.Path(os.path.normpath(pathlib.Path(__file__).resolve() / "../../../../.."))  # tree or prefix of this
DEFAULT_ROBOT = "zhu2022"
DRIVES_OF_EMBEDDED = 15  # of the bus table `embedded`
BAD_INPUT = 2  # exit code of every program that refuses what it was given


class ProgramRefused(LianaError):
    """A program ended because of what it was given; the text is what it said."""


class ProgramMissing(LianaError):
    """A program, or a file that belongs to the programs, is not there; the text says where it was searched."""


def places() -> list[pathlib.Path]:
    """The folders that may have the programs, in the order in which they are searched."""
    if given := os.environ.get("LIANA_BIN"):
        return [pathlib.Path(given).absolute()]
    in_path = [pathlib.Path(folder).absolute() for folder in os.get_exec_path() if folder]
    return [*in_path, TREE / "bin", TREE / "build" / "bin"]


def is_program(path: pathlib.Path) -> bool:
    return path.is_file() and os.access(path, os.X_OK)


def binaries() -> pathlib.Path:
    """The folder of the programs, the first of places() that has `lianad` or `liana`: all are taken from one folder, so
    that their versions agree. ProgramMissing where none has."""
    searched = places()
    for folder in searched:
        if is_program(folder / "lianad") or is_program(folder / "liana"):
            return folder
    said = "LIANA_BIN" if os.environ.get("LIANA_BIN") else "PATH"
    named = "".join(f", {folder}" for folder in searched[-2:])
    raise ProgramMissing(f"lianad is not in {said}{named}: install Liana, build it, or set {said} to its folder")


def program(name: str) -> str:
    """Path of a program; ProgramMissing where it is not beside the others."""
    path = binaries() / name
    if not is_program(path):
        raise ProgramMissing(f"{name} is not in {path.parent}, where other programs of Liana are: install or build it")
    return str(path)


def lua() -> pathlib.Path:
    """The folder of robots, scenes, buses and missions that belongs to the programs."""
    folder = binaries()
    above = [folder.parent / "share" / "liana", folder.parent.parent, folder.resolve() / "../../..", TREE]
    choices = [pathlib.Path(os.path.normpath(each / "lua")) for each in above]
    for choice in choices:
        if (choice / "robots").is_dir():
            return choice
    raise ProgramMissing(f"Liana's tables are in none of {', '.join(map(str, choices))}: install Liana again")


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
    return str(done.stdout)


def bus_of(robot: str, content: Optional[Message] = None) -> str:
    """The bus table that a simulated system of this robot takes, as `liana run` chooses it: its own, else `embedded`
    where that has its drives, else one that is made for them. `content`: of the robot's table, where it is there."""
    try:
        table("buses", f"embedded_{robot}")
        return f"embedded_{robot}"
    except ProgramRefused:
        content = content or json.loads(table("robot", robot))
        drives = len(content["drives"]["zero_counts"])
        return "embedded" if drives == DRIVES_OF_EMBEDDED else f"bench_{drives}"


def start_pose_of(robot: str, content: Optional[Message] = None) -> str:
    """The named pose in which a simulated arm of this robot stands at first, as `liana run` chooses it."""
    content = content or json.loads(table("robot", robot))
    poses = content["named_poses_deg"]
    return str(content.get("start_pose") or next((name for name in ("prepare", "zero") if name in poses), min(poses)))


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
        bus: Optional[str] = None,
        lianad: Iterable[Any] = (),
        bench: Iterable[Any] = (),
        robot: str = DEFAULT_ROBOT,
        scene: Optional[str] = None,
        events: Optional[clients.Path] = None,
        retract_path: Optional[clients.Path] = None,
    ) -> None:
        """`robot`, `scene`, `bus`: names of tables or files. Where no bus is given the robot's own is taken, as by
        `liana run`; where no scene is given, `panel_slit` for `zhu2022`, and `none` for every other robot.

        `expect`: roles whom virtual time waits for; `faults`, `bus_script`: docs/how-to/run-hil.md; `seed`: of the
        simulated errors; `lianad`, `bench`: further words for these programs; `events`: the file of events, events.txt
        in `directory` unless given; `retract_path`: the file that keeps the verified path, retract_path.bin there
        unless given.
        """
        self.directory = pathlib.Path(tempfile.mkdtemp(prefix="liana-sys-"))
        self.api, self.bus_socket = self.directory / "api", self.directory / "bus"
        self.events_file = pathlib.Path(events or self.directory / "events.txt")
        self.commands = self.directory / "commands.txt"
        self.retract_path = pathlib.Path(retract_path or self.directory / "retract_path.bin")
        self.children: dict[str, subprocess.Popen[bytes]] = {}
        self.clients: list[Client] = []
        self.expect, self.faults, self.script, self.seed = expect, faults, bus_script, seed
        self.robot, self.bus = robot, bus
        self.robot_table: Message = {}  # its content, once it is written
        self.scene = scene or ("panel_slit" if robot == DEFAULT_ROBOT else "none")
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
        robot = table("robot", self.robot)
        self.robot_table = json.loads(robot)
        self.bus = self.bus or bus_of(self.robot, self.robot_table)
        (self.directory / "robot.json").write_text(robot)
        for kind, name in (("scene", self.scene), ("buses", self.bus)):
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
        words += ["--stats", self.directory / "bus_stats.json", *self.traffic_of_bus()]
        self.start("liana-bus", *words, *self.optional("--script", "script"))
        wait_until(self.bus_socket.exists, "liana-bus to listen", self.check_running)

    def traffic_of_bus(self) -> list[Any]:
        return ["--log", self.directory]

    def start_lianad(self) -> None:
        words = ["--api", self.api, "--bus-socket", self.bus_socket, "--time", "fast", "--expect", self.expect]
        words += ["--events", self.events_file, "--commands", self.commands, "--retract-path", self.retract_path]
        self.start("lianad", *self.tables(), *words, *self.lianad_words)
        wait_until(self.api.exists, "lianad to listen", self.check_running)

    def start_bench(self) -> None:
        words = ["--bus-socket", self.bus_socket, "--api", self.api, "--seed", self.seed, *self.reports_of_bench()]
        if not any(str(word).split("=")[0] == "--start-pose" for word in self.bench_words):
            words += ["--start-pose", start_pose_of(self.robot, self.robot_table)]
        self.start("liana-bench", *self.tables(), *words, *self.optional("--faults", "faults"), *self.bench_words)

    def reports_of_bench(self) -> list[Any]:
        return ["--truth", self.directory / "truth.bin", "--summary", self.directory / "bench_summary.json"]

    def start_archive(self) -> None:
        """Records into `directory`; with "archive" in `expect` the whole run."""
        self.start("liana-archive", "--api", self.api, "--record", self.directory)

    def start_operator(self, lockstep: bool = True) -> None:
        """The simulated person at the hand controllers."""
        recordings, scene = lua() / "recordings", self.directory / "scene.json"
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
        """Ends lianad, then bus and bench, which write their summaries; their exit codes. A recording is whole then."""
        self.end_lianad(client)
        if "liana-archive" in self.children:
            self.ended("liana-archive")
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
