"""Measures at full size and writes docs/measurements/figures.md: `./dev numbers [NAME...]`, all without a name. A section
is replaced by the newest measurement of its name; of the section fuzz single rows can be: `./dev numbers fuzz TARGET...`
measures those targets alone, the rows of the others stay."""

import argparse
import importlib
import json
import pathlib
import subprocess
import sys
import time

from folders import ROOT
from page import Page, commit_of

sys.path.insert(0, str(ROOT / "tests"))
import tiers

NAMES = """mission made_up archive clearance in_slit ik planning distances verdicts detectors force replay golden faults
mutations rooms gateway frames latency sources worst fuzz stability filter human hands pose_pairs random_requests payload
insertion feeding install recover acceptance""".split()
# Programs that sections are measured with, beside those of users.
PROGRAMS = """planning_goals planning_shape planning_teleop plan_from_straight detectors force_friction distances verdicts
stability filter pushes insertion_speeds bench_core bench_worst bits_tape
recover""".split()
PACKAGES = {"frames": ["chromium", "npm"], "made_up": ["bits"], "fuzz": ["clang"], "rooms": ["clang"]}


def fuzz_targets():
    return sorted(path.name.removesuffix("_fuzz.cpp") for path in (ROOT / "tests/fuzz").glob("*_fuzz.cpp"))


def refuse(text):
    """One line says what is wrong."""
    unknown = text.removeprefix("unrecognized arguments: ")
    print(f"numbers: {unknown}{': no such option' if unknown != text else ''}", file=sys.stderr)
    sys.exit(2)


def arguments():
    names = f"{' '.join(NAMES)}; after fuzz targets of it: {' '.join(fuzz_targets())}"
    parser = argparse.ArgumentParser(prog="./dev numbers", description=__doc__)
    parser.error = refuse
    parser.add_argument("names", nargs="*", metavar="NAME", help=names)
    parser.add_argument("--json", action="store_true", help="also print what was measured as JSON")
    parser.add_argument("--bin", default=str(ROOT / "build/bin"), help="where the programs are")
    options = parser.parse_args()
    # What follows `fuzz` is its targets, since some have the name of a section.
    end = options.names.index("fuzz") + 1 if "fuzz" in options.names else len(options.names)
    sections, targets = options.names[:end] or NAMES, options.names[end:]
    for name in sections:
        if name not in NAMES:
            parser.error(f"{name} is not one of {' '.join(NAMES)}")
    for name in targets:
        if name not in fuzz_targets():
            parser.error(f"fuzz {name}: no such target; one of: {' '.join(fuzz_targets())}")
    if not tiers.has_shared_memory():
        parser.error(tiers.NO_SHARED_MEMORY)
    return options, sections, targets


def possible(sections):
    """Those that this machine can measure; install says why not."""
    if "install" not in sections:
        return sections
    told = [ROOT / "tests/install/run", "--possible"]
    can = subprocess.run(told, stdout=subprocess.PIPE, text=True, check=False)
    if can.returncode == 0:
        return sections
    print(f"numbers: skipped: install: {can.stdout.strip()}", file=sys.stderr)
    return [name for name in sections if name != "install"]


def build(sections):
    """Whether all is there that these sections take."""
    tiers.install(
        "build", "configure", "vm", "install", *(group for name in sections for group in PACKAGES.get(name, []))
    )
    good = True
    if "frames" in sections:
        good = tiers.does("host/apps/web/bundle", "--dev") and good
    if "fuzz" in sections:
        good = tiers.build("checked", "fuzz_targets") and tiers.build("fuzz-fast", "fuzz_targets") and good
    if set(sections) - {"install", "fuzz", "rooms"}:
        good = tiers.build_tests(*PROGRAMS) and good
    return good


def main():
    options, sections, targets = arguments()
    sections = possible(sections)
    if not build(sections):
        return 1
    page = Page(ROOT / "docs/measurements/figures.md")
    measured = {}
    for name in sections:
        print(f"== numbers: {name}", file=sys.stderr, flush=True)
        start = time.monotonic()
        parts = {"only": targets} if name == "fuzz" else {}
        values, text = importlib.import_module(name).measure(pathlib.Path(options.bin), **parts)
        measured[name] = values
        page.put(name, text, commit_of(ROOT), time.monotonic() - start)
        page.write()
    if options.json:
        print(json.dumps(measured))
    return 0


if __name__ == "__main__":
    sys.exit(main())
