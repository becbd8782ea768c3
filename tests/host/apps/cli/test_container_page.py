"""docs/how-to/run-in-a-container.md: its options exist, and `liana doctor` tries what a container may refuse."""
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import unittest

from programs import BIN

PAGE = pathlib.Path(__file__).resolve().parents[4] / "docs" / "how-to" / "run-in-a-container.md"
ENGINES = ("docker", "podman")


def commands():
    """Each command of the page that starts docker, as words."""
    return [shlex.split(line) for line in PAGE.read_text().splitlines() if line.startswith("docker ")]


def split(words):
    """(docker's subcommand, its options, what runs in the container)"""
    inside = words.index("liana") if words[1] == "run" else len(words)
    return words[1], [word for word in words[2:inside] if word.startswith("-")], words[inside + 1 :]


class ContainerPage(unittest.TestCase):
    def test_every_option_of_its_commands_exists(self):
        engine = next((name for name in ENGINES if shutil.which(name)), None)
        if engine is None:
            self.skipTest("neither docker nor podman is on the PATH")
        self.assertGreaterEqual(len(commands()), 5)
        for command, options, _ in map(split, commands()):
            text = subprocess.run([engine, command, "--help"], capture_output=True, text=True, check=True).stdout
            known = set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", text))
            self.assertLessEqual(set(options), known, command)

    def test_what_runs_in_the_container_are_commands_of_liana(self):
        inside = [words for _, _, words in map(split, commands()) if words]
        self.assertGreaterEqual(len(inside), 4)
        for program, command, *_ in inside:
            self.assertEqual(program, "liana")
            done = subprocess.run([f"{BIN}/liana", "help", command], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, command)

    def doctor(self, *prefix):
        words = [*prefix, f"{BIN}/liana", "doctor", "--json"]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        return {each["name"]: each for each in json.loads(done.stdout)["findings"]}

    def test_the_doctor_finds_a_root_without_capabilities_out(self):
        limits = ["prlimit", "--rtprio=0", "--memlock=65536"]
        caps = ["setpriv", "--bounding-set=-all", "--inh-caps=-all"] if os.geteuid() == 0 else []
        found = self.doctor(*limits, *caps)
        for name in ("real-time priority", "memory locking"):
            self.assertFalse(found[name]["good"], found[name])
            self.assertTrue(found[name]["action"])

    def test_the_doctor_says_of_locking_what_the_kernel_does(self):
        small = ["prlimit", "--memlock=65536"]
        mlockall = "import ctypes, sys; sys.exit(ctypes.CDLL(None).mlockall(1) != 0)"
        is_granted = subprocess.run([*small, sys.executable, "-c", mlockall], check=False).returncode == 0
        self.assertEqual(self.doctor(*small)["memory locking"]["good"], is_granted)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
