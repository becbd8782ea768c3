"""Runs fuzz targets of build/checked/bin, several at a time, each for so many seconds or executions, from the corpus in
tests/fuzz/corpus; `./dev fuzz`, `./dev test` and `./dev numbers fuzz` are made of it. A line for each: `good NAME ...`
or `failed NAME ...`. Exit code 1: something was found; its input lies in build/fuzz. 2: a target could not be run."""
import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CHECKED = ROOT / "build/checked/bin"  # with sanitizers
FAST = ROOT / "build/fuzz-fast/bin"  # without, for many executions
FOUND = ROOT / "build/fuzz"
# Bytes of an input at most, unless the target's corpus has a longer one: the fuzzer would cut that, and lose what it
# reaches (lua kept 75 of 1521 edges, tables 1411 of 3117).
MOST_BYTES = 1024
FEW_BYTES = 256  # in a run of many executions: longer ones take as much longer
# What is freed is kept apart for a while, and of an allocation some of the way to it: more than this costs half the speed.
ASAN = "quarantine_size_mb=4:malloc_context_size=5"
# What one input may take. It is time on the wall: in an hour of many executions beside other work, an input of a second
# of processor was once given up after 20, so there it is long enough for a hang alone.
SECONDS_AN_INPUT = 20
SECONDS_AN_INPUT_OF_MANY = 600
FLAGS = ["-entropic=0", "-rss_limit_mb=2048", "-print_final_stats=1", "-verbosity=0"]


def targets():
    return sorted(path.name.removesuffix("_fuzz") for path in CHECKED.glob("*_fuzz"))


def most_bytes(name, least):
    """Of an input of this target, so that no input of its corpus is cut."""
    return max([least, *(path.stat().st_size for path in (HERE / "corpus" / name).glob("*"))])


def run_program(program, name, arguments):
    """One run of a target's program, its log in build/fuzz/NAME.log. Returns executions, and what was found (None:
    nothing).
    """
    log = FOUND / f"{name}.log"
    with log.open("w") as out:
        code = subprocess.run(
            [program, *FLAGS, f"-artifact_prefix={FOUND}/{name}-", *arguments],
            stdout=out,
            stderr=subprocess.STDOUT,
            env={**os.environ, "ASAN_OPTIONS": ASAN},
            check=False,
        ).returncode
    text = log.read_text(errors="replace")
    done = re.search(r"number_of_executed_units:\s*(\d+)", text)
    executions = int(done.group(1)) if done else 0
    if code == 0:
        return executions, None
    said = re.findall(r"^SUMMARY: (.*)|(?:==\d+== )?(ERROR: .*)", text, re.M)
    return executions, " ".join(said[-1]).strip() if said else f"exit code {code}"


def inputs_of(name):
    """Folders of inputs: what runs found grows in the first, the second is the corpus in the tree."""
    own = FOUND / name
    own.mkdir(parents=True, exist_ok=True)
    return [folder for folder in (own, HERE / "corpus" / name) if folder.is_dir()]


def run_target(name, *bounds, least=MOST_BYTES, programs=CHECKED, seconds_an_input=SECONDS_AN_INPUT):
    """`bounds`: -max_total_time=S, -runs=N, -seed=S."""
    program = programs / (f"{name}_fuzz" if name != "planted" else name)
    start = time.monotonic()
    size = most_bytes(name, least)
    executions, found = run_program(
        program, name, [*bounds, f"-max_len={size}", f"-timeout={seconds_an_input}", *inputs_of(name)]
    )
    seconds = time.monotonic() - start
    return {"name": name, "bytes": size, "executions": executions, "seconds": seconds, "found": found}


def run_many(name, executions):
    """So many executions without sanitizers, then every input that reached something new once more with them."""
    bounds = {"least": FEW_BYTES, "programs": FAST, "seconds_an_input": SECONDS_AN_INPUT_OF_MANY}
    result = run_target(name, f"-runs={executions}", **bounds)
    if result["found"] is None:
        again = run_target(name, "-runs=0")
        result["again"], result["found"] = again["executions"], again["found"]
    return result


def run_all(names, jobs, run):
    """The results of `run(name)` as they end, so many jobs at a time."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for done in concurrent.futures.as_completed([pool.submit(run, name) for name in names]):
            yield done.result()


def line(result):
    verdict = "good" if result["found"] is None else "failed"
    text = f"{verdict} {result['name']} {result['executions']} executions in {result['seconds']:.0f} s"
    return (
        text
        if result["found"] is None
        else f"{text}: {result['found']}: {FOUND.relative_to(ROOT)}/{result['name']}.log"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("targets", nargs="*", help="without any: all")
    parser.add_argument("--seconds", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0, help="of the mutations; 0: another one each time")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    names = options.targets or targets()
    if not names:
        sys.exit(f"{CHECKED}: no targets are built")
    results = []
    bounds = [f"-max_total_time={options.seconds}", f"-seed={options.seed}"]
    for result in run_all(names, options.jobs, lambda name: run_target(name, *bounds)):
        print(line(result), flush=True)
        results.append(result)
    if any(result["executions"] == 0 for result in results):
        sys.exit(2)
    sys.exit(any(result["found"] for result in results))


if __name__ == "__main__":
    main()
