"""The same bits from every build of the core: `./dev bits [--json FILE]`. Exit code 0 only if no tick differs, and
planted differences are found.
"""
import argparse
import concurrent.futures
import contextlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
TARGETS = pathlib.Path(__file__).resolve().parent / "target"
NODE = ["node", "--no-warnings", TARGETS / "wasi.mjs"]
QEMU_M7 = [
    "qemu-system-arm",
    "-M",
    "mps2-an500",
    "-nographic",
    "-monitor",
    "none",
    "-serial",
    "none",
    "-semihosting-config",
    "enable=on,target=native",
    "-icount",
    "shift=5",
    "-kernel",
]
WASM = "clang++ --target=wasm32-wasi"
TOOLCHAINS = {
    "arm-none-eabi-g++": ("cortex_m7.cmake", "arm-none-eabi-"),
    "aarch64-linux-gnu-g++": ("aarch64.cmake", "aarch64-linux-gnu-"),
    WASM: (ROOT / "host/apps/web/core/wasm32.cmake", "llvm-"),
}
# What rounds once where source rounds twice: FMA3, FMA4 and AVX-512 on x86, scalar, vector and complex ones on ARM,
# the library's function. Not vmla and vmls of 32-bit ARM: they round the product.
FUSED = re.compile(
    r":\s+(?:v4?fc?n?m(?:add|sub)|vfn?m[as]\b|vfm[as]l|fn?m(?:add?\b|sub\b|sb\b|l[as])|v?f?cmla)|\bR_\w+\s+fma[fl]?\b"
)
# Options under which the core must not compile, and what the message must name (firmware_like/math/arithmetic.hpp).
REFUSED = {
    "-ffast-math": "-ffast-math",
    "-mfma": "-mno-fma",
    "-mavx512f -mno-fma": "-mno-avx512f",
    "-mfpmath=387": "x87",
}
ARMS = ("cable", "serial")
APART = {"cable": 5000, "serial": 500}  # ticks between branches: a serial arm's missions are short
WORST_CASES = ROOT / "tests/benchmarks/worst_cases.txt"
# Times the median of missions, in most ticks of which the shape and the tension plan have nothing to do; on the
# Cortex-M7 that is
WORST_TICK = 1.7
M7_MEDIAN = 58_979  # where the whole slit crossing is not among them (./dev bits measures it)
# A serial arm has no such median: its ticks without a tip command solve no IK. So its worst tick is held by itself.
SERIAL_WORST = 45_000  # instructions on the Cortex-M7; a push of the torque arm takes 41 758
# 5004 needs a drive of the first segment, 5008 something to touch, 5009 a worn arm, 5010 and 5011 load cells, 6001 a
# long mission, 2002 a joint at the end of its range; 2xxx but 2001 are of a serial arm, 5xxx of a cable arm.
NOT_REACHED = {
    "cable": {2002, 2003, 2004, 2005, 5004, 5008, 5009, 5010, 5011, 6001},
    "serial": {2002, *range(5001, 5012), 6001},
}
OF_A_PUSH = {2004, 2005}  # not in the quick tapes, which have none
PATIENCE_S = 900  # wall clock after which a program counts as hung; nothing is measured by it


class Failed(Exception):
    """A step that had to work did not; the text says which and how."""


class Target:
    """One build of the core and its player; with plays=False only looked through: not every machine can run it. With
    fuses=False only played: its machine has no fused operation."""

    def __init__(self, name, compiler, options, quick=False, emulator=(), plays=True, fuses=True):
        self.name, self.compiler, self.options, self.quick = name, compiler, options, quick
        self.emulator, self.plays, self.fuses = emulator, plays, fuses
        self.toolchain, prefix = TOOLCHAINS.get(compiler, (None, ""))
        self.objdump = prefix + "objdump"
        self.is_m7 = compiler == "arm-none-eabi-g++"

    def build(self, work):
        folder = work / self.name
        chosen = [f"-DCMAKE_CXX_COMPILER={self.compiler}", f"-DCMAKE_CXX_FLAGS={self.options}"]
        if self.toolchain:
            chosen = [f"-DCMAKE_TOOLCHAIN_FILE={TARGETS / self.toolchain}", f"-DBITS_OPTIONS={self.options}"]
        if (
            not self.is_m7
        ):  # whose bits_fused replaces single objects; elsewhere all at once take less than half the time
            chosen += ["-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=60"]
        run(["cmake", "-G", "Ninja", "-S", TARGETS, "-B", folder, *chosen], f"configuring {self.name}")
        parts = [] if self.plays else ["liana_core", "player", "planted"]
        run(["ninja", "-C", folder, "-j", "1", *parts], f"building {self.name}")
        return folder

    def look_through(self, folder):
        """Counts fused operations in the disassembly of the core, of what includes its headers, of the planted file."""
        found = {}
        for what, places in {
            "core": ["firmware_like", "CMakeFiles/player.dir"],
            "planted": ["CMakeFiles/planted.dir"],
        }.items():
            objects = [file for place in places for file in sorted((folder / place).rglob("*.o*"))]
            text = run([self.objdump, "-dr", "--no-show-raw-insn", *objects], f"disassembling {self.name}")
            if what == "core":
                self.has_every_arm(text)
            if not re.search(r":\s+ret|:\s+bx\s+lr|:\s+ldmia", text):
                raise Failed(f"disassembling {self.name}: no code in {len(objects)} objects under {folder}")
            found[what] = len(FUSED.findall(text))
        return {
            "name": self.name,
            "compiler": self.compiler,
            "options": self.options,
            "fused": found["core"],
            "fused_planted": found["planted"],
        }

    def has_every_arm(self, text):
        for arm in ARMS:
            if f"5liana{len(arm)}{arm}" not in text:
                raise Failed(f"disassembling {self.name}: no function is of the {arm} arm")

    def play(self, folder, tape, program="bits_ticks"):
        """Plays a tape and compares; what the Cortex-M7 counted comes along."""
        with tempfile.TemporaryDirectory(dir=folder) as place:
            answers = pathlib.Path(place)
            if self.compiler == WASM:  # it sees nothing outside its folder, so no link leads out
                shutil.copyfile(tape.tape, answers / "tape.bits")
            else:
                os.symlink(tape.tape, answers / "tape.bits")
            begin = time.monotonic()
            run([*self.emulator, folder / program], f"playing on {self.name}", cwd=answers)
            result = {
                "name": self.name,
                "compiler": self.compiler,
                "options": self.options,
                "seconds": round(time.monotonic() - begin, 1),
                **tape.tool("compare", "--arm", tape.arm, tape.expected, answers / "outputs.bits"),
            }
            if self.is_m7:
                files = (answers / "outputs.bits", answers / "meter.bits")
                result["meter"] = tape.tool("meter", "--arm", tape.arm, *files)
        return result


# Processors with fused multiply-add, whose every use would change bits. What this machine's has not, QEMU has.
PROCESSOR = set(re.search(r"^flags\s*:(.*)$|\Z", pathlib.Path("/proc/cpuinfo").read_text(), re.M)[0].split())
V3 = [] if {"avx2", "bmi2", "fma", "f16c", "movbe", "abm"} <= PROCESSOR else ["qemu-x86_64", "-cpu", "max"]
ALL_TARGETS = [
    Target("gcc_O2", "g++", "-O2"),  # not quick: the programs that record are built so
    Target("gcc_O3", "g++", "-O3"),
    Target("clang_O2", "clang++", "-O2", quick=True),
    Target("clang_O3", "clang++", "-O3"),
    Target("gcc_O0", "g++", "-O0"),
    Target("clang_O0", "clang++", "-O0"),
    Target("gcc_sanitizers", "g++", "-O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all"),
    Target("gcc_v3_O2", "g++", "-O2 -march=x86-64-v3", quick=True, emulator=V3),
    Target("gcc_v3_O3", "g++", "-O3 -march=x86-64-v3", emulator=V3),
    Target("clang_v3_O3", "clang++", "-O3 -march=x86-64-v3", emulator=V3),
    Target("gcc_v4_O3", "g++", "-O3 -march=x86-64-v4", plays=False),
    Target("gcc_bdver4_O3", "g++", "-O3 -march=bdver4", plays=False),
    Target("aarch64_O2", "aarch64-linux-gnu-g++", "-O2", quick=True, emulator=["qemu-aarch64"]),
    Target("aarch64_v9_O3", "aarch64-linux-gnu-g++", "-O3 -march=armv9-a", emulator=["qemu-aarch64", "-cpu", "max"]),
    Target("wasm32_O2", WASM, "-O2", quick=True, emulator=NODE, fuses=False),
    Target("cortex_m7_O2", "arm-none-eabi-g++", "-O2", quick=True, emulator=QEMU_M7),
]

# Mission, further options, exit code of `liana run`: the last is turned back by its operator, and does not succeed.
SHORT_MISSION = (ROOT / "tests/system/missions/short.lua", [], 0)
SERIAL_MISSIONS = [
    (ROOT / "tests/system/missions/short_micro.lua", ["--robot", "micro"], 0),
    ("micro_reach", ["--robot", "micro"], 0),
    ("payload_install", ["--scene", "payload_at_adapter", "--seed", "1"], 0),
]
MISSIONS = [
    ("slit_crossing", ["--seed", "1"], 0),
    ("slit_crossing", ["--seed", "2", "--physics", "worn"], 0),
    (ROOT / "tests/system/missions/back_out.lua", [], 1),
]


def run(words, what, expected=0, **options):
    """A program to its end; returns its standard output."""
    try:
        done = subprocess.run(
            [str(word) for word in words], capture_output=True, text=True, timeout=PATIENCE_S, check=False, **options
        )
    except FileNotFoundError as reason:
        raise Failed(f"{what}: {words[0]} is not there; ./dev bits installs it") from reason
    except subprocess.TimeoutExpired as reason:
        raise Failed(f"{what}: no end after {PATIENCE_S} s") from reason
    if done.returncode != expected:
        raise Failed(f"{what}: exit code {done.returncode}, not {expected}\n{(done.stdout + done.stderr)[-4000:]}")
    return done.stdout


def record(binaries, place, mission):
    """Runs a mission in virtual time; returns the directory of its recording."""
    what, options, expected = mission
    home = pathlib.Path(tempfile.mkdtemp(dir=place))
    run(
        [binaries / "liana", "run", what, "--time", "fast", *options, "--record", home / "recording"],
        f"mission {what}",
        expected,
        cwd=ROOT,
        env={**os.environ, "XDG_RUNTIME_DIR": str(home)},
    )
    return home / "recording"


class Tape:
    """A tape of recordings (`how`: make) or of costly cases (cases), and the Outputs that are expected of it."""

    def __init__(self, binaries, place, name, how, sources, *options, arm="cable"):
        self.program, self.arm = binaries / "bits_tape", arm
        self.tape, self.expected = place / f"{name}.tape", place / f"{name}.expected"
        of_arm = ["--arm", arm] if how == "make" else []  # costly cases are of the cable arm
        self.summary = self.tool(how, *of_arm, *options, self.tape, self.expected, *sources)

    def tool(self, *words):
        return json.loads(run([self.program, *words], f"bits_tape {words[0]}"))


def refusal(options, named):
    """True when the core's headers refuse to be compiled by g++ with these options, and say why."""
    words = [
        "g++",
        "-std=c++20",
        "-fsyntax-only",
        *options.split(),
        "-I",
        ROOT,
        "-x",
        "c++",
        ROOT / "firmware_like/cable_controller.hpp",
    ]
    done = subprocess.run(
        [str(word) for word in words], capture_output=True, text=True, timeout=PATIENCE_S, check=False
    )
    return done.returncode != 0 and any("#error" in line and named in line for line in done.stderr.splitlines())


def size_of(folder, arm):
    """Bytes of flash and static RAM of the least program with the core of this arm in it."""
    program = folder / f"bits_footprint_{arm}"
    text, data, bss = run(["arm-none-eabi-size", program], "arm-none-eabi-size").splitlines()[1].split()[:3]
    return {"flash_bytes": int(text) + int(data), "static_ram_bytes": int(data) + int(bss)}


def figures(folder, arm, meters, median):
    """What the core needs for this arm on the Cortex-M7; the worst is over all ticks that were counted."""
    worst = max(meters, key=lambda each: each["worst_instructions"])
    stack = max(each["worst_stack_bytes"] for each in meters)
    return {
        **size_of(folder, arm),
        **worst,
        "median_instructions": median,
        "worst_stack_bytes": stack,
        "worst_over_median": round(worst["worst_instructions"] / median, 3),
    }


class Tapes:
    """Whole, brief and falsified: all of one kind of arm, of recordings of its missions."""

    def __init__(self, binaries, place, arm, recordings, apart):
        def tape(name, sources, *options):
            return Tape(binaries, place, f"{arm}-{name}", "make", sources, "--apart", apart, *options, arm=arm)

        self.whole = tape("whole", recordings)
        self.brief = tape("brief", recordings[-1:], "--limit", "2500")
        self.flipped = tape("flipped", recordings[-1:], "--limit", "2500", "--flip-at", "1500")


def planted(pool, targets, built, tapes):
    """What has to be found, for each arm: a core that rounds otherwise, and an input that is another."""
    m7 = next(target for target in targets if target.is_m7)
    found = {}
    for arm in ARMS:
        fused, bit = tapes[arm].brief, tapes[arm].flipped
        what = f"fused multiply-add in one source file of the {arm} arm, on the Cortex-M7"
        found[what] = pool.submit(m7.play, built[m7].result(), fused, "bits_fused")
        found[f"one bit of one input of the {arm} arm"] = pool.submit(targets[0].play, built[targets[0]].result(), bit)
    return found


def measure(options, place, pool):
    targets = [target for target in ALL_TARGETS if target.quick or not options.quick]
    missions = {
        "cable": [SHORT_MISSION] if options.quick else [*MISSIONS, SHORT_MISSION],
        "serial": SERIAL_MISSIONS[:1] if options.quick else SERIAL_MISSIONS,
    }
    recorded = {arm: [pool.submit(record, options.bin, place, one) for one in missions[arm]] for arm in ARMS}
    built = {target: pool.submit(target.build, options.work) for target in targets}
    players = [target for target in targets if target.plays]

    tapes = {}
    for arm in ARMS:
        recordings = [each.result() for each in recorded[arm]]
        tapes[arm] = Tapes(options.bin, place, arm, recordings, APART[arm])
        for each in recordings:
            shutil.rmtree(each.parent)
    costly = Tape(options.bin, place, "costly", "cases", [WORST_CASES])

    played = {
        what: [pool.submit(target.play, built[target].result(), tape) for target in players]
        for what, tape in {"cable": tapes["cable"].whole, "costly": costly, "serial": tapes["serial"].whole}.items()
    }
    found = planted(pool, targets, built, tapes)
    results = {what: [each.result() for each in plays] for what, plays in played.items()}
    m7 = next(target for target in players if target.is_m7)
    meters = {what: each[players.index(m7)].pop("meter") for what, each in results.items()}
    folder, median = options.work / m7.name, {what: each["median_instructions"] for what, each in meters.items()}
    return {
        "tape": tapes["cable"].whole.summary,
        "serial_tape": tapes["serial"].whole.summary,
        "targets": results["cable"],
        "costly": results["costly"],
        "serial": results["serial"],
        "disassembly": [target.look_through(built[target].result()) for target in targets if target.fuses],
        "refused": {flags: refusal(flags, named) for flags, named in REFUSED.items()},
        "planted": {what: each.result() for what, each in found.items()},
        "cortex_m7": figures(
            folder, "cable", [meters["cable"], meters["costly"]], M7_MEDIAN if options.quick else median["cable"]
        ),
        "serial_cortex_m7": figures(folder, "serial", [meters["serial"]], median["serial"]),
    }


def first_of(result):
    first = result.get("first")
    return f"; first: tick {first['tick']}, field {first['field']}" if first else ""


OF_WHAT = {"targets": "", "costly": " of costly cases", "serial": " of a serial arm"}


def show_tape(arm, tape):
    print(
        f"{arm} arm: {tape['mission_ticks']} ticks of missions, {tape['what_if_ticks']} of {tape['what_ifs']} planted"
        " faults and commands"
    )
    reached, missing = (" ".join(map(str, tape[key])) for key in ("faults", "faults_not_reached"))
    print(f"faults among them: {reached}; not reached: {missing}")


def show_m7(arm, m7):
    print(
        f"Cortex-M7, {arm} arm: flash {m7['flash_bytes']} bytes, RAM {m7['static_ram_bytes']} bytes and"
        f" {m7['worst_stack_bytes']} of stack; instructions per tick: median {m7['median_instructions']:.0f} (enabled),"
        f" worst {m7['worst_instructions']:.0f} (tick {m7['worst_tick']}, {m7['worst_state']}),"
        f" {m7['worst_over_median']:.2f} times the median"
    )


def show(report):
    show_tape("cable", report["tape"])
    show_tape("serial", report["serial_tape"])
    for what, words in OF_WHAT.items():
        for result in report[what]:
            print(
                f"{result['name']:16} {result['ticks']:8} ticks{words}, {result['differing_ticks']} differ"
                f"{first_of(result)}  ({result['seconds']} s)"
            )
    for what, result in report["planted"].items():
        print(
            f"{'found' if result['differing_ticks'] else 'NOT FOUND'}: {what}: {result['differing_ticks']} of"
            f" {result['ticks']} ticks differ{first_of(result)}"
        )
    for seen in report["disassembly"]:
        print(
            f"{seen['name']:16} {seen['fused']} fused operations in the core; planted:"
            f" {seen['fused_planted'] or 'NOT'} found  ({seen['options']})"
        )
    print(
        "refused by the headers: "
        + ", ".join(f"{flags}: {'yes' if refused else 'NO'}" for flags, refused in report["refused"].items())
    )
    show_m7("cable", report["cortex_m7"])
    show_m7("serial", report["serial_cortex_m7"])


def holds(report, quick):
    """No tick differs or costs too much, the comparison is one that finds differences, and every fault was among what
    was compared.
    """
    same = all(result["ticks"] > 0 and result["differing_ticks"] == 0 for what in OF_WHAT for result in report[what])
    found = all(result["differing_ticks"] > 0 for result in report["planted"].values())
    unfused = all(seen["fused"] == 0 and seen["fused_planted"] > 0 for seen in report["disassembly"]) and all(
        report["refused"].values()
    )
    bounded = (
        report["cortex_m7"]["worst_over_median"] <= WORST_TICK
        and report["serial_cortex_m7"]["worst_instructions"] <= SERIAL_WORST
    )
    reached = all(
        set(report[tape]["faults_not_reached"]) <= NOT_REACHED[arm] | (OF_A_PUSH if quick else set())
        for arm, tape in {"cable": "tape", "serial": "serial_tape"}.items()
    )
    return same and found and unfused and bounded and reached


def arguments():
    parser = argparse.ArgumentParser(prog="./dev bits", description=__doc__)
    parser.add_argument(
        "--json", type=argparse.FileType("w"), metavar="FILE", help="also write what was measured as JSON"
    )
    parser.add_argument("--quick", action="store_true", help="a short mission, and fewer targets")
    parser.add_argument(
        "--bin",
        type=lambda path: pathlib.Path(path).resolve(),
        default=ROOT / "build/bin",
        help="where the programs are",
    )
    parser.add_argument(
        "--work",
        type=lambda path: pathlib.Path(path).resolve(),
        default=ROOT / "build/bits",
        help="where the targets are built",
    )
    return parser.parse_args()


def main():
    options = arguments()
    options.work.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    with contextlib.ExitStack() as stack:
        place = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="liana-bits-")))
        pool = stack.enter_context(concurrent.futures.ThreadPoolExecutor(os.cpu_count()))
        report = measure(options, place, pool)
    report["seconds"] = round(time.monotonic() - begin, 1)
    show(report)
    if options.json:
        json.dump(report, options.json, indent=1)
    return 0 if holds(report, options.quick) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failed as reason:
        sys.exit(f"bits: {reason}")
