"""Where scenarios on CAN interfaces and latency measurements run: on this machine where it has CAN, else in virtual machines (hil/vm)."""
import concurrent.futures
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile

import can_scenario
from system import HERE, SOURCE, BIN

RUN_IN_VM = HERE.parents[1] / "vm" / "run_in_vm"
kTimeout_s = 1500  # of wall time for one guest; half a minute to two minutes on a free machine
kGuests = 2  # at a time; each takes one processor
kMostPerGuest = 10  # scenarios in one boot
# Program -> the Debian package it comes from; the guest sees this machine's files.
kPrograms = {"tc": "iproute2", "cansend": "can-utils", "cangen": "can-utils", "cangw": "can-utils", "ip": "iproute2", "choom": "util-linux"}
kPython = "/usr/bin/python3"  # Debian's own, whose files are known
kTools = ("bash", "sh", "env", "date", "dd", "true", "tail", "seq", "sleep", "timeout", "mkdir", "rm", "cat", "grep", "mount", "umount")
kLatency = [("250", "idle"), ("250", "loaded"), ("500", "idle"), ("500", "loaded")]
kWorstWakeup_us = {"idle": 25, "loaded": 50}


class NoMachine(Exception):
    """Something the user has to put right."""


class Item:
    """What is run on CAN: a scenario on one kind of bus, or a latency measurement."""

    def __init__(self, name, word, reduced, faults):
        self.name, self.word, self.reduced, self.faults = name, word, reduced, faults

    def fault_count(self):
        return self.faults

    def is_latency(self):
        return self.name.startswith("latency/")


def all_items():
    scenarios = [Item(f"{one.name}/{kind}", f"{one.name}@{kind}", one.reduced and kind == one.on[0], one.fault_count()) for one in can_scenario.all_scenarios() for kind in one.on]
    return scenarios + [Item(f"latency/{rate}_{load}", f"{rate}:{load}", rate == "250" and load == "idle", 0) for rate, load in kLatency]


def check_packages():
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    missing = sorted({package for program, package in {**kPrograms, kPython: "python3"}.items() if shutil.which(program, path=path) is None})
    if missing:
        raise NoMachine(f"missing packages: {' '.join(missing)}; install them: apt-get install {' '.join(missing)}")


def has_can():
    """This machine makes virtual CAN interfaces, and lets us."""
    try:
        socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW).close()
    except OSError:
        return False
    name = f"liana{os.getpid() % 10000}"
    made = subprocess.run(["ip", "link", "add", "dev", name, "type", "vcan"], capture_output=True, check=False).returncode == 0
    if made:
        subprocess.run(["ip", "link", "del", name], capture_output=True, check=False)
    return made


def where_of(item, native):
    kind = item.word.rpartition("@")[2]
    if item.is_latency():
        return "VM: icount, embedded bus"
    if native and kind != "sja1000":
        return f"this machine's own CAN: {kind}; the clock of the wall, no icount"
    return f"VM: {'SJA1000' if kind == 'sja1000' else 'vcan' if kind == 'vcan' else 'vcan and can-gw'}"


def scenario_guest():
    """Options of a guest with scenarios. It has in memory what it reads, so that its clock never waits for this machine's files."""
    ask = f"import sys; sys.path.insert(0, {str(HERE)!r}); import can_scenario; " \
          "print(*{str(path) for each in list(sys.modules.values()) for path in (getattr(each, '__file__', 0), getattr(each, '__cached__', 0)) if path}, sep='\\n')"
    modules = subprocess.run([kPython, "-S", "-c", ask], capture_output=True, text=True, check=True).stdout.split()
    files = [HERE, SOURCE / "lua", "/etc/ld.so.cache", *[path for path in modules if os.path.exists(path)]]
    programs = [str(BIN / name) for name in ("lianad", "liana-bench", "liana-mission", "liana-archive")]
    # On a processor of 500 MIPS, verifying a move beside the controllers' interrupts takes longer than its command interval; at 1000 it does not.
    words = ["--controllers", "--instruction-ns", "1", *[word for path in files for word in ("--preload", str(path))]]
    return words + [word for name in [kPython, *kTools, *kPrograms, *programs] for word in ("--preload-program", name)]


def in_guest(program, items, native, machine=()):
    """Runs `program` over the items, in a guest of its own or here; the rows it left, and what it said when it did not leave all."""
    with tempfile.TemporaryDirectory(prefix="liana-can-") as folder:
        words = [str(HERE / program)]
        if native:
            call = [sys.executable, *words, f"{folder}/rows", *[item.word for item in items]]
        else:
            call = [RUN_IN_VM, "--icount", *machine, "--timeout", str(kTimeout_s), "--results", folder, "env", f"LIANA_BIN={BIN}", kPython, "-S", *words,
                    "/run/liana-vm/results/rows", *[item.word for item in items]]
        done = subprocess.run(call, capture_output=True, text=True, check=False)
        path = pathlib.Path(folder) / "rows"
        rows = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []
    return rows, f"ended with {done.returncode}: {(done.stderr or done.stdout).strip()[-600:]}"


def scenario_rows(items, native):
    rows, said = in_guest("can_scenario.py", items, native, () if native else scenario_guest())
    found = {f"{row['name']}@{row['on']}": row for row in rows}
    for item in items:
        row = found.get(item.word, {"outcome": "failed", "seconds": 0.0, "why": f"the machine {said}", "notes": []})
        yield {"name": item.name, "where": where_of(item, native), **{key: row[key] for key in ("outcome", "seconds", "why", "notes")}}


def judge_latency(row):
    """What is wrong with a measurement; empty when it holds."""
    if "error" in row:
        return row["error"]
    half_us = 5e5 / row["rate_hz"]
    wrong = [] if row["enabled"] else ["the arm was not enabled all the time"]
    for value, allowed, words in ((row["overruns"], 0, "overruns"), (row["wakeup_us"]["worst"], kWorstWakeup_us[row["load"]], "us worst wake-up"),
                                  (row["tick_us"]["worst"], half_us, "us longest tick")):
        if value > allowed:
            wrong.append(f"{value} {words}, allowed are {allowed:g}")
    return "; ".join(wrong)


def latency_rows(items):
    """(row of scenarios, row of latency) of each."""
    rows, said = in_guest("latency.py", items, False)
    found = {f"{row['rate_hz']:g}:{row['load']}": row for row in rows}
    for item in items:
        row = found.get(item.word, {"error": f"the machine {said}"})
        why = judge_latency(row)
        notes = [] if "error" in row else [f"wake-up {row['wakeup_us']['median']}/{row['wakeup_us']['p99']}/{row['wakeup_us']['worst']} us, tick "
                                           f"{row['tick_us']['median']}/{row['tick_us']['p99']}/{row['tick_us']['worst']} us (median/p99/worst), {row['overruns']} overruns"]
        yield {"name": item.name, "where": where_of(item, False), "outcome": "failed" if why else "passed", "seconds": row.get("seconds", 0.0), "why": why,
               "notes": notes}, row


def chunks(items, size):
    return [items[i:i + size] for i in range(0, len(items), size)]


def run_all(items, report):
    """Runs everything; calls report(row) as rows come; (rows, latency rows)."""
    check_packages()
    native = has_can()
    here = [item for item in items if native and not item.is_latency() and not item.word.endswith("@sja1000")]
    in_vm = [item for item in items if not item.is_latency() and item not in here]
    guests = chunks(in_vm, min(kMostPerGuest, -(-len(in_vm) // kGuests) or 1))
    measured = [[item for item in items if item.name.startswith(f"latency/{rate}_")] for rate in ("250", "500")]
    rows, latency = [], []

    def finish(pairs):
        for row, timing in pairs:
            report(row)
            rows.append(row)
            if timing is not None:
                latency.append(timing)

    with concurrent.futures.ThreadPoolExecutor(kGuests) as pool:
        jobs = [pool.submit(lambda group=group: list(latency_rows(group))) for group in measured if group]
        jobs += [pool.submit(lambda group=group: [(row, None) for row in scenario_rows(group, False)]) for group in guests]
        if here:
            finish((row, None) for row in scenario_rows(here, True))
        for job in jobs:
            finish(job.result())
    return rows, latency
