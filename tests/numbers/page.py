"""docs/measurements/figures.md as sections, one per measurement."""
import datetime
import os
import platform
import re
import subprocess

HEAD = """# Measured figures

Written by `./dev numbers`; do not edit by hand. Each section says with which command, when, at which commit and
on what it was measured.
"""


def commit_of(root):
    """Short commit, with + when the working tree differs from it in more than the measured pages."""

    def git(*words):
        return subprocess.run(
            ["git", "-C", str(root), *words], capture_output=True, text=True, check=False
        ).stdout.strip()

    return git("rev-parse", "--short", "HEAD") + (
        "+" if git("status", "--porcelain", "--untracked-files=no", "--", ":!docs/measurements") else ""
    )


def table(head, rows):
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


class Page:
    def __init__(self, path):
        self.path = path
        text = path.read_text() if path.exists() else ""
        self.sections = dict(re.findall(r"^## (\w+)\n(.*?)(?=^## |\Z)", text, re.M | re.S))

    def put(self, name, text, commit, seconds):
        """Replaces the section of that name."""
        machine = f"{os.cpu_count()} processors, {platform.machine()}"
        date = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
        self.sections[
            name
        ] = f"`./dev numbers {name}`, {date}, commit {commit}, {machine}, took {seconds:.0f} s.\n\n{text.strip()}\n\n"

    def write(self):
        body = "".join(f"## {name}\n{text}" for name, text in sorted(self.sections.items()))
        self.path.write_text(f"{HEAD}\n{body.rstrip()}\n")
