"""One version everywhere: CMakeLists.txt states it, and programs, packages and pages agree."""
import importlib
import json
import re
import subprocess
import sys
import unittest

from programs import BIN, ROOT

PROGRAMS = (
    "liana",
    "lianad",
    "liana-archive",
    "liana-bench",
    "liana-bus",
    "liana-gateway",
    "liana-mission",
    "liana-operator",
    "liana-spacemouse",
)


def text_of(path):
    return (ROOT / path).read_text(encoding="utf-8")


VERSION = re.search(r"^project\(liana VERSION (\d+\.\d+\.\d+) ", text_of("CMakeLists.txt"), re.M)[1]


class Version(unittest.TestCase):
    def test_every_program_prints_its_name_and_the_version_of_the_project(self):
        for name in PROGRAMS:
            done = subprocess.run([BIN / name, "--version"], capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, f"{name} {VERSION}\n", ""), name)

    def test_the_python_client_has_the_version_of_the_project(self):
        sys.path.insert(0, str(ROOT / "host/api/python"))
        self.assertEqual(importlib.import_module("liana").__version__, VERSION)

    def test_the_page_has_the_version_of_the_project(self):
        lock = json.loads(text_of("host/apps/web/package-lock.json"))
        found = [
            json.loads(text_of("host/apps/web/package.json"))["version"],
            lock["version"],
            lock["packages"][""]["version"],
        ]
        self.assertEqual(found, [VERSION] * 3)

    def test_the_newest_version_of_the_changelog_is_that_of_the_project(self):
        self.assertEqual(re.search(r"^## (\d\S+) - \d{4}-\d\d-\d\d$", text_of("CHANGELOG.md"), re.M)[1], VERSION)

    def test_the_citation_names_the_version_of_the_project_and_its_date(self):
        date = re.search(rf"^## {re.escape(VERSION)} - (\S+)$", text_of("CHANGELOG.md"), re.M)[1]
        citation = text_of("docs/CITATION.cff")
        self.assertIn(f"\nversion: {VERSION}\n", citation)
        self.assertIn(f"\ndate-released: {date}\n", citation)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
