#!/usr/bin/env python3
"""Writes the tables of docs/reference/mission-language.md from lua/liana: the fields of a step, the conditions, the
actions.

`--check` writes nothing and fails where page and library differ, or where something of the library is without words.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIBRARY = ROOT / "lua" / "liana"
PAGE = ROOT / "docs" / "reference" / "mission-language.md"
BEGIN, END = "<!-- made by docs/mission_page.py -->", "<!-- end of what is made -->"


def field_rules():
    """Name and what is allowed of every field that lua/liana/check.lua knows."""
    text = (LIBRARY / "check.lua").read_text()
    block = text[text.index("local kStep = {") : text.index("\n}\n", text.index("local kStep = {"))]
    return [name for name in re.findall(r"^  (\w+) = ", block, re.M) if name not in ("at", "name")]


def field_rows():
    text = (LIBRARY / "step_fields.lua").read_text()
    rows = [(name, words.replace('\\"', '"')) for name, words in re.findall(r'^  \{ "(\w+)", "(.*)" \},$', text, re.M)]
    known, told = set(field_rules()), {name for name, _ in rows}
    if known != told:
        sys.exit(f"lua/liana/step_fields.lua: fields {sorted(known ^ told)}: allowed those of kStep in check.lua")
    return rows


def functions_of(module):
    """Call and comment of every function that the module offers, in the order in which they are written."""
    found = []
    comment = []
    for line in (LIBRARY / f"{module}.lua").read_text().splitlines():
        call = re.match(rf"function {module}\.(\w+\([^)]*\))", line)
        if call:
            if not comment:
                sys.exit(f"lua/liana/{module}.lua: {call.group(1)}: allowed a comment above it: say what it does")
            found.append((call.group(1), " ".join(comment)))
        comment = comment + [line[3:]] if line.startswith("-- ") else []
    return found


def table(head, rows):
    return "\n".join([f"| {head[0]} | {head[1]} |", "|---|---|", *(f"| `{name}` | {words} |" for name, words in rows)])


def reference():
    parts = [
        "## Fields of a step",
        table(("field", "meaning"), field_rows()),
        "## Conditions",
        table(("call", "met when"), functions_of("conditions")),
        "## Actions",
        table(("call", "what it does"), functions_of("actions")),
    ]
    return "\n\n".join(parts)


def main():
    text = PAGE.read_text()
    before, after = text[: text.index(BEGIN) + len(BEGIN)], text[text.index(END) :]
    made = f"{before}\n{reference()}\n\n{after}"
    if "--check" not in sys.argv[1:]:
        PAGE.write_text(made)
    elif made != text:
        sys.exit(
            "docs/reference/mission-language.md: differs from lua/liana: write it anew with python3 docs/mission_page.py"
        )


if __name__ == "__main__":
    main()
