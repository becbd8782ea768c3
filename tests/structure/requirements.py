"""What the sources ask for and the tests that show it: reads requirements.txt and the tags, as in req:A43, of all tests.

A tag stands in the comment directly above a test or a class of tests, in the comment at the head of a file, for the file as
a whole, or in what a scenario is `about`. Writes docs/development/requirements.md; --check compares with it, --missing
lists what is testable and has no test.
"""

import argparse
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST, PAGE = "tests/structure/requirements.txt", "docs/development/requirements.md"
FOLDERS = ("tests", "lua", "hil")
SUFFIXES = {".cpp", ".hpp", ".py", ".lua", ".ts", ".mjs", ".json"}
NO_TESTS = {"node_modules", "requirements.py", "requirements_test.py"}
KINDS = ("T", "S", "D")
TAG = re.compile(r"\breq:(\w*)")
TEST = re.compile(
    r"\s*(?:TEST(?:_F|_P)?\(\s*(?P<suite>\w+),\s*(?P<case>\w+)\)"
    r"|(?:class|def(?= test_)) (?P<python>\w+)"
    r"|test\((?P<quote>['\"`])(?P<script>(?:\\.|.)*?)(?P=quote))"
)
ABOUT = """# Requirements and their tests

Made by `./dev docs` from `tests/structure/requirements.txt`, which says what the three sources ask for in our own words, and from
the tags of the tests, as in `req:A43`. A tag stands directly above a test that shows the statement or a part of it, or at the head
of a file that does so as a whole. Kinds: T testable, S testable against a model that is chosen here, D context.
"""

Requirement = collections.namedtuple("Requirement", "id kind what source")
Tag = collections.namedtuple("Tag", "id file test")  # test is "" for a file as a whole


def read_list(text):
    """The requirements in their order, and what is wrong with the list."""
    rows, problems, source = [], [], ""
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("## "):
            source = line[3:]
        if not line.strip() or line.startswith("#"):
            continue
        fields = line.split(None, 2)
        if len(fields) < 3 or fields[1] not in KINDS:
            problems.append(f"{LIST}:{number}: must be an id, one of {' '.join(KINDS)}, and what is asked for")
        elif fields[0] in [row.id for row in rows]:
            problems.append(f"{LIST}:{number}: {fields[0]} is there twice; leave one")
        else:
            rows.append(Requirement(*fields, source))
    return rows, problems


def is_comment(line):
    return not line.strip() or line.lstrip().startswith(("//", "# ", "#!", "--", "@"))


def lines_of_head(lines):
    """How many lines the comment or the docstring has that a file begins with."""
    if lines[0].startswith('"""'):
        return next((i + 1 for i, line in enumerate(lines) if line.count('"""') > (i == 0)), 0)
    return next((i for i, line in enumerate(lines) if not is_comment(line)), len(lines))


def tested_by(lines, at):
    """The test that the tag of a line belongs to: its name, "" for the whole file, None for none."""
    below = at
    while below < len(lines) and lines[below].strip() and is_comment(lines[below]):
        below += 1
    found = TEST.match(" ".join(lines[below : below + 2]))
    if found and below > at:
        script = re.sub(r"\\(.)", r"\1", found["script"] or "")
        return script or found["python"] or f"{found['suite']}.{found['case']}"
    return "" if at < lines_of_head(lines) else None


def read_tags(root):
    """All tags, and those that stand above no test."""
    tags, problems = [], []
    for path in sorted(path for folder in FOLDERS for path in (root / folder).rglob("*") if path.suffix in SUFFIXES):
        if NO_TESTS & set(path.parts):
            continue
        file, lines = path.relative_to(root).as_posix(), path.read_text(errors="replace").splitlines()
        for at, line in enumerate(lines):
            for name in TAG.findall(line):
                test = "" if path.suffix == ".json" else tested_by(lines, at)
                if test is None:
                    problems.append(f"{file}:{at + 1}: req:{name} stands above no test; put it directly above one")
                else:
                    tags.append(Tag(name, file, test))
    return tags, problems


def unknown(rows, tags):
    known = {row.id for row in rows}
    return [f"{tag.file}: req:{tag.id}: no such id in {LIST}" for tag in tags if tag.id not in known]


def missing(rows, tags):
    return [row for row in rows if row.kind != "D" and row.id not in {tag.id for tag in tags}]


def tests_of(row, tags):
    """Markdown: each file with a link and the names of its tests."""
    files = collections.defaultdict(list)
    for tag in tags:
        if tag.id == row.id:
            files[tag.file].append(tag.test.replace("|", "\\|"))
    return "; ".join(
        f"[{pathlib.PurePosixPath(file).name}](../../{file}) {', '.join(name for name in names if name)}".rstrip()
        for file, names in files.items()
    )


def page(rows, tags):
    parts = [ABOUT]
    for source in dict.fromkeys(row.source for row in rows):
        own = [row for row in rows if row.source == source]
        without = missing(own, tags)
        testable = sum(row.kind != "D" for row in own)
        parts.append(f"\n## {source}\n{testable - len(without)} of {testable} testable statements have a test.\n")
        if without:
            parts.append("\nWithout a test:\n" + "".join(f"- {row.id}: {row.what}\n" for row in without))
        parts.append("\n| id | kind | what | tests |\n|---|---|---|---|\n")
        parts += [f"| {row.id} | {row.kind} | {row.what} | {tests_of(row, tags)} |\n" for row in own]
    return "".join(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help=f"write nothing; 1 if {PAGE} is not what it has to be")
    parser.add_argument("--missing", action="store_true", help="write nothing; list what is testable and has no test")
    options = parser.parse_args()
    rows, problems = read_list((ROOT / LIST).read_text())
    tags, above_no_test = read_tags(ROOT)
    problems += above_no_test + unknown(rows, tags)
    if options.missing and not problems:
        print("\n".join(f"{row.id} {row.kind} {row.what}" for row in missing(rows, tags)))
        return 0
    made, file = page(rows, tags), ROOT / PAGE
    if not problems and options.check and (not file.exists() or file.read_text() != made):
        problems.append(f"{PAGE} is not what tests and list say; run ./dev docs")
    if not problems and not options.check:
        file.write_text(made)
    print(
        "\n".join(problems) if problems else f"{len(tags)} tags, {len(missing(rows, tags))} requirements without a test"
    )
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
