"""Finds types of one full name in several files: two in one program break it without a word of the compiler."""

import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PRODUCT = ("firmware_like", "host", "hil")
# To be emptied: each is renamed, or gets the namespace of its room.
KNOWN = {
    "liana::AnnouncedStep",
    "liana::ArmPoint",
    "liana::Range",
    "liana::Refusal",
    "liana::WatchdogLimits",
}
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"' + r"|'(?:\\.|[^'\\\n])'", re.S)
SCOPE = re.compile(
    r"\bnamespace\s*([\w:]*)\s*\{"
    r"|\b(?:struct|class|union|enum(?:\s+(?:class|struct))?)\s+(?:alignas\([^)]*\)\s*)?"
    r"([\w:]+)\s*(?:final\s*)?(?::[^;{()]*)?\{"
    r"|\{|\}"
)


def types_of(text):
    """Full names of the types that a source defines at namespace level; those of unnamed namespaces are its own."""
    scopes = []  # the name of a namespace, "" of an unnamed one, None of any other block
    for found in SCOPE.finditer(NOISE.sub(" ", text)):
        if found[0] == "}":
            if scopes:
                scopes.pop()
            continue
        if found[2] and all(scopes):
            yield "::".join([*scopes, found[2]])
        scopes.append(found[1] if found[0].startswith("namespace") else None)


def definitions(root):
    files = collections.defaultdict(list)
    for path in sorted(path for top in PRODUCT for path in (root / top).rglob("*.[ch]pp")):
        for name in set(types_of(path.read_text())):
            files[name].append(path.relative_to(root).as_posix())
    return files


def problems(root, known):
    found = {name: files for name, files in definitions(root).items() if len(files) > 1}
    for name, files in sorted(found.items()):
        if name not in known:
            others = " ".join(files[1:])
            yield f"{files[0]}: {name} is also defined in {others}; rename one, or give it its room's namespace"
    yield from (
        f"check_type_names.py: {name} is defined once now; take it out of KNOWN" for name in sorted(known - set(found))
    )


def main():
    found = list(problems(ROOT, KNOWN))
    print("\n".join(found) if found else "every type has a name of its own, but those in KNOWN of check_type_names.py")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
