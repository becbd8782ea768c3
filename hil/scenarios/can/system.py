"""lianad and the bench on CAN interfaces of the kernel, in real time, with the light arm."""
import json
import os
import signal
import socket
import subprocess
import sys
import time

from liana.client import wait_until
from liana.system import System, binaries, table
from scenario_file import expect_that
from source_tree import SCENARIOS

# The bench stands for hardware, which is never late for want of a processor; under lianad's thread (80).
HARDWARE_PRIORITY = 70
LINE_PRIORITY = 75  # of what stands for a wire
# Kind of bus -> what lianad opens, what the bench opens: one virtual wire; two with a gateway between, which can lose
# and swap; the two controllers of one emulated bus; or two adapters on a serial line.
INTERFACES = {
    "vcan": (("vcan0", "vcan1"), ("vcan0", "vcan1")),
    "gateway": (("vcan0", "vcan1"), ("vcan2", "vcan3")),
    "sja1000": (("can0", "can2"), ("can1", "can3")),
    "serial": (("serial0", "serial2"), ("serial1", "serial3")),
}
# The emulated controllers send in no time: the queue before them keeps the pace. The kernel counts 16 bytes for a
# frame, 128 us at this rate, which is what one with 8 data bytes takes at 1 Mbit/s; there is room for 256.
WIRE = ("tbf", "rate", "1mbit", "burst", "32", "limit", "4096")


def command(*words):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise OSError(f"{' '.join(words)}: {(done.stderr or done.stdout).strip()}")


def reset_interfaces(kind):
    """As they were at the start, whatever a scenario left behind."""
    subprocess.run(["cangw", "-F"], capture_output=True, check=False)  # complains when there is nothing to flush
    for name in sorted({name for end in INTERFACES[kind] for name in end}):
        if name not in (known for _, known in socket.if_nameindex()):  # /sys would show another network's
            command("ip", "link", "add", "dev", name, "type", "vcan")
        command("ip", "link", "set", name, "down")
        command("ip", "link", "set", name, "up")
        if kind == "sja1000":
            command("tc", "qdisc", "replace", "dev", name, "root", *WIRE)
    if kind == "gateway":
        for ours, theirs in zip(*INTERFACES[kind]):
            command("cangw", "-A", "-s", ours, "-d", theirs, "-e")
            command("cangw", "-A", "-s", theirs, "-d", ours, "-e")


class CanSystem(System):
    """lianad on the interfaces `ours`, whatever answers there; `lianad`: its words besides."""

    ours = ()

    def start_programs(self):
        self.start_lianad()
        self.start_bench()

    def start_lianad(self):
        self.api.unlink(missing_ok=True)
        words = ["--api", self.api, "--time", "real", "--physics", "ideal", *self.lianad_words]
        self.start("lianad", *self.tables(), *words)
        wait_until(lambda: self.api.exists() or self.children["lianad"].poll() is not None, "lianad to listen")

    def stand_still(self, name, seconds):
        """As `kill -STOP` does."""
        self.children[name].send_signal(signal.SIGSTOP)
        time.sleep(seconds)
        self.children[name].send_signal(signal.SIGCONT)

    def client(self, **options):
        return super().client(lockstep=False, **options)

    def end_drives(self):
        """Ends what answers on the buses, if this system has started it; exit codes."""
        return {}

    def shut_down(self, client):
        self.end_lianad(client)
        return {"lianad": self.ended("lianad"), **self.end_drives()}

    def environment(self):
        """What the commands of a scenario may use."""
        names = {f"BUS{index}": name for index, name in enumerate(self.ours)}
        return {
            **os.environ,
            **names,
            "LIANAD": str(self.children["lianad"].pid),
            "DIR": str(self.directory),
            "BIN": str(binaries()),
        }


class BenchOnCan(CanSystem):
    """With the bench at the other end."""

    def __init__(self, kind, **options):
        super().__init__(**options)
        self.ours, self.theirs, self.line = *INTERFACES[kind], None
        if kind == "serial":
            self.start_line()
        else:
            reset_interfaces(kind)

    def start_line(self):
        """serial_line.py, which makes the interfaces; `$DIR/line` takes its commands."""
        commands = self.directory / "line"
        names = [name for pair in zip(self.ours, self.theirs) for name in pair]
        self.line = subprocess.Popen([sys.executable, "-S", SCENARIOS / "can" / "serial_line.py", commands, *names])
        wait_until(lambda: commands.exists() or self.line.poll() is not None, "the interfaces on serial lines")
        os.sched_setscheduler(self.line.pid, os.SCHED_FIFO, os.sched_param(LINE_PRIORITY))

    def __exit__(self, *why):
        super().__exit__(*why)
        if self.line is not None:
            self.line.kill()
            self.line.wait()

    def write_tables(self):
        super().write_tables()
        buses = json.loads(table("buses", "vcan"))
        for bus, name in zip(buses["buses"], self.ours):
            bus["name"] = name
        (self.directory / "buses.json").write_text(json.dumps(buses))

    def start_bench(self):
        words = ["--can", ",".join(self.theirs), "--api", self.api, "--arm", "light", "--physics", "ideal"]
        self.start("liana-bench", *self.tables(), *words, *self.reports_of_bench(), *self.bench_words)
        os.sched_setscheduler(self.children["liana-bench"].pid, os.SCHED_FIFO, os.sched_param(HARDWARE_PRIORITY))

    def environment(self):
        names = {f"BENCH{index}": name for index, name in enumerate(self.theirs)}
        return {**super().environment(), **names, "BENCH": str(self.children["liana-bench"].pid)}

    def end_drives(self):
        """The bench goes on for half a second without a bus, then writes truth and summary; its exit code."""
        self.children["liana-bench"].terminate()
        return {"liana-bench": self.ended("liana-bench")}

    def torque(self):
        """(for each moment, whether some drive had torque; the largest change of any angle since the last of them, in
        degrees).
        """
        arm, truth = self.json("bench_summary.json")["arm"], self.truth()
        expect_that(arm == "light", f"the bench ran arm {arm}")
        with_torque = [count > 0 for count in truth.column("enabled")]
        last = max((slot for slot, torque in enumerate(with_torque) if torque), default=0)
        return with_torque, truth.travel_deg(last, None) if last else 0.0
