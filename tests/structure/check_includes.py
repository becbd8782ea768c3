"""Checks rooms.ini: which room includes which, who knows which library, who reads a clock. Seconds, no compiler.

A room is a folder with a row, and the folders below it that have none. Within a room no folders go in a circle.

What people touch and what manages information are rooms apart (req:A14).
"""

import configparser
import pathlib
import posixpath
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = pathlib.Path(__file__).with_name("rooms.ini")
# Every folder below these is part of a room; other rows (of tests) are checked as well.
PRODUCT = ("firmware_like", "host", "hil")
INCLUDE = re.compile(r'\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')
CLOCK = re.compile(
    r"\b(steady_clock|steady_s|steady_us|system_clock|high_resolution_clock|utc_clock|clock_gettime|clock_nanosleep"
    r"|timespec_get|gettimeofday|timerfd_create|__rdtsc|std::time|std::clock)\b"
)


class Table:
    """rooms.ini: each section as {name: list of words}."""

    def __init__(self, text):
        parser = configparser.ConfigParser(allow_no_value=True, delimiters=(":",), inline_comment_prefixes=("#",))
        parser.optionxform = str
        parser.read_string(text)
        sections = {
            name: {key: (words or "").split() for key, words in parser[name].items()} for name in parser.sections()
        }
        self.rooms = sections["includes"]
        self.against = sections["against the order"]
        self.libraries = sections["libraries"]
        self.clocks = sections["clocks"]
        self.used = set()

    def room_of(self, path):
        """The room of a file: the nearest folder that has a row, or None."""
        folders = (str(folder) for folder in pathlib.PurePosixPath(path).parents)
        return next((folder for folder in folders if folder in self.rooms), None)

    def rows(self):
        """Every (section, name, word) that allows something."""
        for section, rows in [
            ("includes", self.rooms),
            ("against the order", self.against),
            ("libraries", self.libraries),
        ]:
            for name, words in rows.items():
                yield from ((section, name, word) for word in words)
        yield from (("clocks", name, "") for name in self.clocks)

    def use(self, *row):
        self.used.add(row)
        return True

    def allows(self, file, room, target):
        """Whether this file of this room may include the file `target` of another room."""
        if target in self.against.get(file, []):
            return self.use("against the order", file, target)
        there = self.room_of(target)
        return any(
            there is not None and (there + "/").startswith(word + "/") and self.use("includes", room, word)
            for word in self.rooms[room]
        )

    def knows(self, file, room, library):
        """Whether this file or its room may include headers of the library."""
        for word in self.libraries[library]:
            if (file + "/").startswith(word + "/"):
                return self.use("libraries", library, word)
        return False

    def reads_clock(self, file):
        """Whether this file or its room may read a clock."""
        return any((file + "/").startswith(name + "/") and self.use("clocks", name, "") for name in self.clocks)


def file_of(target, file, root):
    """What an include in quotes means, from the root: beside the file that includes it, or below the root."""
    beside = posixpath.normpath(posixpath.join(posixpath.dirname(file), target))
    return beside if (root / beside).exists() else target


def wrong_include(table, file, quoted, angled, root):
    """What is wrong with one include, or None."""
    room = table.room_of(file)
    target = angled or file_of(quoted, file, root)
    for library in table.libraries:
        if target.startswith(library) and not table.knows(file, room, library):
            included = f"<{angled}>" if angled else f'"{quoted}"'
            return f"{included}: allowed in {' '.join(table.libraries[library]) or 'no folder'}"
    if angled:
        return None
    if table.room_of(target) == room or table.allows(file, room, target):
        return None
    return f'"{quoted}": {room} may include {" ".join([room, *table.rooms[room]])}'


def wrong_lines(table, file, text, root):
    """(line number, what is wrong) of one file."""
    for number, line in enumerate(text.splitlines(), 1):
        found = INCLUDE.match(line)
        if found:
            wrong = wrong_include(table, file, found[1], found[2], root)
            if wrong:
                yield number, f"includes {wrong}"
        clock = CLOCK.search(line.split("//")[0])
        if clock and not table.reads_clock(file):
            yield number, f"reads a clock ({clock[1]}): allowed only where [clocks] of rooms.ini says"


def wrong_order(table):
    """Rows that name a room which does not stand above them: without these nothing goes in a circle."""
    above = set()
    for room, allowed in table.rooms.items():
        for other in allowed:
            if not any((name + "/").startswith(other + "/") for name in above):
                yield f"{room} may include {other}, which does not stand above it"
        above.add(room)


def folder_arrows(table, files, root):
    """{folder: folders of the same room that its files include}, but for what is excepted."""
    arrows = {}
    for file, content in files:
        folder = posixpath.dirname(file)
        quoted = (found[1] for found in map(INCLUDE.match, content.splitlines()) if found and found[1])
        for target in (file_of(name, file, root) for name in quoted):
            there = posixpath.dirname(target)
            if there == folder or table.room_of(target) != table.room_of(file):
                continue
            if target in table.against.get(file, []):
                table.use("against the order", file, target)
            else:
                arrows.setdefault(folder, set()).add(there)
    return arrows


def circles(arrows):
    """Folders from which includes lead back to themselves."""
    for start in sorted(arrows):
        seen, ahead = set(), set(arrows[start])
        while ahead:
            folder = ahead.pop()
            seen.add(folder)
            ahead |= arrows.get(folder, set()) - seen
        if start in seen:
            yield f"{start}: its includes lead back to it, within its room"


def sources(root, table):
    tops = {*PRODUCT, *(room.split("/")[0] for room in table.rooms)}
    for path in sorted(path for top in tops for path in (root / top).rglob("*.[ch]pp")):
        file = path.relative_to(root).as_posix()
        if file.startswith(tuple(top + "/" for top in PRODUCT)) or table.room_of(file):
            yield file, path.read_text()


def problems(root, text):
    """Sentences, one for each thing that is not as the table says."""
    table = Table(text)
    yield from (f"rooms.ini: [includes] {wrong}" for wrong in wrong_order(table))
    missing, files = set(), list(sources(root, table))
    for file, content in files:
        if table.room_of(file):
            yield from (f"{file}:{number}: {wrong}" for number, wrong in wrong_lines(table, file, content, root))
        else:
            missing.add(posixpath.dirname(file))
    yield from (f"rooms.ini: [includes] has no row for {room}" for room in sorted(missing))
    yield from circles(folder_arrows(table, files, root))
    for section, name, word in table.rows():
        if (section, name, word) not in table.used:
            yield f"rooms.ini: [{section}] {name}{': ' * bool(word)}{word}: nobody does it; take it out"


def main():
    found = list(problems(ROOT, TABLE.read_text()))
    print("\n".join(found) if found else "includes, libraries and clocks are as tests/structure/rooms.ini says")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
