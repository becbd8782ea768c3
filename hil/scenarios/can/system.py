"""lianad and the bench on CAN interfaces of the kernel, in real time, with the light arm."""
import json
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "tests" / "system"))

from liana_system import BIN, SOURCE, System, program, table, wait_until  # noqa: E402

kHardwarePriority = 70  # the bench stands for hardware, which is never late for want of a processor; under lianad's thread (80)
# Kind of bus -> what lianad opens, what the bench opens: one virtual wire; two with a gateway between, which can lose and swap; or the two
# controllers of one emulated bus.
kInterfaces = {"vcan": (("vcan0", "vcan1"), ("vcan0", "vcan1")), "gateway": (("vcan0", "vcan1"), ("vcan2", "vcan3")),
               "sja1000": (("can0", "can2"), ("can1", "can3"))}
# The emulated controllers send in no time: the queue before them keeps the pace. The kernel counts 16 bytes for a frame, 128 us at this rate,
# which is what one with 8 data bytes takes at 1 Mbit/s; there is room for 256.
kWire = ("tbf", "rate", "1mbit", "burst", "32", "limit", "4096")


def command(*words):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise OSError(f"{' '.join(words)}: {(done.stderr or done.stdout).strip()}")


def reset_interfaces(kind):
    """As they were at the start, whatever a scenario left behind."""
    subprocess.run(["cangw", "-F"], capture_output=True, check=False)  # complains when there is nothing to flush
    for name in sorted({name for end in kInterfaces[kind] for name in end}):
        if not os.path.exists(f"/sys/class/net/{name}"):
            command("ip", "link", "add", "dev", name, "type", "vcan")
        command("ip", "link", "set", name, "down")
        command("ip", "link", "set", name, "up")
        if kind == "sja1000":
            command("tc", "qdisc", "replace", "dev", name, "root", *kWire)
    if kind == "gateway":
        for ours, theirs in zip(*kInterfaces[kind]):
            command("cangw", "-A", "-s", ours, "-d", theirs, "-e")
            command("cangw", "-A", "-s", theirs, "-d", ours, "-e")


class CanSystem(System):
    def __init__(self, kind):
        super().__init__()
        reset_interfaces(kind)
        self.ours, self.theirs = kInterfaces[kind]

    def write_tables(self):
        super().write_tables()
        buses = json.loads(table("buses", "vcan"))
        for bus, name in zip(buses["buses"], self.ours):
            bus["name"] = name
        (self.directory / "buses.json").write_text(json.dumps(buses))

    def __enter__(self):
        try:
            self.write_tables()
            self.start_lianad()
            self.start_bench()
            return self
        except BaseException:
            self.__exit__(*sys.exc_info())
            raise

    def start_lianad(self):
        self.api.unlink(missing_ok=True)
        self.start("lianad", *self.tables(), "--api", self.api, "--time", "real", "--physics", "ideal")
        wait_until(lambda: self.api.exists() or self.children["lianad"].poll() is not None, "lianad to listen")

    def start_bench(self):
        self.start("liana-bench", *self.tables(), "--can", ",".join(self.theirs), "--api", self.api, "--arm", "light", "--physics", "ideal",
                   "--truth", self.directory / "truth.bin", "--summary", self.directory / "bench_summary.json")
        os.sched_setscheduler(self.children["liana-bench"].pid, os.SCHED_FIFO, os.sched_param(kHardwarePriority))

    def client(self, **options):
        return super().client(lockstep=False, **options)

    def environment(self):
        """What the commands of a scenario may use."""
        pids = {"LIANAD": self.children["lianad"].pid, "BENCH": self.children["liana-bench"].pid}
        names = {"BUS0": self.ours[0], "BUS1": self.ours[1], "BENCH0": self.theirs[0], "BENCH1": self.theirs[1]}
        return {**os.environ, **names, **{name: str(pid) for name, pid in pids.items()}, "DIR": str(self.directory), "BIN": os.path.dirname(program("liana"))}

    def end_bench(self):
        """The bench goes on for half a second without a bus, then writes truth and summary."""
        self.children["liana-bench"].terminate()
        return self.ended("liana-bench")
