"""Checks the documentation: every Markdown link leads somewhere, and every path named in it exists in the tree."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
TOP_FOLDERS = ("firmware_like/", "host/", "hil/", "lua/", "tests/", "docs/")


def pages():
    return [ROOT / "README.md", ROOT / "CHANGELOG.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def broken_in(page):
    """Links and named paths of one page that lead nowhere."""
    text = page.read_text()
    for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", text):
        if "://" not in target and not (page.parent / target).exists():
            yield f"link {target}"
    for path in re.findall(r"`([\w./-]+)`", text):
        if path.startswith(TOP_FOLDERS) and not (ROOT / path).exists():
            yield f"path {path}"


def unlisted():
    """Pages that the index does not name."""
    index = (ROOT / "docs/index.md").read_text()
    return [
        page.name for page in (ROOT / "docs").glob("*.md") if page.name != "index.md" and f"({page.name})" not in index
    ]


def main():
    problems = [f"{page.relative_to(ROOT)}: {broken}: does not exist" for page in pages() for broken in broken_in(page)]
    problems += [f"docs/index.md: {name}: is not listed" for name in unlisted()]
    print("\n".join(problems) if problems else f"{len(pages())} pages, every link and path exists")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
