"""Fuzz targets, ten million executions in one run each, as many targets at a time as there are cores: all of them, or
some, whose rows replace those on the page."""
import datetime
import os
import sys

import folders  # makes what is in tests/fuzz importable
import targets
from page import Page, commit_of, table

EXECUTIONS = 10_000_000
HEAD = ["target", "bytes at most", "executions", "s", "executions/s", "again", "crashes", "measured"]
HOW = (
    "The build is hardened as the installed programs, with the standard library's assertions. An input has at most as many"
    " bytes as the table says, and no input of the corpus (tests/fuzz/corpus) is cut. Afterwards every input that reached"
    ' something new runs once more, with AddressSanitizer and UndefinedBehaviorSanitizer; column "again" counts these'
    ' inputs. Older rows differ there. "yes": they ran and were not counted. "all of it": the run itself had the'
    ' sanitizers. "-": none ran again.'
)


def row(result, when):
    return [
        result["name"],
        result["bytes"],
        result["executions"],
        f"{result['seconds']:.0f}",
        f"{result['executions'] / max(result['seconds'], 1e-3):.0f}",
        result.get("again", "-"),
        result["found"] or "none",
        when,
    ]


def rows_of(section):
    """Of the table in that section, by target."""
    lines = [line.strip("| ").split(" | ") for line in section.splitlines() if line.startswith("| ")]
    return {cells[0]: cells for cells in lines if len(cells) == len(HEAD) and cells[0] in targets.targets()}


def text_of(results, before):
    """The section: rows of `results`, and those that the section `before` had of other targets."""
    today = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")
    when = f"{today}, {commit_of(folders.ROOT)}"
    rows = rows_of(before) | {result["name"]: row(result, when) for result in results}
    return HOW + "\n\n" + table(HEAD, [rows[name] for name in sorted(rows)])


def measure(_binaries, only=()):
    results = []
    chosen = only or targets.targets()
    for result in targets.run_all(chosen, os.cpu_count(), lambda name: targets.run_many(name, EXECUTIONS)):
        print(targets.line(result), file=sys.stderr, flush=True)
        results.append(result)
    before = Page(folders.ROOT / "docs/measurements/figures.md").sections.get("fuzz", "")
    return {result["name"]: result for result in results}, text_of(results, before)
