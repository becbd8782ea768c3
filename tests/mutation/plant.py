#!/usr/bin/env python3
"""Plants the small bugs that rules make in whole rooms (mutants.py), and lists those that no unit test notices.

`plant.py [--count N] [--seed S] [--changed COMMIT] [--slow SECONDS] [--json FILE] ROOM...`, e.g. firmware_like/safety;
single sources will do, too. One build of the room's unit tests holds all bugs. Each is switched on alone, for the tests
that come by it. A test that takes longer than --slow is left out, and named.

Exit code 0: each was noticed; 1: some were not; 2: bad input.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile
import time

from mutation import ROOT, files_of_tree, write_changed

import mutants

PLACE = ROOT / "build" / "mutants"
SWITCHES = "liana_mutants.hpp"
FIRST_S = 1.0  # of a bug's tests the quickest run first, for so long
PATIENCE, PATIENCE_S = 6.0, 5.0  # a bug may hang: so many times what its tests take without it, and so long
MEMORY_BYTES = 4 << 30
SAYS_EVERY_S = 2.0

# A case of a program: which bugs it comes by, and how long it takes.
Case = collections.namedtuple("Case", "name reached seconds")


class BadInput(Exception):
    pass


def tell(text):
    print(text, file=sys.stderr, flush=True)


def sources_of(words, changed=""):
    """The files of rooms, where `changed` is a commit only those that are others since then."""
    names = []
    for word in words:
        path = ROOT / word
        if not path.exists() or ROOT not in path.resolve().parents:
            raise BadInput(f"'{word}': allowed is a folder or source of this tree, e.g. firmware_like/safety")
        found = [path] if path.is_file() else sorted([*path.rglob("*.cpp"), *path.rglob("*.hpp")])
        names += [str(each.resolve().relative_to(ROOT)) for each in found if not each.name.endswith("_main.cpp")]
    if changed:
        call = ["git", "-C", str(ROOT), "diff", "--name-only", changed, "--"]
        done = subprocess.run(call, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise BadInput(f"--changed: {done.stderr.strip()}")
        names = [name for name in names if name in done.stdout.splitlines()]
    return list(dict.fromkeys(names))


def program_of(name):
    """The unit tests of a source: those of the nearest folder of tests that mirrors a folder above it."""
    for folder in pathlib.PurePath(name).parents:
        listed = ROOT / "tests" / folder / "CMakeLists.txt"
        programs = re.findall(r"^add_unit_tests\((\w+)\)", listed.read_text(), re.M) if listed.exists() else []
        if programs:
            return programs[0]
    raise BadInput(f"{name}: there are no unit tests of its folder in tests")


class Bench:
    """A copy of the tree with the bugs of some sources in it, and the unit tests built from it."""

    def __init__(self, names):
        self.tree, self.build = PLACE / "tree", PLACE / "build"
        for name in files_of_tree():
            write_changed(self.tree / name, (ROOT / name).read_bytes())
        write_changed(self.tree / SWITCHES, mutants.header(0).encode())
        self.configure()
        self.mutants = mutants.all_mutants(self.tree, names, self.arguments())
        for name, text in mutants.rewritten(self.tree, self.mutants).items():
            write_changed(self.tree / name, text)
        write_changed(self.tree / SWITCHES, mutants.header(len(self.mutants)).encode())
        self.programs = sorted({program_of(name) for name in names})

    def configure(self):
        call = ["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo"]
        call += ["-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1", "-DLIANA_TESTS=ON", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"]
        call += [f"-DCMAKE_CXX_FLAGS=-w -include {self.tree / SWITCHES}"]
        subprocess.run(call, check=True, stdout=subprocess.DEVNULL)

    def arguments(self):
        """What the sources are parsed with: every folder and definition that any of them is compiled with."""
        found = dict.fromkeys(["-std=c++20", f"-I{self.tree}"])
        for entry in json.loads((self.build / "compile_commands.json").read_text()):
            words = entry["command"].split()
            found.update(dict.fromkeys(word for word in words if re.match(r"-I|-D[A-Z_]+(=\d+)?$", word)))
            found.update((f"-I{words[i + 1]}", None) for i, word in enumerate(words) if word == "-isystem")
        return list(found)

    def make(self):
        call = ["ninja", "-C", self.build, *self.programs]
        built = subprocess.run(call, capture_output=True, text=True, check=False)
        if built.returncode != 0:
            raise BadInput(f"what the rules have made does not build: {built.stdout[-1500:]}")


class Trial:
    """The cases of one program, and which bugs they notice."""

    def __init__(self, path, folder):
        self.path, self.folder = path, folder
        self.environment = {**os.environ}
        for name in ("XDG_RUNTIME_DIR", "XDG_STATE_HOME", "TMPDIR"):
            self.environment[name] = str(folder)

    def call(self, names, timeout, **more):
        return subprocess.run(
            [self.path, "--gtest_fail_fast", f"--gtest_filter={':'.join(names)}"],
            cwd=self.folder,
            env={**self.environment, **more},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=timeout,
            check=False,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES)),
        ).returncode

    def names(self):
        listed = subprocess.run([self.path, "--gtest_list_tests"], capture_output=True, text=True, check=True)
        suite, names = "", []
        for line in listed.stdout.splitlines():
            word = line.split("#")[0].strip()
            if line.startswith(" "):
                names.append(suite + word)
            elif word.endswith("."):
                suite = word
        return names

    def case(self, name, slow_s):
        """None for one that fails or takes too long without a bug."""
        reached = self.folder / f"reached-{name.replace('/', '-')}"
        start = time.monotonic()
        try:
            if self.call([name], slow_s, **{mutants.REACHED: str(reached)}) != 0:
                return None
        except subprocess.TimeoutExpired:
            return None
        return Case(name, reached.read_bytes(), time.monotonic() - start)

    def cases(self, pool, slow_s):
        names = self.names()
        found = list(pool.map(lambda name: self.case(name, slow_s), names))
        left_out = [name for name, case in zip(names, found) if case is None]
        if left_out:
            tell(f"plant: left out, over {slow_s:g} s or failing without a bug: {', '.join(left_out)}")
        return sorted((case for case in found if case), key=lambda case: case.seconds)

    def notices(self, number, cases):
        """What becomes of a bug: `noticed`, `survived`, or `unreached` where no case comes by it."""
        cases = [case for case in cases if case.reached[number]]
        if not cases:
            return "unreached"
        spent_s, first, rest = 0.0, [], []
        for case in cases:
            (first if spent_s < FIRST_S else rest).append(case)
            spent_s += case.seconds
        return "noticed" if any(self.fails(number, part) for part in (first, rest) if part) else "survived"

    def fails(self, number, cases):
        limit_s = PATIENCE * sum(case.seconds for case in cases) + PATIENCE_S
        try:
            return self.call([case.name for case in cases], limit_s, **{mutants.SWITCH: str(number)}) != 0
        except subprocess.TimeoutExpired:
            return True


def run(names, count=None, seed=1, slow_s=8.0, say=tell):
    """(mutant, what became of it), for all or for `count` of them that the seed draws."""
    say(f"plant: {len(names)} sources: looking for what may be wrong in them")
    bench = Bench(names)
    say(f"plant: {len(bench.mutants)} bugs; building {', '.join(bench.programs)} with all of them")
    bench.make()
    numbers = list(range(1, len(bench.mutants) + 1))
    if count is not None and count < len(numbers):
        numbers = sorted(random.Random(seed).sample(numbers, count))
    became = dict.fromkeys(numbers, "unreached")
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for program in bench.programs:
            trial = Trial(bench.build / "bin" / program, pathlib.Path(folder))
            cases, said_s = trial.cases(pool, slow_s), time.monotonic()
            left = [number for number in numbers if became[number] != "noticed"]
            for done, (number, what) in enumerate(zip(left, pool.map(lambda n: trial.notices(n, cases), left)), 1):
                became[number] = what if what != "unreached" else became[number]
                if time.monotonic() - said_s > SAYS_EVERY_S or done == len(left):
                    said_s = time.monotonic()
                    survived = sum(each == "survived" for each in became.values())
                    say(f"plant: {program}: {done} of {len(left)} bugs, {survived} survived")
    return [(bench.mutants[number - 1], became[number]) for number in numbers]


def summary(outcomes):
    """kind -> how many were planted, and noticed."""
    kinds = collections.defaultdict(lambda: [0, 0])
    for mutant, what in outcomes:
        kinds[mutant.kind][0] += 1
        kinds[mutant.kind][1] += what == "noticed"
    return dict(sorted(kinds.items()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rooms", nargs="+", metavar="ROOM")
    parser.add_argument("--count", type=int, help="so many bugs, drawn by the seed; all without")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--changed", default="", metavar="COMMIT", help="only sources that are others since then")
    parser.add_argument(
        "--slow", type=float, default=8.0, metavar="SECONDS", help="tests that take longer are left out"
    )
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write every bug and what became of it here")
    options = parser.parse_args()
    try:
        names = sources_of(options.rooms, options.changed)
        outcomes = run(names, options.count, options.seed, options.slow) if names else []
    except (BadInput, ValueError) as error:
        tell(f"plant: {error}")
        return 2
    if options.json:
        rows = [{**vars(mutant), "outcome": what} for mutant, what in outcomes]
        options.json.write_text(json.dumps(rows, indent=1) + "\n")
    survivors = [(mutant, what) for mutant, what in outcomes if what != "noticed"]
    for mutant, what in survivors:
        print(f"{what}: {mutant}")
    for kind, (planted, noticed) in summary(outcomes).items():
        print(f"{kind}: {noticed} of {planted} noticed")
    print(f"{len(outcomes) - len(survivors)} of {len(outcomes)} bugs noticed")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
