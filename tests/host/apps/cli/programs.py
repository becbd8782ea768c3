"""Calling the built programs from tests: one place for paths and exit codes."""
import atexit
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

BIN = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/bin").resolve()
ROOT = pathlib.Path(__file__).resolve().parents[4]
sys.path.append(str(ROOT / "tests"))  # message.py

# `status` and `estop` find the running systems through these directories: every test program has its own.
os.environ["XDG_RUNTIME_DIR"] = os.environ["TMPDIR"] = tempfile.tempdir = tempfile.mkdtemp(prefix="liana-test-")
atexit.register(shutil.rmtree, tempfile.tempdir, ignore_errors=True)


def liana(*arguments, timeout_s=120):
    """Runs `liana` and returns (exit code, standard output, standard error)."""
    done = subprocess.run(
        [str(BIN / "liana"), *map(str, arguments)], capture_output=True, text=True, timeout=timeout_s, check=False
    )
    return done.returncode, done.stdout, done.stderr


def liana_to_full_disk(*arguments):
    """Runs `liana` with a standard output that takes nothing, and returns (exit code, standard error)."""
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run(
            [str(BIN / "liana"), *map(str, arguments)], stdout=full, stderr=subprocess.PIPE, text=True, check=False
        )
    return done.returncode, done.stderr


def liana_json(*arguments, expected=(0,), timeout_s=120):
    """Runs `liana ... --json`, checks its exit code and returns the object it printed."""
    code, out, error = liana(*arguments, "--json", timeout_s=timeout_s)
    assert code in expected, f"liana {arguments}: exit {code}: {error}"
    return json.loads(out)


def json_of_refusal(code, error):
    """What standard output has with --json where a command is refused with this message."""
    return {"error": {"exit_code": code, "text": error.removeprefix("liana: ").removesuffix("\n")}}


def interrupt(process):
    """Sends SIGINT as soon as the program has a handler of it: before that the system's loader is at work, not
    `liana`. One that has ended by then has no handler any more: the caller sees how it ended.
    """
    caught = 0
    while process.poll() is None and not caught & 1 << (signal.SIGINT - 1):
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
        caught = int(re.search(r"SigCgt:\s*([0-9a-f]+)", status)[1], 16)
    process.send_signal(signal.SIGINT)


def start_liana(*arguments, **options):
    """Starts `liana` without waiting for it."""
    return subprocess.Popen(
        [str(BIN / "liana"), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options
    )
