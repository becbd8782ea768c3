"""README's first command on a bare Debian 12: how long until a newcomer has seen a mission."""

import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def measure(_binaries):
    done = subprocess.run([ROOT / "tests/install/run"], stdout=subprocess.PIPE, text=True, check=True)
    found = re.findall(r"^   ([a-z ]+): (\d+) (s|MB|packages)$", done.stdout, re.M)
    values = {f"{name} [{unit}]": int(figure) for name, figure, unit in found}
    text = "\n".join(f"- {name}: {figure} {unit}" for name, figure, unit in found)
    command = re.search(r"^   command of README, as user \w+: (.*)$", done.stdout, re.M).group(1)
    return (
        values,
        f"`{command}`, in a root made by debootstrap (minbase, with sudo and git), ended with success:\n{text}",
    )
