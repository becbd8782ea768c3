"""One recorded mission, replayed; and a second run with the same seed, compared file by file."""
import hashlib
import json
import pathlib
import subprocess
import tempfile

from page import table


def recorded_run(binaries, directory):
    subprocess.run(
        [str(binaries / "liana"), "run", "slit_crossing", "--seed", "1", "--record", str(directory)],
        capture_output=True,
        check=False,
    )


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.exists() else "missing"


def measure(binaries):
    with tempfile.TemporaryDirectory(prefix="liana-numbers-") as work:
        first, second = pathlib.Path(work) / "first", pathlib.Path(work) / "second"
        recorded_run(binaries, first)
        recorded_run(binaries, second)
        done = subprocess.run(
            [str(binaries / "liana"), "replay", str(first), "--json"], capture_output=True, text=True, check=False
        )
        result = json.loads(done.stdout) if done.stdout else {"ticks": 0, "differing_ticks": -1}
        files = ["ticks.mcap", "snapshots.mcap", "truth.bin", "can0.log", "can1.log"]
        same = {name: digest(first / name) == digest(second / name) != "missing" for name in files}
    text = f"Replay: {result['ticks']} ticks, {result['differing_ticks']} differ. Two fast runs with one seed:\n\n"
    return {"replay": result, "identical": same}, text + table(
        ["file", "identical"], [[n, "yes" if s else "no"] for n, s in same.items()]
    )
