"""Checks the documentation: every Markdown link leads somewhere, to a heading where it names one; every path named in a
page, and every page named in the tree, exists; the index lists every page.
"""
import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
TOP_FOLDERS = ("firmware_like/", "host/", "hil/", "lua/", "tests/", "docs/")
NAMERS = {".cpp", ".hpp", ".h", ".c", ".py", ".lua", ".ts", ".mjs", ".json", ".txt", ".in", ".md", ""}
OTHERS = {"node_modules", "__pycache__", "corpus"}  # a fuzzer's corpus is data


def pages():
    """All that people read: of the top, of docs, and the READMEs that open the folders."""
    top = [ROOT / "README.md", ROOT / "CHANGELOG.md", ROOT / "CONTRIBUTING.md"]
    folders = [
        ROOT / "tests/README.md",
        *(page for name in ("firmware_like", "host", "hil", "lua") for page in readmes(ROOT / name)),
    ]
    return [*top, *sorted(DOCS.rglob("*.md")), *folders]


def readmes(folder):
    return sorted({*folder.glob("README.md"), *folder.glob("*/README.md"), *folder.glob("*/*/README.md")})


@functools.cache
def anchors_of(page):
    """What a link may name behind #: the headings, as web pages of repositories spell them."""
    headings = re.findall(r"^#+ (.+?)\s*$", page.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_in(page):
    """Links and named paths of one page that lead nowhere."""
    text = page.read_text()
    for target, anchor in re.findall(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)", text):
        if "://" in target:
            continue
        to = page.parent / target if target else page
        if not to.exists():
            yield f"link {target}"
        elif anchor and to.suffix == ".md" and anchor not in anchors_of(to.resolve()):
            yield f"link {target}#{anchor}"
    told = page.name in ("CHANGELOG.md", "versions-before-0.4.md")  # of names as they were
    for path in () if told else re.findall(r"`([\w./-]+)`", text):
        if path.startswith(TOP_FOLDERS) and not (ROOT / path).exists():
            yield f"path {path}"


def unlisted():
    """Pages that the index does not name."""
    index = (DOCS / "index.md").read_text()
    names = [page.relative_to(DOCS).as_posix() for page in sorted(DOCS.rglob("*.md"))]
    return [name for name in names if name != "index.md" and f"({name})" not in index]


def namers():
    """The files of the tree that may name a page: sources, tables, messages."""
    yield ROOT / "dev"
    for folder in TOP_FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in NAMERS and path.is_file() and not OTHERS & set(path.parts):
                yield path


def gone_pages():
    """Files of the tree with the pages that they name and that do not exist."""
    for path in namers():
        for page in re.findall(r"\bdocs/[\w/-]+\.md\b", path.read_text(errors="replace")):
            if not (ROOT / page).exists():
                yield path.relative_to(ROOT), page


def main():
    problems = [f"{page.relative_to(ROOT)}: {broken}: does not exist" for page in pages() for broken in broken_in(page)]
    problems += [f"{path}: page {page}: does not exist" for path, page in gone_pages()]
    problems += [f"docs/index.md: {name}: is not listed" for name in unlisted()]
    print("\n".join(problems) if problems else f"{len(pages())} pages, every link and path exists")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
