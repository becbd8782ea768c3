"""What commands of users say about the figures of tests/structure/requirements.txt: each command runs once."""
import concurrent.futures
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

from folders import ROOT
from page import table

import requirements

REDUCE = {"count": len, "max": max, "min": min, "sum": sum, "median": statistics.median}
WHERE = re.compile(rf"((?:(?:{'|'.join(REDUCE)}|abs) )*)(.+?)(?: x ([\d.e+-]+))?")


def values_at(node, path):
    """What a path of keys leads to in JSON: `*` is each entry, a number one of a list, `key=text` those with it."""
    if not path:
        return [node]
    key, rest = path[0], path[1:]
    if key == "*":
        entries = node.values() if isinstance(node, dict) else node
        return [found for each in entries for found in values_at(each, rest)]
    if "=" in key:
        name, text = key.split("=", 1)
        return [found for each in node if each.get(name) == text for found in values_at(each, rest)]
    return values_at(node[int(key)] if isinstance(node, list) else node[key], rest)


def reduced(functions, values):
    """The functions before a path, the last first; one number must be left."""
    for name in reversed(functions.split()):
        values = [abs(value) for value in values] if name == "abs" else [REDUCE[name](values)]
    if len(values) != 1:
        raise ValueError(f"{len(values)} values, not one")
    return float(values[0])


def value_of(document, where):
    """The number that `max abs way.*.turn_deg x 1000` is; LookupError, TypeError or ValueError where there is none."""
    functions, path, factor = WHERE.fullmatch(where).groups()
    return reduced(functions, values_at(document, path.split("."))) * float(factor or 1)


def asked():
    """{command: places in its JSON} of all figures that a command gives."""
    rows, _ = requirements.read_list((ROOT / requirements.LIST).read_text())
    commands = {}
    for figure in (figure for row in rows for figure in row.figures if figure.source.startswith("liana ")):
        commands.setdefault(figure.source, []).append(figure.where)
    return {command: list(dict.fromkeys(places)) for command, places in commands.items()}


def answer_of(binaries, command, folder):
    """The JSON that a command gives, None where it gives none."""
    words, file = [str(binaries / "liana"), *command.split()[1:]], folder / "report.json"
    is_run = words[1] == "run"
    words += ["--lean", "--json", str(file)] if is_run else [] if words[1:3] == ["robot", "export"] else ["--json"]
    environment = {**os.environ, "XDG_STATE_HOME": str(folder), "XDG_RUNTIME_DIR": str(folder), "TMPDIR": str(folder)}
    done = subprocess.run(words, capture_output=True, text=True, check=False, env=environment)
    try:
        return json.loads(file.read_text() if is_run else done.stdout)
    except (OSError, ValueError):
        print(f"acceptance: {command}: {done.stderr.strip()[-300:]}", file=sys.stderr, flush=True)
        return None


def rows_of(binaries, command, places):
    """One row for each place; "-" where the answer has no such number."""
    begun = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="liana-accept-") as folder:
        document = answer_of(binaries, command, type(ROOT)(folder))
    rows = []
    for where in places:
        try:
            rows.append([command, where, f"{value_of(document, where):.6g}"])
        except (LookupError, TypeError, ValueError) as error:
            print(f"acceptance: {command}: {where}: {error!r}", file=sys.stderr, flush=True)
            rows.append([command, where, "-"])
    print(f"   {command}: {time.monotonic() - begun:.0f} s", file=sys.stderr, flush=True)
    return rows


def measure(binaries):
    commands = asked()
    print(f"   {len(commands)} commands, some of them take minutes", file=sys.stderr, flush=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        parts = list(pool.map(lambda one: rows_of(binaries, *one), commands.items()))
    rows = [row for part in parts for row in part]
    text = "What commands give as JSON; [acceptance.md](../acceptance.md) judges it.\n\n"
    return rows, text + table(["command", "value", "measured"], rows)
