"""Counts tests that quote a sentence of a message: prose can be mended only while tests compare its facts.

A quote is a text of 25 characters and 4 blanks or more that has three words in a row of a text in the product, or the
word "allowed". tests/message.hpp and tests/message.py compare facts instead.
"""

import ast
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PRODUCT = ("firmware_like", "hil", "host", "lua")
SOURCES = (".cpp", ".hpp", ".lua", ".py")
MIN_LENGTH, MIN_BLANKS, WORDS_IN_A_ROW = 25, 4, 3
# What prints texts of its own, or plants them: no message is tested here.
ASIDE = (
    "tests/benchmarks",
    "tests/bits",
    "tests/fuzz",
    "tests/golden",
    "tests/mutation",
    "tests/numbers",
    "tests/structure",
    "tests/tiers.py",
)
KNOWN = {  # file: how many sentences it may quote, and why
    "tests/host/planning/error_budget/test_budget_command.py": (2, "names of terms in the budget of the paper"),
    "tests/host/base/json/message_test.cpp": (5, "messages on which the comparison of facts is tried"),
    "tests/host/api/python/recordings_test.py": (1, "a comment line that the reader of events has to skip"),
    "tests/host/drives/socketcan/socketcan_test.cpp": (2, "commands that the test gives to the shell"),
    "tests/system/missions/short_micro.lua": (1, "the name of a step"),
    "tests/system/recordings_test.py": (1, "columns of a table of the archive"),
}

# Calls whose text is for whoever reads a failed test, or for the compiler.
CPP_SAYS = set(
    """SCOPED_TRACE GTEST_SKIP GTEST_FAIL FAIL ADD_FAILURE RecordProperty static_assert printf fprintf runtime_error
    invalid_argument logic_error measured TEST TEST_F TEST_P""".split()
)
PYTHON_SAYS = set(
    """print fail skipTest skip skipIf skipUnless exit add_argument ArgumentParser subTest SystemExit RuntimeError
    ValueError AssertionError TimeoutError SkipTest""".split()
)
CPP_TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|#include[^\n]*|R"(?P<tag>\w*)\((?P<raw>.*?)\)(?P=tag)"|"(?P<text>(?:\\.|[^"\\\n])*)"'
    r"|'(?:\\.|[^'\\\n])*'|(?P<name>[A-Za-z_]\w*)|(?P<mark><<|\S)",
    re.S,
)
LUA_TOKEN = re.compile(
    r"--\[\[.*?\]\]|--[^\n]*|\[\[(?P<raw>.*?)\]\]|\"(?P<text>(?:\\.|[^\"\\\n])*)\"|'(?P<single>(?:\\.|[^'\\\n])*)'"
    r"|(?P<name>[A-Za-z_]\w*)|(?P<mark>\.\.|\S)",
    re.S,
)
CODE = re.compile(r"[{}]|\\[nt]|\n|\b(?:local|return|require|function|import|SELECT|CREATE|INSERT|INTEGER)\b|\w = '|;$")
RUN = re.compile(r"[A-Za-z', ]+")  # numbers, formats and other marks end a row of words


def rows_of(text):
    for run in RUN.findall(text):
        words = run.lower().replace(",", " ").split()
        yield from zip(*(words[k:] for k in range(WORDS_IN_A_ROW)))


def is_sentence(text):
    return len(text) >= MIN_LENGTH and text.count(" ") >= MIN_BLANKS and not CODE.search(text)


def is_quote(text, said):
    return is_sentence(text) and (
        re.search(r"\ballowed\b", text) is not None or any(row in said for row in rows_of(text))
    )


def texts_of_calls(text, token, says, joins, also_streamed=False):
    """(line, literal) of every literal, pieces joined, that is no argument of what says it and is not streamed out."""
    calls, before, name, pieces = [], "", "", []

    def flush():
        nonlocal pieces
        if pieces and not quiet:
            yield pieces[0][0], "".join(piece for _, piece in pieces)
        pieces = []

    quiet = False
    for found in token.finditer(text):
        literal = next(
            (found[key] for key in ("text", "raw", "single") if found.groupdict().get(key) is not None), None
        )
        if literal is not None:
            if not pieces:
                quiet = (before == "<<" and not also_streamed) or any(call in says for call in calls)
            pieces.append((text.count("\n", 0, found.start()) + 1, literal))
            continue
        if not found["name"] and not found["mark"] or found["mark"] and found["mark"] in joins:
            continue  # a comment; what joins pieces
        yield from flush()
        mark = found["mark"]
        if mark and mark in "({[":
            calls.append(name if mark == "(" else "")
        elif mark and mark in ")}]" and calls:
            calls.pop()
        before, name = mark or "", found["name"] or ""
    yield from flush()


def python_texts(text):
    tree = ast.parse(text)
    parents = {child: node for node in ast.walk(tree) for child in ast.iter_child_nodes(node)}

    def called(node):
        return getattr(node.func, "attr", getattr(node.func, "id", ""))

    def is_message(node, child):  # the last argument of an assertion that explains it
        least = {"assertTrue": 1, "assertFalse": 1, "assertIsNone": 1, "assertIsNotNone": 1}.get(called(node), 2)
        return called(node).startswith("assert") and child in node.args[least:]

    def is_said(node):
        while node in parents:
            child, node = node, parents[node]
            if isinstance(node, ast.Call) and (called(node) in PYTHON_SAYS or is_message(node, child)):
                return True
            if isinstance(node, ast.keyword) and node.arg in ("msg", "help", "description"):
                return True
            if isinstance(node, ast.Assert) and child is node.msg or isinstance(node, ast.Raise):
                return True
            if isinstance(node, ast.Expr) and isinstance(child, ast.Constant):
                return True  # a docstring
        return False

    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            pieces = [each.value if isinstance(each, ast.Constant) else "0" for each in node.values]
            if not is_said(node):
                yield node.lineno, "".join(map(str, pieces))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            if not isinstance(parents.get(node), ast.JoinedStr) and not is_said(node):
                yield node.lineno, node.value


def texts_of(path):
    text = path.read_text()
    if path.suffix == ".py":
        return python_texts(text)
    if path.suffix == ".lua":
        return texts_of_calls(text, LUA_TOKEN, {"error", "print", "assert"}, ("..",))
    return texts_of_calls(text, CPP_TOKEN, CPP_SAYS, ())


def sources(root, tops):
    for path in sorted(path for top in tops for path in (root / top).rglob("*")):
        if path.suffix in SOURCES:
            yield path.relative_to(root).as_posix(), path


def said_by_product(root):
    """Every three words in a row of a text in the product."""
    said = set()
    for _, path in sources(root, PRODUCT):
        text = path.read_text()
        if path.suffix == ".py":
            texts = (node.value for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Constant))
            texts = [each for each in texts if isinstance(each, str)]
        else:
            token, joins = (LUA_TOKEN, ("..",)) if path.suffix == ".lua" else (CPP_TOKEN, ())
            texts = [each for _, each in texts_of_calls(text, token, (), joins, True)]
        for each in texts:
            said.update(rows_of(each))
    return said


def quotes(root):
    """Of each test: the lines that quote a sentence."""
    said = said_by_product(root)
    found = collections.defaultdict(list)
    for name, path in sources(root, ["tests"]):
        if not name.startswith(ASIDE):
            found[name] = [(line, text) for line, text in texts_of(path) if is_quote(text, said)]
    return {name: rows for name, rows in found.items() if rows}


def problems(found, known):
    for name, rows in sorted(found.items()):
        limit = known.get(name, (0, ""))[0]
        if len(rows) > limit:
            said = "".join(f"\n  {name}:{line}: {text}" for line, text in rows)
            yield f"{name} quotes {len(rows)} sentences of messages, {limit} are known: compare their facts{said}"
    for name, (limit, _) in sorted(known.items()):
        if len(found.get(name, [])) < limit:
            yield f"quoted_sentences.py: {name} quotes fewer than {limit} sentences now; correct KNOWN"


def main():
    found = quotes(ROOT)
    wrong = list(problems(found, KNOWN))
    count = sum(map(len, found.values()))
    print("\n".join(wrong) if wrong else f"tests quote {count} sentences of messages, those in KNOWN")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
