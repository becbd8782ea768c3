"""What the sources ask for and the tests that show it: reads requirements.txt, and the tags of tests, as in req:A43.

A tag stands in the comment directly above a test or a class of tests, in the comment at the head of a file, for the
file as a whole, or in what a scenario is `about`. accept.py makes the acceptance page of both.
"""

import collections
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = "tests/structure/requirements.txt"
FOLDERS = ("tests", "lua", "hil")
SUFFIXES = {".cpp", ".hpp", ".py", ".lua", ".ts", ".mjs", ".json"}
NO_TESTS = {"node_modules", "requirements.py", "requirements_test.py", "accept.py"}
KINDS = ("T", "S", "D")
TAG = re.compile(r"\breq:(\w*)")
TEST = re.compile(
    r"\s*(?:TEST(?:_F|_P)?\(\s*(?P<suite>\w+),\s*(?P<case>\w+)\)"
    r"|(?:class|def(?= test_)) (?P<python>\w+)"
    r"|test\((?P<quote>['\"`])(?P<script>(?:\\.|.)*?)(?P=quote))"
)
# A figure: what it is, its limit, where it stands (a section of figures.md or a command), which value it is there, and
# a wider limit with its reason, or "".
Figure = collections.namedtuple("Figure", "what limit source where allowed", defaults=[""])
Requirement = collections.namedtuple("Requirement", "id kind what source figures deviations")
Tag = collections.namedtuple("Tag", "id file test")  # test is "" for a file as a whole


def joined(text):
    """Lines with their numbers; those that begin with " | " go on with the line before."""
    lines = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("| ") and lines:
            lines[-1] = (lines[-1][0], f"{lines[-1][1]} {line.strip()}")
        elif line.strip() and (line.startswith("## ") or not line.startswith("#")):
            lines.append((number, line))
    return lines


def figure_in(text, commands):
    """Of the text behind `=`; ValueError where it is none."""
    parts = [part.strip() for part in text.split(" | ")]
    if len(parts) not in (4, 5):
        raise ValueError(f"a figure has 4 or 5 parts with ' | ' between them, not {len(parts)}")
    if parts[2].startswith("@") and parts[2] not in commands:
        raise ValueError(f"{parts[2]} stands for no command; define it at the head")
    parts[2] = commands.get(parts[2], parts[2])
    return Figure(*parts)


def read_list(text):
    """The requirements in their order, and what is wrong with the list."""
    rows, problems, source, commands = [], [], "", {}
    for number, line in joined(text):
        mark, *rest = line.split(None, 1)
        fields = line.split(None, 2)
        if mark == "##":
            source = rest[0]
        elif mark.startswith("@"):
            commands[mark] = " ".join(rest)
        elif mark in ("=", "~") and not rows:
            problems.append(f"{LIST}:{number}: stands below no requirement")
        elif mark == "~":
            rows[-1].deviations.append(" ".join(rest))
        elif mark == "=":
            try:
                rows[-1].figures.append(figure_in(" ".join(rest), commands))
            except ValueError as error:
                problems.append(f"{LIST}:{number}: {error}")
        elif len(fields) < 3 or fields[1] not in KINDS:
            problems.append(f"{LIST}:{number}: must be an id, one of {' '.join(KINDS)}, and what is asked for")
        elif fields[0] in [row.id for row in rows]:
            problems.append(f"{LIST}:{number}: {fields[0]} is there twice; leave one")
        else:
            rows.append(Requirement(*fields, source, [], []))
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
