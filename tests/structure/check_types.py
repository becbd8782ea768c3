#!/usr/bin/env python3
"""Names every class, struct and enum that core and host define twice under one fully qualified name; ends with 1 when there is one."""
import argparse
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("firmware_like", "host")

TOKEN = re.compile(
    r"\bnamespace\b(?P<namespace>[\w\s:]*)\{"
    r"|(?<![<,]\s)(?<![<,])\b(?P<kind>class|struct|union|enum\s+class|enum\s+struct|enum)\s+(?P<type>[A-Za-z_]\w*(?:::\w+)*)"
    r"\s*(?:final\b)?\s*(?::(?!:)[^;{}()]*)?\{"
    r"|(?P<open>\{)|(?P<close>\})"
)


def bare(text):
    """The code without comments, strings and preprocessor lines."""
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', " ", text, flags=re.S)
    return re.sub(r"^\s*#(?:[^\n\\]|\\.|\\\n)*", "", text, flags=re.M)


def types_in(text):
    """Fully qualified names of the types defined in a file; what only this file sees is left out."""
    scopes = []  # one per open brace: a name, or None for what hides names (functions, unnamed namespaces)
    for token in TOKEN.finditer(bare(text)):
        if token["close"]:
            if scopes:
                scopes.pop()
        elif token["open"]:
            scopes.append(None)
        elif token["kind"]:
            if None not in scopes:
                yield "::".join([*scopes, token["type"]])
            scopes.append(token["type"])
        else:
            scopes.append("".join(token["namespace"].split()) or None)


def defined_twice(root):
    """Name -> files, for every name defined more than once."""
    found = collections.defaultdict(list)
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.?pp")):
            for name in types_in(path.read_text()):
                found[name].append(path.relative_to(root).as_posix())
    return {name: files for name, files in found.items() if len(files) > 1}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help="the tree to look at")
    twice = defined_twice(parser.parse_args().root)
    for name, files in sorted(twice.items()):
        print(f"{name} is defined in {' and '.join(files)}: give one of them a name of its own")
    return 1 if twice else 0


if __name__ == "__main__":
    sys.exit(main())
