"""Small bugs that rules make in C++ sources, each behind a switch of its own, so that one build holds them all.

The rules are those that reviews and planted bugs have shown to matter here: a comparison that takes or leaves its bound,
a first or last index left out, a condition, statement, fabs, clamp or sign dropped, a number or limit of another size.
"""
import dataclasses
import os
import pathlib
import re
import sys

try:
    import clang.cindex as cindex
except ImportError:  # Debian's, when another Python than Debian's runs
    sys.path.append("/usr/lib/python3/dist-packages")
    import clang.cindex as cindex

LIBRARY = "libclang-14.so.1"
SWITCH = "LIANA_MUTANT"  # environment: number of the one that is on; none: 0
REACHED = "LIANA_MUTANTS_REACHED"  # environment: file that gets a byte for each number, 1 where the program came by
SWITCHES = """\
#pragma once
#ifdef __cplusplus
extern "C" char* getenv(const char*) noexcept;
extern "C" int atoi(const char*) noexcept;
extern "C" int open(const char*, int, ...);
extern "C" long write(int, const void*, unsigned long);
extern "C" int close(int);
inline unsigned char liana_mutants_reached[%(count)d + 1];
struct LianaMutant {
  int on = 0;
  LianaMutant() { if (const char* number = getenv("%(switch)s")) on = atoi(number); }
  ~LianaMutant() {
    const char* path = getenv("%(reached)s");
    const int file = path != nullptr ? open(path, 0101, 0644) : -1;
    if (file >= 0 && write(file, liana_mutants_reached, sizeof liana_mutants_reached) > 0) close(file);
  }
};
inline LianaMutant liana_mutant;
inline bool liana_mutant_asked(int number) noexcept {
  liana_mutants_reached[number] = 1;
  return liana_mutant.on == number;
}
constexpr bool lm(int number) noexcept { return !__builtin_is_constant_evaluated() && liana_mutant_asked(number); }
#endif
"""


def header(count):
    """What every source includes first: the switches of so many."""
    return SWITCHES % {"count": count, "switch": SWITCH, "reached": REACHED}


Kind, Type = cindex.CursorKind, cindex.TypeKind
FUNCTIONS = {Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.DESTRUCTOR, Kind.FUNCTION_TEMPLATE}
FUNCTIONS.add(Kind.LAMBDA_EXPR)
LOOPS = {Kind.WHILE_STMT, Kind.FOR_STMT, Kind.CXX_FOR_RANGE_STMT}
OTHER_COMPARISON = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
LIMIT = re.compile(r"(\w+::)*k[A-Z]\w*")
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)


@dataclasses.dataclass
class Mutant:
    """`places`: offsets of what it replaces, in the sources that have it; a limit has many. `becomes` is empty for a
    statement that is dropped."""

    kind: str
    file: str
    line: int
    was: str
    becomes: str
    places: list = dataclasses.field(default_factory=list)

    def __str__(self):
        return f"{self.file}:{self.line}: {self.kind}: {self.was} -> {self.becomes or 'nothing'}"


def children(cursor):
    return list(cursor.get_children())


def span(cursor):
    return cursor.extent.start.offset, cursor.extent.end.offset


def is_float(of):
    return of.get_canonical().kind in (Type.FLOAT, Type.DOUBLE, Type.LONGDOUBLE)


def is_whole(of):
    return Type.BOOL.value <= of.get_canonical().kind.value <= Type.INT128.value


def is_truth(of):
    return of.get_canonical().kind == Type.BOOL


class Source:
    """One file: walks its functions and finds what may be wrong in them."""

    def __init__(self, root, name, limits):
        self.root, self.name, self.limits = pathlib.Path(root), name, limits
        self.data = (self.root / name).read_bytes()
        self.mutants = {}  # by place and text

    def text(self, start, end):
        return " ".join(COMMENT.sub("", self.data[start:end].decode()).split())

    def of(self, cursor):
        return self.text(*span(cursor))

    def line(self, offset):
        return self.data.count(b"\n", 0, offset) + 1

    def add(self, cursor, kind, becomes):
        start, end = span(cursor)
        mutant = Mutant(kind, self.name, self.line(start), self.text(start, end), becomes, [(self.name, start, end)])
        self.mutants.setdefault((start, end, becomes), mutant)

    def add_limit(self, cursor):
        """The same wrong size wherever the limit is used."""
        limit = cursor.referenced
        for change in ("+ 1", "- 1") if is_whole(limit.type) else ("* 1.1", "/ 1.1"):
            key, was = (limit.get_usr(), change), self.of(cursor)
            if key not in self.limits:
                becomes = f"{was} {change}"
                self.limits[key] = Mutant("size of a limit", self.name, self.line(span(cursor)[0]), was, becomes)
            place = (self.name, *span(cursor))
            if place not in self.limits[key].places:
                self.limits[key].places.append(place)

    # --- the walk ---

    def read(self, index, arguments):
        path = str(self.root / self.name)
        unit = index.parse(path, args=arguments)
        wrong = [found for found in unit.diagnostics if found.severity >= cindex.Diagnostic.Error]
        if wrong:
            raise ValueError(f"{self.name}: {wrong[0].spelling}")
        self.walk(unit.cursor, path, [])
        return list(self.mutants.values())

    def walk(self, cursor, path, above):
        for child in children(cursor):
            begins = child.extent.start.file
            if begins is not None and begins.name == path:
                self.visit(child, path, [*above, cursor])

    def visit(self, cursor, path, above):
        if cursor.kind in (Kind.STATIC_ASSERT, Kind.ENUM_DECL) or self.is_constant(cursor):
            return
        if any(each.kind in FUNCTIONS for each in above) and span(cursor)[1] > span(cursor)[0]:
            self.mutate(cursor, above)
        if self.is_label(cursor):
            for child in children(cursor)[1:]:
                self.visit(child, path, [*above, cursor])
        else:
            self.walk(cursor, path, above)

    def is_constant(self, cursor):
        if cursor.kind != Kind.VAR_DECL:
            return False
        head = self.data[slice(*span(cursor))].decode().split("=")[0].split("{")[0]
        return "constexpr" in head

    def is_label(self, cursor):
        """Of which the first part has to be constant."""
        start = span(cursor)[0]
        is_constexpr = self.data[start : start + 14].replace(b" ", b"").startswith(b"ifconstexpr")
        return cursor.kind == Kind.CASE_STMT or (cursor.kind == Kind.IF_STMT and is_constexpr)

    # --- the rules ---

    def mutate(self, cursor, above):
        rule = RULES.get(cursor.kind)
        if rule is not None:
            rule(self, cursor, above[-1])
        if cursor.kind in STATEMENTS and is_statement(cursor, above[-1]):
            self.add(cursor, "dropped statement", "")

    def binary(self, cursor, parent):
        left, right = children(cursor)
        between = self.data[span(left)[1] : span(right)[0]].decode()
        sign, a, b = COMMENT.sub("", between).strip(" \n\t()"), self.of(left), self.of(right)
        if sign in OTHER_COMPARISON:
            self.add(cursor, "comparison", f"{a} {OTHER_COMPARISON[sign]} {b}")
            if parent.kind == Kind.FOR_STMT and sign in ("<", "!="):
                self.add(cursor, "last index", f"({a}) + 1 {sign} {b}")
        elif sign in ("&&", "||"):
            self.add(cursor, "dropped condition", f"bool({a})")
            self.add(cursor, "dropped condition", f"bool({b})")
        elif sign in ("+", "-") and (is_float(cursor.type) or is_whole(cursor.type)):
            self.add(cursor, "sign", f"{a} {'-' if sign == '+' else '+'} ({b})")

    def unary(self, cursor, parent):
        text, inside = self.of(cursor), self.of(children(cursor)[0])
        if is_statement(cursor, parent):
            return
        if text.startswith("!"):
            self.add(cursor, "dropped condition", f"bool({inside})")
        elif text.startswith("-") and not text.startswith("--"):
            self.add(cursor, "sign", inside)

    def whole_number(self, cursor, _):
        text = self.of(cursor)
        if re.fullmatch(r"\d+[uUlL]*", text) and is_whole(cursor.type):
            self.add(cursor, "off by one", f"{text} + 1")

    def number(self, cursor, _):
        text = self.of(cursor)
        if float(text.rstrip("fF").replace("'", "")) != 0.0:
            self.add(cursor, "size of a limit", f"{text} * 1.1")

    def call(self, cursor, _):
        text, arguments = self.of(cursor), list(cursor.get_arguments())
        name = cursor.spelling
        if name in ("fabs", "abs") and len(arguments) == 1 and re.match(r"(std::)?f?abs\(", text):
            self.add(cursor, "fabs", self.of(arguments[0]))
        elif name in ("min", "max", "clamp") and re.match(rf"(std::)?{name}\(", text):
            for argument in arguments[:1] if name == "clamp" else arguments[:2]:
                self.add(cursor, "dropped bound", self.of(argument))
        elif name == "operator[]" and text.endswith("]"):
            self.index(cursor, arguments[-1])
        elif name == "as_index" and not re.fullmatch(r"as_index\(\d+\)", text):
            self.add(cursor, "index", "std::size_t{0}")

    def subscript(self, cursor, _):
        self.index(cursor, children(cursor)[1])

    def index(self, cursor, place):
        inside = span(place)[0] > span(cursor)[0] and span(place)[1] > span(place)[0]
        if inside and is_whole(place.type) and not re.fullmatch(r"\d+", self.of(place)):
            self.add(place, "index", "0")

    def branch(self, cursor, _):
        condition = children(cursor)[0]
        if condition.kind not in (Kind.VAR_DECL, Kind.DECL_STMT) and not self.is_label(cursor):
            self.add(condition, "dropped condition", "true")
            self.add(condition, "dropped condition", "false")

    def result(self, cursor, _):
        given = children(cursor)
        if given and is_truth(given[0].type):
            self.add(given[0], "dropped condition", "true")
            self.add(given[0], "dropped condition", "false")

    def name_of_limit(self, cursor, _):
        limit = cursor.referenced
        if limit is None or limit.kind != Kind.VAR_DECL or not LIMIT.fullmatch(self.of(cursor)):
            return
        known = limit.location.file is not None and limit.location.file.name.startswith(str(self.root))
        if known and (is_whole(limit.type) or is_float(limit.type)) and not is_truth(limit.type):
            self.add_limit(cursor)


RULES = {
    Kind.BINARY_OPERATOR: Source.binary,
    Kind.UNARY_OPERATOR: Source.unary,
    Kind.INTEGER_LITERAL: Source.whole_number,
    Kind.FLOATING_LITERAL: Source.number,
    Kind.CALL_EXPR: Source.call,
    Kind.ARRAY_SUBSCRIPT_EXPR: Source.subscript,
    Kind.IF_STMT: Source.branch,
    Kind.CONDITIONAL_OPERATOR: Source.branch,
    Kind.RETURN_STMT: Source.result,
    Kind.DECL_REF_EXPR: Source.name_of_limit,
}
STATEMENTS = {Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR, Kind.UNARY_OPERATOR, Kind.CALL_EXPR}


def is_statement(cursor, parent):
    """Its value is used by nobody."""
    parts = children(parent)
    if parent.kind == Kind.IF_STMT:
        return cursor != parts[0] and parts[0].kind != Kind.DECL_STMT
    return parent.kind == Kind.COMPOUND_STMT or (parent.kind in LOOPS and cursor == parts[-1])


def all_mutants(root, names, arguments):
    """Those of some files, in their order; a number of the switch is the place in the list, from 1."""
    cindex.Config.set_library_file(os.environ.get("LIANA_LIBCLANG", LIBRARY))
    index, limits, found = cindex.Index.create(), {}, []
    for name in names:
        found += Source(root, name, limits).read(index, arguments)
    return found + list(limits.values())


def rewritten(root, mutants):
    """The sources with all of them: name -> text."""
    edits = {}
    for number, mutant in enumerate(mutants, 1):
        becomes = mutant.becomes or "(void)0"
        for name, start, end in mutant.places:
            if mutant.kind == "size of a limit" and LIMIT.fullmatch(mutant.was):
                becomes = f"decltype({mutant.was})({mutant.becomes})"
            head = f"(lm({number})?({becomes}):("
            edits.setdefault(name, []).append((start, end, head if mutant.becomes else head[:-1] + "(void)("))
    return {name: insert((pathlib.Path(root) / name).read_bytes(), of_file) for name, of_file in edits.items()}


def insert(data, edits):
    """At one place inner ones close first, and outer ones open first."""
    marks = []
    for order, (start, end, head) in enumerate(edits):
        marks.append((start, 1, start - end, order, head.encode()))
        marks.append((end, 0, end - start, -order, b"))"))
    parts, at = [], 0
    for offset, _, _, _, mark in sorted(marks):
        parts += [data[at:offset], mark]
        at = offset
    return b"".join([*parts, data[at:]])
