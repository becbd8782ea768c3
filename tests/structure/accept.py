"""Makes docs/acceptance.md: each statement of the sources with their figure, ours, its tests, and whether it is met.

    ./dev accept [--json FILE]   runs the commands that give figures, then writes the page

Figures come from docs/measurements/figures.md and benchmarks.md alone; `./dev accept` replaces the section `acceptance`
of the first. Statuses are computed from values, limits and tags. --page writes the page without running a command;
--check compares it. Exit code 0: all is met, some of it with a deviation; 1: something is not met; 2: bad input.
"""

import argparse
import collections
import json
import pathlib
import re
import sys
import time

import requirements
from requirements import LIST, ROOT

sys.path[:0] = [str(ROOT / folder) for folder in ("docs", "tests", "tests/numbers")]
import acceptance
import check_figures
import tiers
from page import Page

PAGE, FIGURES = "docs/acceptance.md", "docs/measurements/figures.md"
MET, DEVIATES, NOT_MET = "met", "met with a deviation", "not met"
OPERATORS = {
    "<=": lambda value, limit, _: value <= limit,
    "<": lambda value, limit, _: value < limit,
    ">=": lambda value, limit, _: value >= limit,
    ">": lambda value, limit, _: value > limit,
    "=": lambda value, limit, tolerance: abs(value - limit) <= tolerance + 1e-9 * abs(limit),
}
LIMIT = re.compile(r"(<=|>=|<|>|=) (-?[\d.e-]+)(?: \+- ([\d.]+))?(?: (.+))?")
NUMBER = re.compile(r"-?\d{1,3}(?:,\d{3})+(?:\.\d+)?|-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
STATED_NUMBER = re.compile(r"(?<![\w^.-])\d")  # not the 5 of X5
EXPIRED_LINE = "Expired when this page was made: "
CONTEXT = "context, nothing to test"
ABOUT = f"""# Acceptance: what the sources ask for, and what Liana does

Made by `./dev accept`; do not edit by hand. Statements and limits are in `{LIST}`, in our own words.
Tests carry the ids as in `req:A43`. Kinds: T testable, S testable against a model that is chosen here, D context.

- **met**: each figure is within its limit, and a test shows the statement.
- **met with a deviation**: a figure is within a wider limit, or has expired, or a part differs. The list says why.
- **not met**: a figure is outside of its limits, or a figure or a test is missing.

A figure has expired if what it measures has changed since its commit. Its command measures it again.
Commands of `liana` need `--json`, or `--json FILE` for a run. Behind a command is the way to the value in its JSON.
Behind `./dev numbers` it is row and column in [figures.md](measurements/figures.md).
"""

Limit = collections.namedtuple("Limit", "operator value tolerance unit text")
Origin = collections.namedtuple("Origin", "command commit date section")


def limit_of(text):
    """ValueError for what is none."""
    match = LIMIT.fullmatch(text)
    if not match:
        raise ValueError(f"'{text}' is no limit; write one as '<= 216.4 s' or '= 142 +- 0.5 mm'")
    operator, value, tolerance, unit = match.groups()
    return Limit(operator, float(value), float(tolerance or 0), unit or "", text)


def holds(limit, value):
    return OPERATORS[limit.operator](value, limit.value, limit.tolerance)


# ---- figures of the measured pages ----


def tables_of(text):
    """All tables of Markdown: (head, rows) as lists of cells."""
    found, lines = [], [*text.splitlines(), ""]
    for i, line in enumerate(lines):
        if re.fullmatch(r"\|(?:\s*:?-+:?\s*\|)+", line) and i:
            end = next(k for k in range(i, len(lines)) if not lines[k].startswith("|"))
            head, *rows = ([cell.strip() for cell in each.strip().strip("|").split("|")] for each in lines[i - 1 : end])
            found.append((head, rows[1:]))
    return found


def number_in(cell, which):
    numbers = NUMBER.findall(cell)
    return float(numbers[which - 1].replace(",", "")) if len(numbers) >= which else None


def value_in(text, where):
    """The number at `median nominal; gentle > arm time s` or `row > column #2` of a section's tables, or of what
    `~a (pattern)` finds in it; None where there is none."""
    if where.startswith("~"):
        match = re.search(where[1:], text)
        return float(match[1]) if match else None
    functions, place, which = re.fullmatch(r"((?:(?:max|min|median|abs) )*)(.+?)(?: #(\d))?", where).groups()
    row, column = place.split(" > ")
    key = row.split("; ")
    for head, rows in tables_of(text):
        if column not in head:
            continue
        cells = [each[head.index(column)] for each in rows if all(k in ("*", c) for k, c in zip(key, each))]
        values = [value for value in (number_in(cell, int(which or 1)) for cell in cells) if value is not None]
        if values:
            return acceptance.reduced(functions, values)
    return None


def origin_of(name, text, command):
    head = text.strip().split("\n\n")[0] if name != "benchmarks" else text
    made = re.search(r"`(\./dev [^`]*)`", head)
    commit = re.search(r"commits? ([0-9a-f]{7,12}\+?)", head) or re.search(r", ([0-9a-f]{7,12})\b", text)
    date = re.search(r"\d{4}-\d\d-\d\d", head)
    by_liana = f"build/bin/{command}" if command.startswith("liana ") else ""
    return Origin(by_liana or (made and made[1]) or "", commit and commit[1], date and date[0], name)


def measured(figure, sections):
    """Value and origin of a figure; the value is None where nothing measured it."""
    name = "acceptance" if figure.source.startswith("liana ") else figure.source
    text = sections.get(name, "")
    origin = origin_of(name, text, figure.source)
    if name != "acceptance":
        return value_in(text, figure.where), origin
    cells = [row[2] for _, rows in tables_of(text) for row in rows if row[:2] == [figure.source, figure.where]]
    return (number_in(cells[0], 1) if cells else None), origin


# ---- statuses ----


def number_text(value, unit):
    return f"{value:.5g} {unit}".strip()


def asserted_figure(figure, own):
    """A figure that a test of the statement asserts; its value is the test's limit."""
    file = next((tag.file for tag in own if tag.test == figure.where), None)
    row = {"what": figure.what, "limit": figure.limit, "value": None, "unit": "", "section": "test", "expired": False}
    row["where"] = figure.where
    row.update(command=test_command(file) if file else "", commit=None, date=None)
    said = "" if file else f"no test {figure.where} for {figure.what}"
    return {**row, "status": NOT_MET if said else MET, "deviation": said}


def value_text(figure):
    """Value of a figure that was judged, in words."""
    if figure["section"] == "test":
        return "as its test asserts"
    if figure["value"] is None:
        return "-"
    return number_text(figure["value"], figure["unit"]) + (", expired" if figure["expired"] else "")


def judged_figure(figure, own, sections, expired):
    """A figure as JSON; `deviation` says what is not as the source has it. `own`: tags of its statement."""
    if figure.source == "test":
        return asserted_figure(figure, own)
    limit = limit_of(figure.limit)
    value, origin = measured(figure, sections)
    row = {"what": figure.what, "limit": figure.limit, "value": value, "unit": limit.unit, "where": figure.where}
    row.update(origin._asdict())
    row["expired"] = value is not None and origin.section in expired
    wider, _, why = figure.allowed.partition(": ")
    if value is None:
        return {**row, "status": NOT_MET, "deviation": f"no figure for {figure.what}"}
    if not holds(limit, value):
        within = bool(wider) and holds(limit_of(wider), value)
        said = f"{figure.what}: {number_text(value, limit.unit)}, not {figure.limit}" + (f": {why}" if within else "")
        return {**row, "status": DEVIATES if within else NOT_MET, "deviation": said}
    said = f"{figure.what}: expired" if row["expired"] else ""
    return {**row, "status": DEVIATES if said else MET, "deviation": said}


def test_command(file):
    """The command that runs a test's file."""
    if file.startswith("tests/page"):
        return "./dev test page"
    if not file.startswith("tests/"):
        return "./dev hil" if file.startswith("hil/") else "./dev test lua"
    folder = pathlib.PurePosixPath(file).parent
    known = tiers.folders()
    while str(folder.relative_to("tests")) not in known and folder.parent != pathlib.PurePosixPath("tests"):
        folder = folder.parent
    return f"./dev test {folder.relative_to('tests')}"


def status_of(is_missing, figures, deviations):
    if is_missing or any(figure["status"] == NOT_MET for figure in figures):
        return NOT_MET
    return DEVIATES if deviations or any(figure["status"] == DEVIATES for figure in figures) else MET


def entry_of(row, tags, sections, expired):
    """A statement as JSON."""
    own = [tag for tag in tags if tag.id == row.id]
    figures = [judged_figure(figure, own, sections, expired) for figure in row.figures]
    deviations = [*row.deviations, *(figure["deviation"] for figure in figures if figure["deviation"])]
    is_context = row.kind == "D"
    lacks = [] if is_context or own else ["no test"]
    if STATED_NUMBER.search(row.what) and not figures and not is_context:
        lacks.append("no figure")
    commands = [figure["command"] for figure in figures if figure["command"]] or [test_command(tag.file) for tag in own]
    ours = "; ".join(f"{figure['what']}: {value_text(figure)}" for figure in figures)
    return {
        "id": row.id,
        "kind": row.kind,
        "what": row.what,
        "source_figure": "; ".join(f"{figure.what} {figure.limit}" for figure in row.figures) or "none",
        "measured": ours or ("-" if lacks else CONTEXT if is_context else "shown by its tests"),
        "test": "; ".join(f"{file}{': ' if names else ''}{', '.join(names)}" for file, names in by_file(own).items()),
        "status": status_of(bool(lacks), figures, [*deviations, *[CONTEXT] * is_context]),
        "deviation": "; ".join([*lacks, *deviations, *[CONTEXT] * is_context]),
        "command": commands[0] if commands else "",
        "commit": figures[0]["commit"] if figures else None,
        "date": figures[0]["date"] if figures else None,
        "figures": figures,
        "source": row.source,
    }


def by_file(tags):
    """{file: names of its tests}."""
    files = collections.defaultdict(list)
    for tag in tags:
        files[tag.file] += [tag.test] if tag.test and tag.test not in files[tag.file] else []
    return files


# ---- page ----


def cell(text):
    return str(text).replace("|", "\\|")


def marked(status):
    return f"**{status}**" if status == NOT_MET else status


def links(entry, tags):
    files = by_file([tag for tag in tags if tag.id == entry["id"]])
    return "; ".join(
        f"[{pathlib.PurePosixPath(file).name}](../{file}) {', '.join(map(cell, names))}".rstrip()
        for file, names in files.items()
    )


def line(*cells):
    return "| " + " | ".join(cells) + " |\n"


def summary(entries):
    counts = collections.Counter(entry["status"] for entry in entries)
    context = sum(entry["kind"] == "D" for entry in entries)
    return (
        f"{len(entries)} statements: {counts[MET]} met, {counts[DEVIATES]} met with a deviation"
        f" ({context} of them context), {counts[NOT_MET]} not met"
    )


def page(entries, tags, expired):
    parts = [ABOUT, f"\n{summary(entries)}.\n\n{EXPIRED_LINE}{', '.join(sorted(expired)) or 'none'}.\n"]
    for status, head in ((NOT_MET, "Not met"), (DEVIATES, "Met with a deviation")):
        rows = [entry for entry in entries if entry["status"] == status and entry["kind"] != "D"]
        parts.append(f"\n## {head}\n" + ("" if rows else "None.\n"))
        parts += [f"- {entry['id']}: {entry['deviation']}.\n" for entry in rows]
    for source in dict.fromkeys(entry["source"] for entry in entries):
        own = [entry for entry in entries if entry["source"] == source]
        parts.append(f"\n## {source}\n")
        parts.append("| id | kind | what | status | tests |\n|---|---|---|---|---|\n")
        for entry in own:
            parts.append(
                line(entry["id"], entry["kind"], cell(entry["what"]), marked(entry["status"]), links(entry, tags))
            )
        parts.append(
            "\n| id | figure | limit | ours | status | command: where, date, commit |\n|---|---|---|---|---|---|\n"
        )
        for entry in own:
            parts += [figure_line(entry["id"], figure) for figure in entry["figures"]]
    return "".join(parts)


def figure_line(name, figure):
    ours = value_text(figure)
    made = ", ".join(filter(None, (f"`{figure['command']}`: `{figure['where']}`", figure["date"], figure["commit"])))
    return line(name, cell(figure["what"]), cell(figure["limit"]), ours, marked(figure["status"]), made)


# ---- the whole ----


def everything(expired=None):
    """Entries, tags and what is wrong with list or tags; `expired`: sections, looked up where it is None."""
    rows, problems = requirements.read_list((ROOT / LIST).read_text())
    tags, above_no_test = requirements.read_tags(ROOT)
    problems += above_no_test + requirements.unknown(rows, tags)
    sections = check_figures.sections()
    if expired is None:
        expired = check_figures.expired_of(sections)
    used = {"acceptance" if f.source.startswith("liana ") else f.source for row in rows for f in row.figures}
    expired = {name for name in expired if name in used}
    for row in rows:
        for figure in row.figures:
            try:
                limit_of(figure.limit)
                limit_of(figure.allowed.partition(": ")[0] or figure.limit)
            except ValueError as error:
                problems.append(f"{LIST}: {row.id}: {error}")
    entries = [] if problems else [entry_of(row, tags, sections, expired) for row in rows]
    return entries, tags, expired, problems


def expired_in(text):
    """What a page says had expired."""
    found = re.search(rf"^{EXPIRED_LINE}(.*)\.$", text, re.M)
    return set(found[1].split(", ")) - {"none"} if found else set()


def check():
    """The page is what list, tags and measured pages say; which figures had expired then is the page's own word."""
    text = (ROOT / PAGE).read_text() if (ROOT / PAGE).exists() else ""
    entries, tags, expired, problems = everything(expired_in(text))
    if not problems and page(entries, tags, expired) != text:
        problems = [f"{PAGE} is not what list, tests and figures say; run ./dev accept"]
    print("\n".join(problems) or f"{PAGE}: {summary(entries)}")
    return 1 if problems else 0


def commit_of_sources():
    """The newest commit that changed what the commands run; with + where the working tree differs."""
    paths = check_figures.SOURCES["acceptance"]
    commit = check_figures.git("log", "-1", "--format=%h", "--", *paths) or "no history"
    return commit + ("+" if check_figures.git("status", "--porcelain", "--", *paths) else "")


def run_commands():
    begun, measured_page = time.monotonic(), Page(ROOT / FIGURES)
    print("== accept: commands that give figures", file=sys.stderr, flush=True)
    _, text = acceptance.measure(ROOT / "build/bin")
    measured_page.put("acceptance", text, commit_of_sources(), time.monotonic() - begun)
    measured_page.write()


def main():
    parser = argparse.ArgumentParser(
        prog="./dev accept", description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--json", metavar="FILE", help="also write the statements there")
    parser.add_argument("--page", action="store_true", help="run no command; the figures are those of the last time")
    parser.add_argument(
        "--check", action="store_true", help="run no command and write nothing; 1 if the page is not current"
    )
    options = parser.parse_args()
    if options.check:
        return check()
    if options.json and not pathlib.Path(options.json).absolute().parent.is_dir():
        parser.error(f"--json: {options.json} cannot be written; give a file in a folder that exists")
    if not options.page:
        run_commands()
    entries, tags, expired, problems = everything()
    if problems:
        print("\n".join(problems), file=sys.stderr)
        return 1
    (ROOT / PAGE).write_text(page(entries, tags, expired))
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(entries, indent=1, ensure_ascii=False) + "\n")
    bad = [f"not met: {entry['id']}: {entry['deviation']}" for entry in entries if entry["status"] == NOT_MET]
    print("\n".join([*bad, f"{summary(entries)}; {PAGE} is written"]))
    return 1 if bad and not options.page else 0


if __name__ == "__main__":
    sys.exit(main())
