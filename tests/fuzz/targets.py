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
PROGRAMS = ROOT / "build/checked/bin"
FOUND = ROOT / "build/fuzz"
# What is freed is kept apart for a while, and of an allocation some of the way to it: more than this costs half the speed.
ASAN = "quarantine_size_mb=4:malloc_context_size=5"
FLAGS = ["-max_len=1024", "-entropic=0", "-timeout=20", "-rss_limit_mb=2048", "-print_final_stats=1", "-verbosity=0"]


def targets():
    return sorted(path.name.removesuffix("_fuzz") for path in PROGRAMS.glob("*_fuzz"))


def run_target(name, bound):
    """`bound`: -max_total_time=S or -runs=N. Returns executions, seconds, and what was found (None: nothing)."""
    program = PROGRAMS / (f"{name}_fuzz" if name != "planted" else name)
    own = FOUND / name
    own.mkdir(parents=True, exist_ok=True)
    start = time.monotonic()
    log = FOUND / f"{name}.log"
    with log.open("w") as out:
        code = subprocess.run(
            [program, *FLAGS, bound, f"-artifact_prefix={FOUND}/{name}-", own]
            + [folder for folder in [HERE / "corpus" / name] if folder.is_dir()],
            stdout=out,
            stderr=subprocess.STDOUT,
            env={**os.environ, "ASAN_OPTIONS": ASAN},
            check=False,
        ).returncode
    text = log.read_text(errors="replace")
    done = re.search(r"number_of_executed_units:\s*(\d+)", text)
    found = None
    if code != 0:
        said = re.findall(r"^SUMMARY: (.*)|(?:==\d+== )?(ERROR: .*)", text, re.M)
        found = " ".join(said[-1]).strip() if said else f"exit code {code}"
    return {
        "name": name,
        "executions": int(done.group(1)) if done else 0,
        "seconds": time.monotonic() - start,
        "found": found,
    }


def run_all(names, bound, jobs):
    """The results of `names` as they end."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for done in concurrent.futures.as_completed([pool.submit(run_target, name, bound) for name in names]):
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
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    names = options.targets or targets()
    if not names:
        sys.exit(f"{PROGRAMS}: no targets are built")
    results = []
    for result in run_all(names, f"-max_total_time={options.seconds}", options.jobs):
        print(line(result), flush=True)
        results.append(result)
    if any(result["executions"] == 0 for result in results):
        sys.exit(2)
    sys.exit(any(result["found"] for result in results))


if __name__ == "__main__":
    main()
