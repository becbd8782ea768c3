#!/usr/bin/env python3
"""Runs the scenarios of this folder in bring-up order; `./dev hil` builds first and calls this."""
import argparse
import concurrent.futures
import fnmatch
import json
import os
import pathlib
import signal
import sys

import source_tree  # noqa: F401
import campaign
import pairs
import scenario
import slit
import slit_kills
from can import machine, real_drives
from run_scenario import outcome
from scenario_file import BadScenario

WHERE = "embedded bus, lockstep"
LATENCY_RUNS = {"250": 3, "500": 1}  # `./dev numbers latency` measures each three times
REDUCED_RUNS = {"250": 1, "500": 1}
PARTS = ("all", "embedded", "can")


def arguments():
    parser = argparse.ArgumentParser(prog="dev hil", description="scenarios of the bench, in bring-up order")
    parser.add_argument(
        "--only",
        metavar="PATTERN",
        help="only scenarios whose name holds this text or matches it, e.g. 40_faults or '*/late*'",
    )
    parser.add_argument("--json", metavar="FILE", type=pathlib.Path, help="write the results here")
    parser.add_argument(
        "--reduced", action="store_true", help="only the scenarios marked reduced (what ./dev test deep runs)"
    )
    parser.add_argument(
        "--part",
        choices=PARTS,
        default="all",
        help="only what runs on the embedded bus, or only what needs a machine with CAN",
    )
    parser.add_argument(
        "--drives",
        metavar="BUSES",
        help=(
            "run the scenarios on CAN against real drives on the interfaces of this table, by name or file; THE ARM"
            " MOVES"
        ),
    )
    parser.add_argument(
        "--calibration", metavar="FILE", help="with --drives: what liana calibrate measured of this arm"
    )
    parser.add_argument("--check", action="store_true", help="read the scenarios and these options, run nothing")
    options = parser.parse_args()
    if options.calibration and not options.drives:
        parser.error("--calibration belongs to --drives; give both")
    return options


def chosen(options):
    embedded, can = (options.part in ("all", part) and not options.drives for part in ("embedded", "can"))
    everything = real_drives.all_items() if options.drives else []
    everything += scenario.all_scenarios() + pairs.all_pairs() + campaign.short_campaign() if embedded else []
    everything += slit.all_slit() + slit_kills.all_kills() if embedded else []
    everything += machine.all_items() if can else []
    wanted = [one for one in everything if one.reduced or not options.reduced]
    if options.only:
        wanted = [one for one in wanted if options.only in one.name or fnmatch.fnmatch(one.name, options.only)]
    if not wanted:
        raise BadScenario(
            f"--only: {options.only} names no scenario; they are in"
            f" {', '.join(sorted({one.name.split('/')[0] for one in everything}))}"
        )
    return wanted


def run_one(one):
    run = one.run()
    return {"name": one.name, "where": WHERE, **outcome(run)}, [
        {"scenario": one.name, "rule": rule} for rule in run.violations
    ]


def report(row):
    result = "FAILED" if row["outcome"] == "failed" else row["outcome"]
    words = (result, row["name"], f"[{row['where']}]", f"{row['seconds']:.1f} s", ", ".join(row["notes"]), row["why"])
    print("  ".join(words), flush=True)


def run_embedded(wanted):
    """Each in a system of its own, as many at a time as there are processors; rows and violations in bring-up order."""
    rows, violations = [], []
    pool = concurrent.futures.ProcessPoolExecutor(
        os.cpu_count(), initializer=signal.signal, initargs=(signal.SIGINT, signal.SIG_IGN)
    )
    try:
        for row, broken in pool.map(run_one, wanted):
            report(row)
            rows.append(row)
            violations += broken
    finally:
        pool.shutdown(cancel_futures=True)  # those that run are ended by the same Ctrl-C, and tidy up
    return rows, violations


def run_all(wanted, options):
    """Rows of scenarios, violations, rows of latency."""
    if options.drives:
        return real_drives.run_all(wanted, options.drives, options.calibration, report), [], []
    on_can = [one for one in wanted if isinstance(one, machine.Item)]
    rows, violations = run_embedded([one for one in wanted if one not in on_can])
    if not on_can:
        return rows, violations, []
    can_rows, latency = machine.run_all(on_can, report, REDUCED_RUNS if options.reduced else LATENCY_RUNS)
    return rows + can_rows, violations, latency


def write_json(file, content):
    try:
        file.write_text(json.dumps(content, indent=1) + "\n")
        return True
    except OSError as error:
        print(
            f"dev hil: --json: {file} cannot be written: {error.strerror}; make room or give another file",
            file=sys.stderr,
        )
        return False


def main():
    options = arguments()
    try:
        wanted = chosen(options)
        if options.json:
            options.json.open("a").close()
        if any(isinstance(one, machine.Item) for one in wanted):
            machine.check_packages()
        if options.drives and not options.check:
            real_drives.check_buses(options.drives, options.calibration)
    except (BadScenario, machine.NoMachine) as error:
        print(f"dev hil: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(
            f"dev hil: --json: {options.json} cannot be written: {error.strerror};"
            " give a file in a directory that exists",
            file=sys.stderr,
        )
        return 2
    if options.check:
        return 0
    try:
        rows, violations, latency = run_all(wanted, options)
    except KeyboardInterrupt:
        print("dev hil: interrupted: no verdict", file=sys.stderr)
        if options.json and options.json.is_file() and options.json.stat().st_size == 0:
            options.json.unlink()
        return 130
    failed, skipped = ([row["name"] for row in rows if row["outcome"] == outcome] for outcome in ("failed", "skipped"))
    passed = {row["name"] for row in rows if row["outcome"] == "passed"}  # in one that failed, nobody knows
    faults, pair_count = sum(one.fault_count() for one in wanted if one.name in passed), sum(
        isinstance(one, pairs.Pair) for one in wanted
    )
    results = {"scenarios": rows, "faults": faults, "pairs": pair_count, "latency": latency, "violations": violations}
    written = not options.json or write_json(options.json, results)
    print(
        f"{len(rows) - len(failed) - len(skipped)} passed, {len(failed)} failed, {len(skipped)} skipped;"
        f" {faults} faults injected, {pair_count} pairs, {len(violations)} violations"
    )
    print(f"where: {'; '.join(sorted({row['where'] for row in rows}))}")
    return 1 if failed or not written else 0


if __name__ == "__main__":
    sys.exit(main())
