"""Every program that is installed has what Debian's own builds have: read from the built programs with readelf, and from
the commands they were compiled with where a program does not show it."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[3]
PROGRAMS = ["liana", "lianad", "liana-archive", "liana-bus", "liana-bench", "liana-mission", "liana-operator"]
PROGRAMS.append("liana-gateway")
OF_EVERY_SOURCE = ["-fstack-protector-strong", "-fstack-clash-protection", "-D_FORTIFY_SOURCE=2"]


def readelf(program, *what):
    return subprocess.run(["readelf", "-W", *what, str(program)], capture_output=True, text=True, check=True).stdout


def lacking(program):
    """What the program lacks, in words."""
    dynamic, segments, symbols = readelf(program, "-d"), readelf(program, "-l"), readelf(program, "--dyn-syms")
    stack = re.search(r"GNU_STACK.*", segments)
    there = {
        "PIE": "Flags:" in dynamic and " PIE" in dynamic,
        "RELRO": "GNU_RELRO" in segments,
        "BIND_NOW": "BIND_NOW" in dynamic or re.search(r"FLAGS_1.* NOW", dynamic) is not None,
        "a stack without code": stack is not None and " RWE " not in stack.group(),
        "stack protector": "__stack_chk_fail" in symbols,
        "fortified functions": re.search(r"\b__\w+_chk\b", symbols) is not None,
    }
    return [name for name, is_there in there.items() if not is_there]


def sources_of(entry):
    """The sources of host and hil that a command compiles: one, or those that a batch includes."""
    file = pathlib.Path(entry["directory"], entry["file"]).resolve()
    batch = file.name.startswith("unity_") and file.exists()
    files = re.findall(r'^#include "(.*)"$', file.read_text(), re.M) if batch else [file]
    for source in map(pathlib.Path, files):
        if source.is_relative_to(ROOT) and source.relative_to(ROOT).parts[0] in ("host", "hil"):
            yield source


class Hardening(unittest.TestCase):
    def test_every_program_shows_it(self):
        self.assertEqual({name: lacking(BUILD / "bin" / name) for name in PROGRAMS}, {name: [] for name in PROGRAMS})

    def test_every_source_of_host_and_bench_is_compiled_with_it(self):
        wanted = list(OF_EVERY_SOURCE)
        if subprocess.run(["uname", "-m"], capture_output=True, text=True, check=True).stdout.strip() == "x86_64":
            wanted.append("-fcf-protection")
        commands = json.loads((BUILD / "compile_commands.json").read_text())
        seen = 0
        for entry in commands:
            if " -o tests/" in entry["command"]:  # part of a program that is not installed
                continue
            for source in sources_of(entry):
                seen += 1
                missing = [flag for flag in wanted if flag not in entry["command"].split()]
                self.assertEqual(missing, [], source)
        self.assertGreater(seen, 300)

    def test_a_program_without_any_of_it_is_found_out(self):
        with tempfile.TemporaryDirectory() as folder:
            source, program = pathlib.Path(folder) / "bare.c", pathlib.Path(folder) / "bare"
            source.write_text("int main(void) { return 0; }\n")
            bare = ["-no-pie", "-fno-stack-protector", "-Wl,-z,norelro,-z,lazy,-z,execstack"]
            subprocess.run(["gcc", *bare, str(source), "-o", str(program)], check=True, capture_output=True)
            self.assertEqual(len(lacking(program)), 6, lacking(program))


if __name__ == "__main__":
    unittest.main()
