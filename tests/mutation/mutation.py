#!/usr/bin/env python3
"""Plants one bug after the other in a copy of the tree (mutations.json), builds lianad from it, and runs the scenarios
that have to notice.

`--check`: only that every line to be changed is there once, and that every scenario named exists. `./dev numbers
mutations` runs all.
"""
import argparse
import collections
import concurrent.futures
import contextlib
import io
import json
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "hil" / "scenarios"))

import source_tree  # noqa: E402,F401
import campaign  # noqa: E402
import pairs  # noqa: E402
import scenario  # noqa: E402
from liana import client as clients  # noqa: E402
from run_scenario import FAILURES  # noqa: E402
from scenario_file import Failed  # noqa: E402

IN = " in "  # between a test and its program
TEST_PROGRAMS = {  # and where its tests are
    "core_tests": "tests/firmware_like",
    "liana_hil_tests": "tests/hil",
    "realtime_tests": "tests/host/control/realtime",
    "canopen_tests": "tests/host/drives/canopen",
}
PATIENCE_S = 60  # wall clock after which a program counts as hung; a mutant may hang

# A bug: `edits` in `file`; `planted`: another bug that only the mutated line keeps from the drives; `caught_by`:
# scenarios, or tests as "SUITE.NAME in PROGRAM", of which one must fail.
Mutation = collections.namedtuple("Mutation", "name edits planted caught_by")
Edit = collections.namedtuple("Edit", "file line becomes")


class BadMutation(Exception):
    pass


def mutations(path=HERE / "mutations.json"):
    content = json.loads(path.read_text())
    planted = {name: tuple(Edit(**edit) for edit in edits) for name, edits in content["planted"].items()}
    return [
        Mutation(
            one["name"],
            (Edit(one["file"], one["line"], one["becomes"]),),
            planted[one["planted"]] if "planted" in one else (),
            one["caught_by"],
        )
        for one in content["mutations"]
    ]


def changed(text, edit):
    """The file's text with the line changed; its indentation stays."""
    lines = text.split("\n")
    found = [i for i, line in enumerate(lines) if line.strip() == edit.line]
    if len(found) != 1:
        raise BadMutation(
            f"{edit.file}: the line '{edit.line}' is there {len(found)} times, not once: bring mutations.json up to"
            " date"
        )
    indent = lines[found[0]][: len(lines[found[0]]) - len(lines[found[0]].lstrip())]
    lines[found[0]] = indent + edit.becomes if edit.becomes else ""
    return "\n".join(lines)


def scenarios():
    """Every scenario by name, those for planted bugs included."""
    everything = scenario.all_scenarios() + scenario.all_scenarios(HERE) + pairs.all_pairs() + campaign.short_campaign()
    return {one.name: one for one in everything}


def check(wanted, by_name):
    for one in wanted:
        texts = {}
        for edit in one.planted + one.edits:
            texts[edit.file] = changed(texts.get(edit.file) or (ROOT / edit.file).read_text(), edit)
        for name in one.caught_by:
            if IN in name:
                check_test(one, name)
            elif name not in by_name:
                raise BadMutation(f"{one.name}: caught_by: there is no scenario {name}")


def check_test(one, name):
    """The test is in a file of its program's folder."""
    test, program = name.split(IN)
    if program not in TEST_PROGRAMS:
        raise BadMutation(f"{one.name}: caught_by: {program} is not known; allowed are {', '.join(TEST_PROGRAMS)}")
    words = f"({test.replace('.', ', ')})"
    if not any(words in path.read_text() for path in (ROOT / TEST_PROGRAMS[program]).glob("*_test.cpp")):
        raise BadMutation(f"{one.name}: caught_by: there is no test {test} in {TEST_PROGRAMS[program]}")


class UnitTest:
    """A test of a program that is built from the changed tree; looks like a scenario to what runs it."""

    def __init__(self, name, directory):
        self.test, self.program = name.split(IN)
        self.path = directory / self.program

    def run(self):
        return self

    def go(self):
        done = subprocess.run(
            [self.path, f"--gtest_filter={self.test}"],
            capture_output=True,
            text=True,
            check=False,
            timeout=10 * PATIENCE_S,
        )
        if done.returncode != 0 or "1 test ran" not in done.stdout.replace(
            "1 test from 1 test suite ran", "1 test ran"
        ):
            raise Failed(
                next((line for line in done.stdout.splitlines() if "Failure" in line), f"exit {done.returncode}")
            )


def programs_for(wanted):
    """What is built to see whether these mutations are noticed."""
    names = {name for one in wanted for name in one.caught_by}
    return sorted({name.split(IN)[1] if IN in name else "lianad" for name in names})


def files_of_tree():
    """Names of all that belongs to the tree, committed or not."""
    call = ["git", "-C", str(ROOT), "ls-files", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(call, capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]


def write_changed(path, content):
    """Touches the file only where it changes: what has not changed is not built again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_bytes() != content:
        path.write_bytes(content)


class Workshop:
    """A copy of the tree with a build directory and programs of its own."""

    def __init__(self, directory, binaries, programs=("lianad",)):
        self.programs = programs
        self.tree, self.build, self.bin = directory / "tree", directory / "build", directory / "bin"
        self.bin.mkdir(parents=True, exist_ok=True)
        for program in binaries.glob("liana*"):
            if program.name not in self.programs:
                shutil.copy2(program, self.bin)
        for name in files_of_tree():
            self.write(name, (ROOT / name).read_bytes())
        subprocess.run(
            [
                "cmake",
                "-S",
                self.tree,
                "-B",
                self.build,
                "-G",
                "Ninja",
                "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2",
                f"-DLIANA_TESTS={'ON' if any(program in TEST_PROGRAMS for program in programs) else 'OFF'}",
            ],
            check=True,
            stdout=subprocess.DEVNULL,
        )

    def write(self, name, content):
        write_changed(self.tree / name, content)

    @contextlib.contextmanager
    def with_edits(self, edits):
        """The program with these lines changed; the tree is as it was afterwards."""
        texts = {}
        for edit in edits:
            texts[edit.file] = changed(texts.get(edit.file) or (ROOT / edit.file).read_text(), edit)
        for name, text in texts.items():
            self.write(name, text.encode())
        try:
            call = ["ninja", "-C", self.build, *self.programs]
            built = subprocess.run(call, capture_output=True, text=True, check=False)
            if built.returncode != 0:
                raise BadMutation(f"{edits[-1].line} -> {edits[-1].becomes}: does not build: {built.stdout[-1500:]}")
            for program in self.programs:
                shutil.copy2(self.build / "bin" / program, self.bin)
            yield
        finally:
            for name in texts:
                self.write(name, (ROOT / name).read_bytes())


def why_it_fails(scenario_object):
    """What the scenario complains about; empty when it passes."""
    with contextlib.redirect_stderr(io.StringIO()):  # the last words of programs that were ended
        try:
            scenario_object.run().go()
        except FAILURES as error:
            return str(error) or type(error).__name__
    return ""


def controls(wanted, workshop, by_name, pool):
    """Without the mutation every scenario passes: plain, and where the gate has to stop a planted bug."""
    for planted in sorted({one.planted for one in wanted}):
        names = sorted({name for one in wanted if one.planted == planted for name in one.caught_by})
        with workshop.with_edits(planted):
            for name, why in zip(names, pool.map(why_it_fails, [by_name[name] for name in names])):
                if why:
                    raise BadMutation(f"{name} fails without the mutation, so it proves nothing: {why}")


def run(wanted, binaries, directory):
    """name -> (scenario that noticed, its complaint); (None, "") for a survivor."""
    os.environ["LIANA_BIN"] = str(directory / "bin")
    clients.PATIENCE_S = PATIENCE_S
    by_name = scenarios()
    check(wanted, by_name)
    workshop, outcomes = Workshop(directory, binaries, programs_for(wanted)), {}
    by_name.update((name, UnitTest(name, workshop.bin)) for one in wanted for name in one.caught_by if IN in name)
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        controls(wanted, workshop, by_name, pool)
        for one in wanted:
            with workshop.with_edits(one.planted + one.edits):
                complaints = zip(one.caught_by, pool.map(why_it_fails, [by_name[name] for name in one.caught_by]))
                killer, why = next(((name, why) for name, why in complaints if why), (None, ""))
            outcomes[one.name] = (killer, why)
            print(
                f"{'caught' if killer else 'SURVIVED'}  {one.name}  {killer or ''}  {why[:120]}",
                file=sys.stderr,
                flush=True,
            )
    return outcomes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="build and run nothing")
    parser.add_argument("--only", default="", metavar="TEXT", help="only mutations whose name holds this text")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build" / "bin", help="where the programs are")
    options = parser.parse_args()
    wanted = [one for one in mutations() if options.only in one.name]
    try:
        if options.check:
            check(wanted, scenarios())
            print(f"{len(wanted)} mutations apply")
            return 0
        outcomes = run(wanted, options.bin, ROOT / "build" / "mutation")
    except BadMutation as error:
        print(f"mutation: {error}", file=sys.stderr)
        return 2
    survivors = [name for name, (killer, _) in outcomes.items() if killer is None]
    print(
        f"{len(outcomes) - len(survivors)} of {len(outcomes)} mutations caught"
        + (f"; survived: {', '.join(survivors)}" if survivors else "")
    )
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
