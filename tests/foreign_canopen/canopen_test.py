"""npm's canopen, a stack that knows nothing of Liana, on the embedded bus."""
import json
import os
import pathlib
import shutil
import subprocess
import threading
import unittest

import embedded_bus
from embedded_bus import EmbeddedBus, Frame
from liana import system
from liana.system import System

HERE = pathlib.Path(__file__).resolve().parent
SCRIPTS = ("package.json", "package-lock.json", "node_end.mjs", "master.mjs", "slave.mjs")
DATA_SHEET = HERE.parents[1] / "hil" / "drive" / "liana_bench_drive.eds"
MOST_WAKES = 20000


def installed_stack(folder):
    """Its packages as package-lock.json names them, in a folder of the build. Its one native part, a checksum of block
    transfers, would have to be compiled: an empty module (crc) stands for it.
    """
    folder.mkdir(parents=True, exist_ok=True)
    lock = folder / "package-lock.json"
    is_there = (folder / "node_modules").exists() and lock.read_text() == (HERE / lock.name).read_text()
    for name in SCRIPTS:
        shutil.copy(HERE / name, folder)
    shutil.copytree(HERE / "crc", folder / "crc", dirs_exist_ok=True)
    if not is_there:
        words = ["npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts"]
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=280, check=False)
        assert done.returncode == 0, f"{words}: {done.stderr}"
    return folder


class Stack:
    """A script of the stack at the end of a pipe: frames in, frames out."""

    def __init__(self, script, *words):
        folder = installed_stack(pathlib.Path(os.environ["LIANA_CANOPEN"]))
        self.child = subprocess.Popen(
            ["node", folder / script, *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        )
        self.found = self.told = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.child.kill()
        self.child.wait()
        self.child.stdin.close()
        self.child.stdout.close()

    def give(self, frames, **more):
        """What it sends in answer; `found` or `error` when its story has ended."""
        told = [{"bus": frame.bus, "id": frame.id, "data": list(frame.data)} for frame in frames]
        self.child.stdin.write(json.dumps({"frames": told, **more}) + "\n")
        line = self.child.stdout.readline()
        assert line, "the stack has ended"
        answer = json.loads(line)
        assert "error" not in answer, answer["error"]
        self.found, self.told = answer.get("found"), answer.get("told")
        return [Frame(frame["bus"], frame["id"], bytes(frame["data"])) for frame in answer["frames"]]


class OnlyDrives(System):
    """Bus and bench, without lianad: somebody else is the master."""

    def start_programs(self):
        self.start_bus()
        words = ["--bus-socket", self.bus_socket, *self.reports_of_bench()]
        self.start("liana-bench", *self.tables(), *words)


@unittest.skipUnless(shutil.which("npm") and shutil.which("node"), "needs npm and node")
class AnotherMaster(unittest.TestCase):
    def test_it_loads_the_data_sheet_of_a_drive_of_the_bench_boots_it_enables_it_and_moves_it_by_pdo(self):
        with OnlyDrives() as drives, Stack("master.mjs", DATA_SHEET) as master:
            bus = EmbeddedBus(drives.bus_socket, embedded_bus.CONTROLLER, "canopen")
            half_us = bus.period_us // 2
            for _ in range(MOST_WAKES):
                wake = bus.wake()
                self.assertIsNotNone(wake, "the bus has ended")
                frames = [frame for frame in wake.frames if frame.bus == 0]
                starts = wake.now_us % bus.period_us == 0
                out = master.give(frames, now_us=wake.now_us, starts=starts)
                if master.found is not None:
                    break
                bus.answer(out, wake.now_us - wake.now_us % half_us + half_us)
            bus.socket.close()
            found = master.found
        self.assertIsNotNone(found, "its story did not end")
        self.assertEqual(found["differ"], [], "the data sheet says otherwise than the drive")
        self.assertGreater(found["compared"], 120)
        self.assertEqual(found["profile"], 0x20192)
        self.assertEqual(found["name"].rstrip("\0"), "Liana bench drive")
        self.assertEqual(found["serial"], 1003)
        self.assertIn("does not exist", found["refused"])
        self.assertAlmostEqual(found["moved"], 2000, delta=3)
        self.assertEqual(found["off"], 0x40, "switch on disabled")


class ForeignDrives(System):
    """Bus and lianad; the drives are the stack's."""

    def __init__(self, stack):
        super().__init__(robot="micro", scene="none", bus="embedded_micro")
        self.stack = stack

    def start_bench(self):
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        bus = EmbeddedBus(self.bus_socket, embedded_bus.PLANT, "canopen")
        while (wake := bus.wake()) is not None:
            out = self.stack.give(wake.frames, now_us=wake.now_us)
            next_us = wake.now_us - wake.now_us % bus.period_us + 2 * bus.period_us
            bus.answer(out, next_us, embedded_bus.WAKE_ON_SYNC)
        bus.socket.close()


def drives_of(robot, buses):
    """What the drives of this robot are, and where they stand at first."""
    table, drives = json.loads(system.table("robot", robot)), []
    motor = table["drives"]
    for bus, entry in enumerate(json.loads(system.table("buses", buses))["buses"]):
        for node in entry["nodes"]:
            drives.append(
                {
                    "id": node,
                    "bus": bus,
                    **motor["identity"],
                    "counts_per_turn": motor["counts_per_turn"],
                    "rated_torque_mNm": round(1000 * motor["rated_torque_Nm"]),
                    "counts": motor["zero_counts"][node - 1],
                }
            )
    return drives


@unittest.skipUnless(shutil.which("npm") and shutil.which("node"), "needs npm and node")
class ForeignSlaves(unittest.TestCase):
    def test_lianad_boots_enables_moves_and_stops_them(self):
        with Stack("slave.mjs", json.dumps(drives_of("micro", "embedded_micro"))) as stack:
            with ForeignDrives(stack) as arm:
                client = arm.client()
                client.enable()
                goal = [angle + 2 for angle in client.state["setpoint_js_deg"]]
                client.call("move_jp", goal_deg=goal)
                client.until(lambda state: state["is_busy"])
                client.until(lambda state: not state["is_busy"] and state["at_rest"])
                self.assertEqual(client.state["faults"], [])
                client.call("stop", reason="test")
                client.until(lambda state: state["state"] == "DISABLED")
                told = stack.told
        counts = json.loads(system.table("robot", "micro"))["drives"]["counts_per_turn"] * 2 / 360
        for drive in told:
            self.assertIn(0x27, drive["states"], "it was enabled")
            self.assertAlmostEqual(drive["moved"], counts, delta=0.01 * counts)
            self.assertEqual(drive["ends"], 0x40)


if __name__ == "__main__":
    unittest.main()
