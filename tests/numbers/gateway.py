"""The console's gateway with many clients at 50 Hz on a moving simulated arm in paced time, and a client that stood still
(docs/reference/console-protocol.md).

Alone: gateway.py [--bin DIR] [--count CLIENTS] [--json].
"""
import contextlib
import json
import os
import pathlib
import selectors
import signal
import subprocess
import sys
import tempfile
import threading
import time

from folders import ROOT
from page import table

sys.path[:0] = [str(ROOT / "tests/system")]

from console_client import HEADER, Console, ANSWERED_TOGETHER  # noqa: E402

SECONDS = 20.0
PAUSED_S = 8.0
FRESH_S = 0.1  # of arm time, which in paced time is wall clock
MAX_CORE_PERCENT, MAX_RESIDENT_MB, MAX_STALE = 2.0, 16.0, 4


class Watched(Console):
    """A client that only counts: who unpacks a thousand records a second in Python measures Python."""

    def _take_record(self, payload):
        self.header = HEADER.unpack_from(payload)
        self.sequences.append(self.header[0])
        if len(self.sequences) % ANSWERED_TOGETHER == 0:
            self.answer_record()


def read_all(clients):
    """Until the first connection ends; for a thread: one for all, because each that has to be woken would be measured,
    too.
    """
    selector = selectors.DefaultSelector()
    for client in clients:
        selector.register(client.socket, selectors.EVENT_READ, client)
    with contextlib.suppress(OSError, ValueError):
        while True:
            for key, _ in selector.select():
                key.data.take()
                while key.data.buffer:
                    key.data.take()


def processor_s(process):
    """Processor time of a process so far."""
    return int(pathlib.Path(f"/proc/{process}/schedstat").read_text().split()[0]) * 1e-9


def resident_MB(process, key="VmHWM"):
    status = pathlib.Path(f"/proc/{process}/status").read_text()
    return int(status.split(f"{key}:")[1].split()[0]) / 1024


def child(parent, name):
    for status in pathlib.Path("/proc").glob("[0-9]*/status"):
        text = status.read_text()
        if text.startswith(f"Name:\t{name}\n") and f"\nPPid:\t{parent}\n" in text:
            return int(status.parent.name)
    raise SystemExit(f"gateway: {name} does not run")


def keep_moving(console, seconds):
    """The tip's segment to and fro, so that every number changes all the time."""
    end = time.monotonic() + seconds
    goal = list(console.state["setpoint_js_deg"])
    while time.monotonic() < end:
        console.until(lambda me: not me.facts["is_busy"] or time.monotonic() > end)
        if time.monotonic() > end:
            return
        goal[8] = -3.0 - goal[8]
        console.call("move_jp", goal_deg=goal)
        console.until(lambda me: me.facts["is_busy"])


def stale_after_pause(console, newest):
    """Records that were old when they came to a client that had read nothing for a while, and the age of the first one
    that was not.
    """
    console.until(lambda me: len(me.sequences) > 10)
    time.sleep(PAUSED_S)
    stale, ages = 0, []
    for _ in range(20):
        while console.take() != "record":
            pass
        age = newest() - console.header[3]
        ages.append(age)
        stale += age > FRESH_S
    return stale, max(ages), next(age for age in ages if age <= FRESH_S)


def stop_times_s(console, count=30):
    """From the stop to its confirmation by lianad; a stop that is in force is confirmed like the first."""
    times = []
    for _ in range(count):
        begin = time.monotonic()
        number = console.stop("measured")
        console.until(lambda me: number in me.answers)
        times.append(time.monotonic() - begin)
        time.sleep(0.05)
    return sorted(times)


class Flood:
    """Clients that send nonsense without end while the block runs, and some that read nothing."""

    FLOODS, DEAF = 4, 4

    def __init__(self, address):
        self.address, self.over = address, False

    def send(self):
        while not self.over:
            with contextlib.suppress(OSError):
                client = Watched(self.address, "flood")
                with contextlib.closing(client):
                    while not self.over:
                        client.send(b'{"op":"nonsense"}')

    def __enter__(self):
        self.deaf = [Watched(self.address, "deaf") for _ in range(self.DEAF)]
        self.threads = [threading.Thread(target=self.send) for _ in range(self.FLOODS)]
        for thread in self.threads:
            thread.start()

    def __exit__(self, *_):
        self.over = True
        for thread in self.threads:
            thread.join()
        for client in self.deaf:
            client.close()


def measure(binaries, count=20):
    home = tempfile.TemporaryDirectory(prefix="liana-gateway-")
    call = [str(binaries / "liana"), "console", "--simulate", "--json", "--listen", "127.0.0.1:0"]
    with home, subprocess.Popen(
        call, stdout=subprocess.PIPE, text=True, env={**os.environ, "TMPDIR": home.name}
    ) as run:
        try:
            address = json.loads(run.stdout.readline())["address"]
            return figures(address, child(run.pid, "liana-gateway"), count)
        finally:
            run.send_signal(signal.SIGINT)


def figures(address, process, count):
    pilot = Console(address, "pilot")
    pilot.enable()
    clients = [Watched(address, "watcher") for _ in range(count - 1)]
    threading.Thread(target=read_all, args=(clients,), daemon=True).start()
    keep_moving(pilot, 2.0)
    before_s, records = processor_s(process), sum(len(client.sequences) for client in clients)
    begin = time.monotonic()
    keep_moving(pilot, SECONDS)
    seconds = time.monotonic() - begin
    percent = 100.0 * (processor_s(process) - before_s) / seconds
    hz = (sum(len(client.sequences) for client in clients) - records) / seconds / len(clients)
    paused = Watched(address, "paused")
    moving = threading.Thread(target=keep_moving, args=(pilot, PAUSED_S + 4.0))
    moving.start()
    stale, oldest_s, fresh_s = stale_after_pause(paused, lambda: max(client.header[3] for client in clients))
    moving.join()
    quiet = stop_times_s(pilot)
    with Flood(address):
        flooded = stop_times_s(pilot)
    values = {
        "clients": count,
        "stop_ms": {
            name: [1e3 * times[len(times) // 2], 1e3 * times[-1]]
            for name, times in (("quiet", quiet), ("flooded", flooded))
        },
        "hz": hz,
        "core_percent": percent,
        "resident_MB": resident_MB(process),
        "stale": stale,
        "oldest_s": oldest_s,
        "first_fresh_s": fresh_s,
    }
    for client in [*clients, pilot, paused]:
        client.close()
    return values, told(values)


def told(values):
    rows = [
        ["processor, % of a core", f"{values['core_percent']:.2f}", MAX_CORE_PERCENT],
        ["resident memory at most, MB", f"{values['resident_MB']:.1f}", MAX_RESIDENT_MB],
        ["records a client and second", f"{values['hz']:.1f}", "50"],
        [f"stale records after {PAUSED_S:g} s without reading", values["stale"], MAX_STALE],
        ["the oldest of them, s", f"{values['oldest_s']:.2f}", ""],
        ["age of the first that was fresh, s", f"{values['first_fresh_s']:.3f}", FRESH_S],
        *[
            [f"stop to its confirmation, {name}: median, worst, ms", " / ".join(f"{time:.1f}" for time in times), ""]
            for name, times in values["stop_ms"].items()
        ],
    ]
    text = (
        f"`liana console --simulate` with {values['clients']} clients of all records, the arm moving, {SECONDS:g} s"
        " ([console-protocol.md](../reference/console-protocol.md)).\n\n"
    )
    return text + table(["", "measured", "target"], rows)


if __name__ == "__main__":
    import alone

    alone.run(measure, __doc__)
