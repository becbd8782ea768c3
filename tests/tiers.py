"""The tests, in two tiers: `./dev test [deep | FOLDER] [--json]` and `./dev tsan [FOLDER]`.

`--folders` lists what may be asked for, `--shared-memory` says whether Python can make its locks.

A tier is a row of stages. Each test of ctest and each other check is counted; what fails or is skipped is named at the
end. A failure does not keep later stages from running. Exit code 0: all passed; 1: not; 2: bad input."""

import collections
import concurrent.futures
import contextlib
import functools
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/structure"))
import lint
from lint import configure, does

JOBS = os.cpu_count()

# What the proof runs: unit tests of these folders, and whole processes by the names of their tests.
PROVED = ["firmware_like", "host/model/config", "host/control/verification", "host/api/server"]
PROOF = (
    r"^(cli\.(slit_crossing|command_line|mission_steps|new_arm_moves)"
    r"|system\.(drive_faults|requests|killed|recordings|archive|calibration|devices|attacks|way_out))$"
)
# Unit tests that g++ builds, without sanitizers; all others clang builds, with them. alloc_guard_tests: the guard has a
# malloc of its own, and so have sanitizers. socketcan_tests: a virtual machine runs them. closed_loop_tests,
# workspace_tests: minutes of arithmetic, of which sanitizers see a part.
UNSANITIZED = ["alloc_guard_tests", "socketcan_tests", "closed_loop_tests", "workspace_tests"]
# What clang-tidy looks at on every run; of the rest it still has something to say (./dev tidy host hil).
TIDIED = ["firmware_like", "host/base/net", "host/api/server", "host/control/realtime"]
# What has threads of its own.
THREADED = ["host/base/event", "host/storage/archive", "host/control/realtime", "host/control/server"]
ALL_PACKAGES = [
    "build",
    "configure",
    "format",
    "clang",
    "deep",
    "install",
    "chromium",
    "tshark",
    "vm",
    "bits",
    "wasm",
    "npm",
]
FUZZ_SECONDS = 3  # each target
PAGE_SUITES = ["unit", "console", "tls", "run_page", "try", "practice", "vr", "frames"]
BARE_ROOT = "README's first command on a bare Debian 12"
# Tests that may be skipped, by the beginning of their name, and why; any other skip fails.
PLANNED_SKIPS = {
    "AnotherUser.": "only root can connect as somebody else",
    "FullDisk.": "a small disk is mounted, which takes root and a kernel that lets it",
    "RingOfARun.OnAFullDisk": "a small disk is mounted, which takes root and a kernel that lets it",
    "cli.container_page": "one of its tests needs docker's or podman's program",
    "system.runs": "one of its tests is for kernels without CAN, one for those that have real time",
    BARE_ROOT: "makes a root of its own, which takes root and the network",
}
NO_SHARED_MEMORY = (
    "/dev/shm is not there or cannot be written; as root: mkdir -p /dev/shm && mount -t tmpfs tmpfs /dev/shm"
)
LAST_LINES = 40  # of what a failed test printed, said once more beside the verdict


def tell(text):
    print(text, flush=True)


def complain(text):
    print(f"test: {text}", file=sys.stderr, flush=True)


class Tally:
    """What passed, what failed and what was skipped."""

    def __init__(self):
        self.passed = 0
        self.failed, self.skipped, self.ends = [], [], []

    def count(self, name, is_good, last_lines=()):
        """The last lines that a failed one printed are said once more beside the verdict."""
        if is_good:
            self.passed += 1
            return True
        self.failed.append(name)
        if last_lines:
            self.ends.append("\n".join((f"--- {name}, its last lines:", *last_lines)))
        complain(f"failed: {name}")
        return False

    def skip(self, name, reason=""):
        """A skip that is not planned fails."""
        text = f"{name}: {reason}" if reason else name
        planned = [why for begin, why in PLANNED_SKIPS.items() if name.startswith(begin)]
        if planned:
            self.skipped.append(text)
            complain(f"skipped: {text} (planned: {planned[0]})")
        else:
            self.failed.append(f"{name}: skipped, which nobody planned{': ' + reason if reason else ''}")
            complain(f"failed: {text}: skipped, which is not in PLANNED_SKIPS of tests/tiers.py")

    def add_report(self, path, reports=None):
        """Counts a report of ctest (JUnit). Of some tests that ctest takes for passed Python has left out a part; what
        GoogleTest says of a whole program's cases stands in the folder `reports`, where nobody counts the program too.
        """
        for case in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
            name, status = case.get("name"), case.get("status")
            printed = case.findtext("system-out") or ""
            of_cases = reports and reports / f"{name}.xml"
            if of_cases and of_cases.exists():
                if self.add_cases(of_cases) or status == "run":
                    continue
            if status != "fail" and (status != "run" or re.search(r"^OK \(.*skipped=[1-9]", printed, re.M)):
                self.skip(name)
            else:
                self.count(name, status != "fail", printed.splitlines()[-LAST_LINES:])

    def add_cases(self, path):
        """Counts a report of GoogleTest; whether a case failed, or was skipped when nobody planned it."""
        failed_before = len(self.failed)
        for case in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
            name = f"{case.get('classname')}.{case.get('name')}"
            if case.get("result") == "skipped":
                self.skip(name)
            elif case.get("result") == "completed":
                said = "\n".join(failure.text or "" for failure in case.iter("failure"))
                self.count(name, case.find("failure") is None, said.splitlines()[-LAST_LINES:])
        return len(self.failed) > failed_before

    def verdict(self, seconds, as_json):
        for text in self.ends:
            print(text)
        for name in self.failed:
            print(f"failed: {name}")
        for name in self.skipped:
            print(f"skipped: {name}")
        print(f"total: {seconds} s, in which {JOBS} processors worked {processor_seconds():.0f} s")
        counts = {"passed": self.passed, "failed": len(self.failed), "skipped": len(self.skipped), "seconds": seconds}
        if as_json:
            print(json.dumps({**counts, "failed_names": self.failed, "skipped_names": self.skipped}))
        print(", ".join(f"{counts[what]} {what}" for what in ("passed", "failed", "skipped")), flush=True)
        return 0 if self.passed and not self.failed else 1


TALLY = Tally()


def processor_seconds():
    """Of all that has ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


@contextlib.contextmanager
def stage(name):
    """Headline, what is done in it, time; what ran behind it is counted at the end."""
    tell(f"== {name}")
    start, worked_s = time.monotonic(), processor_seconds()
    yield
    worked_s = processor_seconds() - worked_s
    tell(f"   {name}: {time.monotonic() - start:.0f} s, in which {JOBS} processors worked {worked_s:.0f} s")


def check(what, *command):
    """Counts a command by how it ends."""
    last = collections.deque(maxlen=LAST_LINES)
    piped = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "errors": "replace"}
    with subprocess.Popen(command, cwd=ROOT, **piped) as running:
        for line in running.stdout:
            last.append(line.rstrip("\n"))
            tell(last[-1])
    return TALLY.count(what, running.returncode == 0, last)


# --- building ---


def folder_of(preset):
    """Preset tests adds the tests to the folder of programs."""
    return "build/programs" if preset == "tests" else f"build/{preset}"


def ninja(preset, *targets):
    return ["ninja", "-C", folder_of(preset), "-j", str(JOBS), *targets]


def build(preset, *targets, **options):
    return configure(preset, **options) and does(*ninja(preset, *targets), **options)


def objects():
    """Where what was compiled is kept: the bare root need not compile it again."""
    return os.environ.get("CCACHE_DIR", str(ROOT / "build/objects"))


def keeping_objects():
    """Paths count from the top of the tree, so that another one with the same sources has the same objects."""
    return {
        **os.environ,
        "CMAKE_CXX_COMPILER_LAUNCHER": "ccache",
        "CCACHE_DIR": objects(),
        "CCACHE_BASEDIR": str(ROOT),
        "CCACHE_NOHASHDIR": "1",
        "CCACHE_SLOPPINESS": "pch_defines,time_macros,locale",
    }


def build_programs(preset, *targets, **options):
    """The programs and these, of preset programs or tests."""
    return build(preset, "programs", *targets, **options) and does("ln", "-sfn", "programs/bin", "build/bin")


def build_tests(*targets, **options):
    return build_programs("tests", *targets, **options)


def give_way():
    """This process and what it starts take what all others leave of the processors; false where the kernel cannot. Linux
    shares between sessions first, so that it takes a session of its own."""
    os.setsid()
    os.nice(19)
    try:
        pathlib.Path("/proc/self/autogroup").write_text("19", encoding="ascii")
    except OSError:
        return False
    return True


@contextlib.contextmanager
def behind():
    """Gives a function that begins what it is given, one after the other, behind all else; what that gives back waits for
    the end and returns what came out. Where nothing can run behind, it does the work when it is asked for."""
    with concurrent.futures.ProcessPoolExecutor(1) as pool:
        worker = pool.submit(os.getpid).result()
        gives_way = pool.submit(give_way).result()
        try:
            yield lambda *work: pool.submit(*work).result if gives_way else functools.partial(*work)
        except BaseException:  # an interrupt of the keyboard does not reach its session
            os.killpg(worker, signal.SIGTERM)
            raise


def compile_quietly(preset, *targets):
    """What does not compile is told when its turn comes."""
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return configure(preset) and does(*ninja(preset, *targets), **quiet)


def built(make):
    """The stage that builds: whether `make` did."""
    with stage("build"):
        return TALLY.count("build", make())


def install(*groups):
    if not does("host/apps/install/packages", *groups):
        raise SystemExit(1)


# --- stages ---


def run_ctest(preset, folder, *options):
    """The tests registered below tests/FOLDER. `liana estop` of one must not find the systems of others."""
    report, reports = ROOT / "build/report.xml", ROOT / folder_of(preset) / "reports"
    report.unlink(missing_ok=True)
    shutil.rmtree(reports, ignore_errors=True)
    with tempfile.TemporaryDirectory() as home:
        told = ["ctest", "--test-dir", f"{folder_of(preset)}/tests/{folder}", "-j", str(JOBS)]
        told += ["--output-on-failure", "--no-tests=error", "--test-output-size-passed", "65536"]
        told += ["--output-junit", str(report), *(["--progress"] if sys.stdout.isatty() else []), *options]
        does(*told, env={**os.environ, "XDG_RUNTIME_DIR": home, "TMPDIR": home})
    if report.exists() and report.stat().st_size > 0:
        TALLY.add_report(report, reports)
    else:
        TALLY.count(f"ctest in tests/{folder}", False)


def other_tests():
    """What needs the programs as they are shipped. The unit tests are not built there, and ctest knows of each of their
    programs no more than that: sanitizers() runs them. That both compilers make the same of the core, bits.quick sees.
    """
    run_ctest("tests", ".", "-LE", "unit", "-E", f"_NOT_BUILT$|{PROOF}")


def sanitizers():
    """One build by clang with its warnings as errors, its sanitizers and its fuzzer's coverage serves three purposes."""
    compiles = build("checked", "unit_tests", "fuzz_targets")
    if TALLY.count("unit tests and parsers compile with clang", compiles):
        run_ctest("checked", ".", "-L", "unit")
    return compiles


def targets_of(folders):
    return [f"tests/{folder}/all" for folder in folders]


def threads(folders):
    """Their unit tests with ThreadSanitizer."""
    compiles = build("tsan", *targets_of(folders))
    if TALLY.count("what has threads compiles with ThreadSanitizer", compiles):
        for folder in folders:
            run_ctest("tsan", folder, "-L", "unit")


def is_tidy():
    files = [path for path in lint.sources(*TIDIED) if path.endswith(".cpp")]
    return bool(files) and lint.tidy(files)


def fuzz_targets_say(*options):
    told = ["python3", "tests/fuzz/targets.py", "--seed", "1", *options]
    return subprocess.run(told, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=False)


def fuzzing(say_of=fuzz_targets_say):
    """A crash, a hang or too much memory of any target fails by its name."""
    planted = say_of("--seconds", "30", "planted")
    TALLY.count("the fuzzer finds a planted bug", planted.returncode == 1)
    lines = say_of("--seconds", str(FUZZ_SECONDS), "--jobs", str(JOBS)).stdout.splitlines()
    for line in lines:
        verdict, name, rest = (line.split(maxsplit=2) + ["", ""])[:3]
        TALLY.count(f"fuzzing {name}: {rest}", verdict == "good")
    if not lines:
        TALLY.count("fuzzing: no target ran", False)


def no_alloc():
    """The guarded lianad aborts on allocation, locks or file calls inside a tick; a whole mission and the fault paths go
    through it."""
    if not TALLY.count("the no-alloc build", build("tests", "lianad_no_alloc", env=keeping_objects())):
        return
    programs, guarded = ROOT / "build/programs/bin", ROOT / "build/programs/no-alloc"
    for program in programs.glob("liana*"):
        if program.name != "lianad":
            does("cp", "-f", str(program), str(guarded))
    mission = [str(guarded / "liana"), "run", "slit_crossing", "--time", "fast", "--json", str(guarded / "report.json")]
    check("a mission without allocation inside a tick", *mission)
    faults = ["env", f"LIANA_BIN={guarded}", "python3", "tests/system/drive_faults_test.py"]
    check("fault paths without allocation inside a tick", *faults)


def vcan():
    """In a virtual machine, because hardly any build machine has CAN in its kernel."""
    check("SocketCAN on vcan in the virtual machine", "hil/vm/run_in_vm", "build/programs/bin/socketcan_tests")
    scenarios = ["python3", "hil/scenarios/run.py", "--part", "can", "--reduced"]
    check("scenarios on vcan and SJA1000 controllers, latency in the virtual machine", *scenarios)


def page():
    """The page's modules without a browser, then the page in Chromium against a running system; pictures and a table of
    frame times stay in build/page/screens."""
    if check("the page's packages", "host/apps/web/bundle", "--dev"):
        for suite in PAGE_SUITES:
            check(f"the page: {suite}", "node", "tests/page/run.mjs", suite)


def bare_root(*kept):
    can = subprocess.run(["tests/install/run", "--possible"], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=False)
    if can.returncode != 0:
        TALLY.skip(BARE_ROOT, can.stdout.strip())
    else:
        check(BARE_ROOT, "tests/install/run", *kept)


# --- tiers ---


def proof():
    """A user's proof: the controller's arithmetic and rules, then whole processes, by the compiler that made the
    programs."""
    install("build", "configure")
    if not built(lambda: build_tests(*targets_of(PROVED), "tests/system/all", env=keeping_objects())):
        return
    for folder in PROVED:
        with stage(f"tests/{folder}"):
            run_ctest("tests", folder, "-L", "unit")
    with stage("whole processes"):
        run_ctest("tests", ".", "-R", PROOF)


def deep():
    """All the rest. The page comes first: some of the tests are of the page that it builds."""
    install(*ALL_PACKAGES)
    with stage("lint"):
        for name, is_clean in lint.CHECKS.items():
            TALLY.count(name, is_clean())
    if not built(lambda: build_tests("all", *UNSANITIZED, env=keeping_objects())):
        return
    with behind() as begin:
        compiled = begin(compile_quietly, "checked", "unit_tests", "fuzz_targets")
        threaded = begin(compile_quietly, "tsan", *targets_of(THREADED))
        tidied = begin(is_tidy)
        with stage("page"):
            page()
        with stage("tests"):
            other_tests()
        with stage("vcan"):
            vcan()
        with stage("bare root"):
            bare_root(objects())
        with stage("no-alloc"):
            no_alloc()
        with stage("unit tests"):
            compiled()
            compiles = sanitizers()
        with stage("fuzzing"):
            if compiles:
                fuzzing()
        with stage("threads"):
            threaded()
            threads(THREADED)
        with stage("clang-tidy"):
            TALLY.count(f"clang-tidy has nothing to say of {' '.join(TIDIED)}", tidied())


def only_page():
    install("build", "configure", "chromium", "wasm", "npm")
    if built(lambda: build_programs("tests", "try_player")):
        with stage("page"):
            page()


def only_fuzzing():
    install("build", "configure", "clang")
    if built(lambda: build("checked", "fuzz_targets")):
        with stage("fuzzing"):
            fuzzing()


def only_install():
    does("host/apps/install/packages", "install")  # without them it is skipped
    with stage("bare root"):
        bare_root()


def only_folder(folder):
    install(*ALL_PACKAGES)
    if built(lambda: build_tests(f"tests/{folder}/all")):
        with stage("tests"):
            run_ctest("tests", folder)


def only_threads(folders):
    install("build", "configure")
    with stage("threads"):
        threads(folders)


OTHERS = {"deep": deep, "page": only_page, "fuzz": only_fuzzing, "install": only_install}


def folders():
    """Those with tests of ctest."""
    return {str(path.parent.relative_to(ROOT / "tests")) for path in (ROOT / "tests").glob("*/**/CMakeLists.txt")}


def has_shared_memory():
    """Python's process pools make their locks there."""
    return os.path.isdir("/dev/shm") and os.access("/dev/shm", os.W_OK)


def folder_in(words, known):
    """The one folder that the words name, as the tests have it, or none; raises ValueError for any other."""
    if len(words) > 1:
        raise ValueError(f"{' '.join(words)} are several; give one folder, or nothing")
    folder = words[0].removeprefix("tests/").rstrip("/") if words else ""
    if words and folder not in known:
        raise ValueError(f"tests/{folder} has no tests of its own; folders with tests: {' '.join(sorted(known))}")
    return folder


def tier(words):
    """What these words ask for; raises ValueError where nothing does."""
    folder = folder_in(words, folders() | set(OTHERS))
    if folder in ("", "deep", "system", "mutation") and not has_shared_memory():
        raise ValueError(NO_SHARED_MEMORY)
    if not folder:
        return proof
    return OTHERS.get(folder, lambda: only_folder(folder))


def tier_of_threads(words):
    folder = folder_in(words, folders())
    return lambda: only_threads([folder] if folder else THREADED)


def main(words):
    if words == ["--folders"]:
        print(" ".join(sorted(folders() | set(OTHERS))))
        return 0
    if words == ["--shared-memory"]:
        if not has_shared_memory():
            complain(NO_SHARED_MEMORY)
        return 0 if has_shared_memory() else 2
    choose = tier_of_threads if words[:1] == ["--threads"] else tier
    as_json = "--json" in words
    words = [word for word in words if word not in ("--json", "--threads")]
    options = [word for word in words if word.startswith("-")]
    try:
        if options:
            raise ValueError(f"{options[0]}: no such option; allowed: --json")
        run = choose(words)
    except ValueError as error:
        complain(error)
        return 2
    start = time.monotonic()
    run()
    return TALLY.verdict(round(time.monotonic() - start), as_json)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
