"""Counts the words of every sentence in the pages: the mean at most 15 a page, no sentence over 35.

    python3 docs/check_prose.py [PAGE...]   a line for each page that breaks the rule, with its longest sentences

Code, tables, links' targets and generated pages do not count. A list item is a sentence of its own.
"""
import pathlib
import re
import sys

from check_links import pages

ROOT = pathlib.Path(__file__).resolve().parents[1]
GENERATED = {"api.md", "acceptance.md", "figures.md", "benchmarks.md"}
MAX_MEAN, MAX_WORDS = 15.0, 35


def paragraphs(text):
    """Running text without code, tables and headings; a list item begins a paragraph."""
    text = re.sub(r"^(```|~~~).*?^\1", "\n\n", text, flags=re.S | re.M)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    block = []
    for line in text.split("\n") + [""]:
        stripped = line.strip()
        begins = re.match(r"([-*+]|\d+[.)])\s+", stripped)
        if not stripped or begins or stripped.startswith(("|", "#")):
            if block:
                yield " ".join(block)
            block = []
        if stripped and not stripped.startswith(("|", "#")):
            block.append(stripped[begins.end() :] if begins else stripped)


def words_of(sentence):
    return re.findall(r"[^\s]*\w[^\s]*", sentence)


def sentences(text):
    for paragraph in paragraphs(text):
        plain = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", paragraph)
        plain = re.sub(r"`[^`]*`", "code", plain)
        plain = re.sub(r"\b(e\.g|i\.e|Fig|eq|no|vs|approx)\.", r"\1", plain)
        for sentence in re.split(r"(?<=[.!?])[\"')*_]*\s+", plain):
            if words_of(sentence):
                yield sentence


def problems(page):
    found = list(sentences(page.read_text()))
    lengths = [len(words_of(sentence)) for sentence in found]
    if lengths and sum(lengths) / len(lengths) > MAX_MEAN:
        yield f"mean {sum(lengths) / len(lengths):.1f} words a sentence, allowed {MAX_MEAN:.0f}"
    for sentence, length in zip(found, lengths):
        if length > MAX_WORDS:
            yield f"{length} words, allowed {MAX_WORDS}: {sentence[:70]}..."


def main():
    ours = sorted(page for page in pages() if page.name not in GENERATED)
    chosen = [pathlib.Path(name).resolve() for name in sys.argv[1:]] or ours
    found = [f"{page.relative_to(ROOT)}: {problem}" for page in chosen for problem in problems(page)]
    print("\n".join(found) if found else f"{len(chosen)} pages, every sentence is short enough")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
