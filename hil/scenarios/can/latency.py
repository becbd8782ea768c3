"""lianad's real-time thread measured by `liana latency`, idle and under load; runs on the machine that is measured."""
import json
import os
import subprocess
import sys
import tempfile
import time

from liana.system import binaries, program, run
from source_tree import SCENARIOS

SECONDS = 3
# What runs beside, at normal priority, each without end.
DISK = "while dd if=/dev/zero of=$LOAD_DIR/file bs=64k count=64 conv=fsync status=none; do rm -f $LOAD_DIR/file; done"
FORKS = "while /bin/true; do :; done"
CLIENTS = "while :; do $LOAD_BIN/liana status --json > /dev/null 2>&1; done"
FLOOD = [sys.executable, "-S", str(SCENARIOS / "can" / "flood.py")]
CONSOLE = [sys.executable, "-S", "-c", "from can import console_load; console_load.main()"]
LOADS = {
    "idle": [],
    "loaded": [["bash", "-c", DISK], ["bash", "-c", FORKS], ["bash", "-c", CLIENTS], FLOOD],
    "console": [CONSOLE],
}


def activity():
    """Processes started and share of idle time since the machine started, as (forks, idle, all)."""
    lines = [line.split() for line in open("/proc/stat", encoding="ascii")]
    cpu = [int(word) for word in lines[0][1:]]
    return next(int(words[1]) for words in lines if words[0] == "processes"), cpu[3] + cpu[4], sum(cpu)


def wait_until_enabled(measuring):
    """The load is for an arm at work: it begins when the arm is enabled."""
    while measuring.poll() is None:
        told = run("liana", "status", "--json").stdout
        if '"state":"ENABLED"' in told.replace(" ", ""):
            return
        time.sleep(0.05)


def measure(rate, load):
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "LOAD_DIR": folder, "LOAD_BIN": str(binaries())}
        environment["PYTHONPATH"] = os.pathsep.join(sys.path)
        measuring = subprocess.Popen(
            [program("liana"), "latency", "--arm", "light", "--rate", rate, "--seconds", str(SECONDS), "--json"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        if LOADS[load]:
            wait_until_enabled(measuring)
        beside = [
            subprocess.Popen(words, env=environment, stderr=subprocess.DEVNULL, start_new_session=True)
            for words in LOADS[load]
        ]
        before = activity()
        try:
            out, error = measuring.communicate()
        finally:
            after, ended = activity(), [each.args for each in beside if each.poll() is not None]
            for each in beside:
                os.killpg(each.pid, 9)
                each.wait()
    forks, idle, all_time = (now - then for now, then in zip(after, before))
    row = json.loads(out) if out.startswith("{") else {"error": error.strip() or "no report"}
    if ended:
        row["error"] = f"the load ended by itself: {ended}"
    row |= {"machine_idle": round(idle / max(1, all_time), 3), "programs_started": forks}
    return {**row, "rate_hz": float(rate), "load": load}


def rows(words):
    """Measures what these words (RATE:LOAD) name, in turn."""
    if words:  # once without judging it: everything is read then
        run("liana", "latency", "--arm", "light", "--seconds", "0.1", "--json")
    for word in words:
        yield measure(*word.split(":"))
