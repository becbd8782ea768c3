"""Where scenarios on CAN interfaces and latency measurements run: on this machine where it has CAN, else in virtual
machines (hil/vm).
"""
import concurrent.futures
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile

from can import can_scenario, latency_verdict
from can.system import INTERFACES
from liana.system import binaries
from source_tree import SCENARIOS, SOURCE

HERE = SCENARIOS / "can"
GUEST = SCENARIOS / "guest.py"
RUN_IN_VM = SOURCE / "hil" / "vm" / "run_in_vm"
TIMEOUT_S = 1500  # of wall time for one guest; half a minute to two minutes on a free machine
GUESTS = 2  # at a time; each takes one processor
MAX_PER_GUEST = 10  # scenarios in one boot
# Program -> the Debian package it comes from; the guest sees this machine's files.
PROGRAMS = {
    "tc": "iproute2",
    "cansend": "can-utils",
    "cangen": "can-utils",
    "cangw": "can-utils",
    "ip": "iproute2",
    "choom": "util-linux",
    "unshare": "util-linux",
}
LIANA = (
    "liana",
    "lianad",
    "liana-bus",
    "liana-bench",
    "liana-mission",
    "liana-operator",
    "liana-archive",
    "liana-gateway",
)
OWN_KERNEL = ("vcan", "gateway")  # kinds of bus that a machine's own kernel makes in a network of its own
OWN_NETWORK = (
    "unshare",
    "--net",
)  # interfaces and gateway rules that nobody else on this machine sees, gone at the end
PYTHON = "/usr/bin/python3"  # Debian's own, whose files are known
TOOLS = (
    "bash",
    "sh",
    "env",
    "date",
    "dd",
    "true",
    "tail",
    "seq",
    "sleep",
    "timeout",
    "mkdir",
    "mkfifo",
    "rm",
    "cat",
    "grep",
    "mount",
    "umount",
)
# On a processor of 500 MIPS, verifying a move beside the controllers' interrupts takes longer than its command
# interval; at 1000 it does not.
SCENARIO_MACHINE = ("--controllers", "--instruction-ns", "1", "--memory", "1024")
BUSES = {"vcan": "vcan", "gateway": "vcan and can-gw", "sja1000": "SJA1000", "serial": "slcan"}
LATENCY = [("250", "idle"), ("250", "loaded"), ("250", "console"), ("500", "idle"), ("500", "loaded")]


class NoMachine(Exception):
    """Something the user has to put right."""


class Item:
    """What is run on CAN: a scenario on one kind of bus, or a latency measurement. `runs_here`: on this machine, if it
    has CAN.
    """

    def __init__(self, name, word, reduced, faults, runs_here):
        self.name, self.word, self.reduced, self.faults, self.runs_here = name, word, reduced, faults, runs_here

    def fault_count(self):
        return self.faults

    def is_latency(self):
        return self.name.startswith("latency/")


def all_items():
    scenarios = [
        Item(
            f"{one.name}/{kind}",
            f"{one.name}@{kind}",
            one.reduced and kind == one.on[0],
            one.fault_count(),
            kind in OWN_KERNEL and not one.only_in_vm,
        )
        for one in can_scenario.all_scenarios()
        for kind in one.on
        if kind in INTERFACES
    ]
    return scenarios + [
        Item(f"latency/{rate}_{load}", f"{rate}:{load}", rate == "250" and load == "idle", 0, False)
        for rate, load in LATENCY
    ]


def check_packages():
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    missing = sorted(
        {
            package
            for program, package in {**PROGRAMS, PYTHON: "python3"}.items()
            if shutil.which(program, path=path) is None
        }
    )
    if missing:
        raise NoMachine(f"missing packages: {' '.join(missing)}; install them: apt-get install {' '.join(missing)}")


def has_can():
    """This machine makes virtual CAN interfaces, and lets us."""
    try:
        socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW).close()
    except OSError:
        return False
    return (
        subprocess.run(
            [*OWN_NETWORK, "ip", "link", "add", "dev", "vcan0", "type", "vcan"], capture_output=True, check=False
        ).returncode
        == 0
    )


def where_of(item, native):
    kind = item.word.rpartition("@")[2]
    if item.is_latency():
        return "VM: icount, embedded bus"
    if native and item.runs_here:
        return f"this machine's own CAN: {kind}; the clock of the wall, no icount"
    return f"VM: {BUSES[kind]}"


def guest_files():
    """Options of a guest: it is sealed and has in memory what it reads, so that its clock never waits for this
    machine's files.
    """
    ask = (
        f"import sys; sys.path.insert(0, {str(SCENARIOS)!r}); import guest, encodings, can.serial_line, can.console_load;"
        " print(*{str(path) for each in list(sys.modules.values()) for path in (getattr(each, '__file__', 0),"
        " getattr(each, '__cached__', 0)) if path}, sep='\\n')"
    )
    modules = subprocess.run([PYTHON, "-S", "-c", ask], capture_output=True, text=True, check=True).stdout.split()
    encodings = [
        os.path.dirname(path) for path in modules if path.endswith("/encodings/__init__.py")
    ]  # each is read when it is first used
    files = [
        HERE,
        SCENARIOS / "slit",
        SOURCE / "lua",
        "/etc/ld.so.cache",
        *encodings,
        *[path for path in modules if os.path.exists(path)],
    ]
    programs = [str(binaries() / name) for name in LIANA]
    words = ["--sealed", *[word for path in files for word in ("--preload", str(path))]]
    return words + [word for name in [PYTHON, *TOOLS, *PROGRAMS, *programs] for word in ("--preload-program", name)]


def in_guest(what, native, machine=()):
    """Runs guest.py over these words, in a guest of its own or here; the rows it left, and what it said when it did
    not leave all.
    """
    with tempfile.TemporaryDirectory(prefix="liana-can-") as folder:
        if native:
            call = [*OWN_NETWORK, sys.executable, GUEST, f"{folder}/rows", *what]
        else:
            vm = [RUN_IN_VM, "--icount", *machine, *guest_files(), "--timeout", str(TIMEOUT_S), "--results", folder]
            python = ["env", f"LIANA_BIN={binaries()}", PYTHON, "-S", GUEST]
            call = [*vm, *python, "/run/liana-vm/results/rows", *what]
        done = subprocess.run(call, capture_output=True, text=True, check=False, cwd=HERE)
        path = pathlib.Path(folder) / "rows"
        rows = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []
    return rows, f"ended with {done.returncode}: {(done.stderr or done.stdout).strip()[-600:]}"


def scenario_rows(items, native):
    rows, said = in_guest([item.word for item in items], native, SCENARIO_MACHINE)
    found = {f"{row['name']}@{row['on']}": row for row in rows}
    for item in items:
        row = found.get(item.word, {"outcome": "failed", "seconds": 0.0, "why": f"the machine {said}", "notes": []})
        yield {
            "name": item.name,
            "where": where_of(item, native),
            **{key: row[key] for key in ("outcome", "seconds", "why", "notes")},
        }


def latency_rows(items, runs):
    """(row of scenarios, row of latency) of each, measured so often in turn."""
    rows, said = in_guest([item.word for item in items] * runs, False)
    for item in items:
        rate, load = item.word.split(":")
        mine = [row for row in rows if (row["rate_hz"], row["load"]) == (float(rate), load)]
        mine += [{"error": f"the machine {said}"}] * (runs - len(mine))
        timing = latency_verdict.cell(float(rate), load, mine)
        why = latency_verdict.judge(timing)
        yield {
            "name": item.name,
            "where": where_of(item, False),
            "outcome": "failed" if why else "passed",
            "seconds": round(sum(row.get("seconds", 0.0) for row in mine), 2),
            "why": why,
            "notes": latency_verdict.notes(timing),
        }, timing


def chunks(items, size):
    return [items[i : i + size] for i in range(0, len(items), size)]


def run_all(items, report, runs):
    """Runs scenarios, and measures latency so often at each rate; calls report(row) as rows come; (rows, latency
    rows).
    """
    check_packages()
    native = has_can()
    here = [item for item in items if native and item.runs_here]
    in_vm = [item for item in items if not item.is_latency() and item not in here]
    guests = chunks(in_vm, min(MAX_PER_GUEST, -(-len(in_vm) // GUESTS) or 1))
    measured = [
        ([item for item in items if item.name.startswith(f"latency/{rate}_")], count) for rate, count in runs.items()
    ]
    rows, latency = [], []

    def finish(pairs):
        for row, timing in pairs:
            report(row)
            rows.append(row)
            if timing is not None:
                latency.append(timing)

    with concurrent.futures.ThreadPoolExecutor(GUESTS) as pool:
        jobs = [
            pool.submit(lambda group=group, count=count: list(latency_rows(group, count)))
            for group, count in measured
            if group
        ]
        jobs += [
            pool.submit(lambda group=group: [(row, None) for row in scenario_rows(group, False)]) for group in guests
        ]
        if here:
            finish((row, None) for row in scenario_rows(here, True))
        for job in jobs:
            finish(job.result())
    return rows, latency
