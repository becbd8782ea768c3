"""Runs a program of tests/benchmarks: instructions under callgrind, times without. See meter.hpp for the labels."""
import collections
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile


class Failed(Exception):
    """The program stopped with an error; it has said why."""


def run(words):
    # Names are bound before the start: the first call of a library function costs no more than the others.
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "LD_BIND_NOW": "1"}, check=False)
    if done.returncode != 0:
        print(done.stdout, done.stderr, sep="\n", file=sys.stderr)
        raise Failed(f"{' '.join(words)} ended with exit code {done.returncode}")
    return done.stdout


def instructions(*words):
    """Label -> instructions of each counted call of a program with its arguments, in order."""
    counts = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        dump = pathlib.Path(folder) / "dump"
        run(
            [
                "valgrind",
                "--tool=callgrind",
                "--collect-atstart=no",
                "--combine-dumps=yes",
                "--dump-line=no",
                f"--callgrind-out-file={dump}",
                *map(str, words),
            ]
        )
        label = None
        with dump.open(errors="replace") as lines:
            for line in lines:
                if match := re.match(r"desc: Trigger: (?:Client Request: )?(.*)", line):
                    label = match[1]
                elif match := re.match(r"totals: (\d+)", line):
                    counts[label].append(int(match[1]))
    counts.pop("Program termination", None)
    return counts


def times(program):
    """Label -> what the program prints of it: median_ns, worst_ns, note, parts."""
    printed = collections.defaultdict(dict)
    for line in run([str(program)]).splitlines():
        entry = json.loads(line)
        printed[entry.pop("label")].update(entry)
    return printed


def measure(program):
    """(operation, version) -> counts of each call; instructions and times of one part, median and worst; note."""
    printed = times(program)
    measured = {}
    for label, counts in instructions(program).items():
        entry = printed[label]
        parts = entry.get("parts", 1)
        measured[tuple(label.split(" "))] = {
            "counts": counts,
            "instructions": round(statistics.median(counts) / parts),
            "worst_instructions": round(max(counts) / parts),
            "ns": entry["median_ns"] / parts,
            "note": entry.get("note", ""),
        }
    return measured


def ticks(counts):
    """Of all ticks in which the controller moves or holds the arm the median; of every tick the worst. `counts`: phase
    -> instructions.
    """
    controlled = [count for phase, values in counts.items() if phase not in ("disabled", "fault") for count in values]
    return round(statistics.median(controlled)), max(max(values) for values in counts.values())
