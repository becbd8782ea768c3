"""Checks that every room of the host declares in its own namespace: host/model/config in liana::config. Seconds, no compiler."""

import configparser
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = pathlib.Path(__file__).with_name("rooms.ini")
NOISE = re.compile(
    r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*"  # preprocessor
    r'|//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"' + r"|'(?:\\.|[^'\\\n])'",
    re.S | re.M,
)
NAMESPACE = re.compile(r"(?:inline\s+)?namespace\b\s*([\w:]*)$")
# What names something and declares nothing new: aliases of namespaces, using directives and declarations, assertions.
# What is extern "C" is C's, which knows no namespaces. A handler after the block of a function belongs to the function.
NAMING = re.compile(r"namespace\b|using\s+namespace\b|using\s+[\w:]+;|static_assert\b|extern\s*\{|catch\b|[;{]")
FORWARD = re.compile(r"(?:class|struct|enum(?:\s+class)?)\s+\w+(?:\s*:\s*[\w:]+)?;$")
MAIN = re.compile(r"int\s+main\s*\(")


def declarations(text):
    """(namespace, line, declaration) for what stands directly in a namespace; "" is the global one.

    An unnamed namespace and a block within another block declare nothing that others see.
    """
    text = NOISE.sub(lambda noise: re.sub(r"[^\n]", " ", noise[0]), text)
    scopes, start = [], 0  # a namespace's name, "" of an unnamed one, None of any other block
    for found in re.finditer(r"[{};]", text):
        head = text[start : found.start()].strip()
        opened = NAMESPACE.match(head) if found[0] == "{" else None
        if found[0] != "}" and all(scopes) and not opened and not NAMING.match(head + found[0]):
            line = text.count("\n", 0, found.start() - len(text[start : found.start()].lstrip())) + 1
            yield "::".join(scopes), line, head + found[0]
        if found[0] == "{":
            scopes.append(opened[1] if opened and None not in scopes else None)
        elif found[0] == "}" and scopes:
            scopes.pop()
        start = found.end()


def allowed_in(table, room):
    return table.get(room) or ["liana::" + room.split("/")[2]]


def is_allowed(space, declaration, allowed):
    """Its own namespace and those within; besides, declarations without definition of other rooms' types, and main."""
    if any(space == own or (own != "liana" and space.startswith(own + "::")) for own in allowed):
        return True
    return bool(FORWARD.match(declaration) if space else MAIN.match(declaration))


def problems(root, text):
    parser = configparser.ConfigParser(allow_no_value=True, delimiters=(":",), inline_comment_prefixes=("#",))
    parser.optionxform = str
    parser.read_string(text)
    table = {room: (words or "").split() for room, words in parser["namespaces"].items()}
    used = set()
    for path in sorted((root / "host").glob("*/*/**/*.[ch]pp")):
        file = path.relative_to(root).as_posix()
        room = "/".join(file.split("/")[:3])
        wrong = {}
        for space, line, declaration in declarations(path.read_text()):
            used.add((room, space))
            if not is_allowed(space, declaration, allowed_in(table, room)):
                wrong.setdefault(space, line)
        for space, line in wrong.items():
            where = space or "no namespace"
            yield f"{file}:{line}: declares in {where}; {room} declares in {' '.join(allowed_in(table, room))}"
    for room, spaces in table.items():
        if spaces == ["liana::" + room.split("/")[2]]:
            yield f"rooms.ini: [namespaces] {room}: needs no row for a namespace of its own name"
        for space in spaces:
            if (room, space) not in used:
                yield f"rooms.ini: [namespaces] {room}: {space}: nobody declares in it; take it out"


def main():
    found = list(problems(ROOT, TABLE.read_text()))
    print("\n".join(found) if found else "every room of the host declares in its own namespace")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
