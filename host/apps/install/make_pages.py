"""Manual pages and completion, made of what the programs say themselves.

make_pages.py FOLDER PROGRAM...: writes FOLDER/share/man, one page for each program and each of its commands,
and completion of `liana` for bash and zsh.
"""

import pathlib
import re
import shutil
import subprocess
import sys

ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(.*))?$")
CONTINUED = re.compile(r"^\s{10,}(\S.*)$")
HEADING = re.compile(r"^(\S.*):$")
EXAMPLE = "Example: "


def say(program, *words):
    """What a program prints; its failure is ours."""
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


class Help:
    """A help text in parts: `about`, `usage`, lists of entries (name, text) by their headings, `examples`, `footer`."""

    def __init__(self, text):
        self.usage, self.footer, self.examples, self.lists = "", [], [], {}
        about, current = [], None
        for line in text.splitlines():
            if line.startswith("Usage:"):
                self.usage = line.removeprefix("Usage:").strip()
            elif not self.usage:
                about.append(line)
            elif heading := HEADING.match(line):
                current = self.lists.setdefault(heading[1], [])
            elif current is not None and (entry := ENTRY.match(line)):
                current.append([entry[1], entry[2] or ""])
            elif current and (more := CONTINUED.match(line)):
                current[-1][1] = f"{current[-1][1]} {more[1]}".strip()
            elif line.startswith(EXAMPLE):
                self.examples.append(line.removeprefix(EXAMPLE))
            elif line.strip():
                self.footer.append(line)
        self.about = " ".join(about)
        self.arguments, self.options = self.lists.pop("Positionals", []), self.lists.pop("Options", [])

    def commands(self):
        """Their names; all lists but those of arguments and options are groups of commands."""
        return [name for entries in self.lists.values() for name, _ in entries if name != "help"]


def roff(text):
    """Text as roff takes it literally."""
    text = text.replace("\\", r"\e").replace("-", r"\-").replace("'", r"\(aq")
    return "\n".join("\\&" + line if line.startswith(".") else line for line in text.splitlines())


def entries(heading, rows):
    lines = [heading] if rows else []
    for name, text in rows:
        lines += [".TP", rf"\fB{roff(name)}\fR", roff(text)]
    return lines


def section(title, lines):
    return [f".SH {title}", *(roff(line) + "\n.br" for line in lines)] if lines else []


def section_of(name):
    """Commands of people are in section 1, programs behind them in 8: `liana mission` is not liana-mission."""
    return 1 if name == "liana" else 8


def page(words, text, version):
    """The page of one command: words are those that call it, text is its help."""
    number = section_of(words[0])
    name, told = "-".join(words), Help(text)
    usage = " ".join(words) + "".join(re.findall(r" (?:\[|SUBCOMMAND).*$", told.usage)[:1])
    lines = [
        f'.TH "{name.upper()}" {number} "" "{version}" "Liana"',
        ".SH NAME",
        rf"{roff(name)} \- {roff(told.about)}",
    ]
    lines += [".SH SYNOPSIS", roff(usage)]
    lines += entries(".SH ARGUMENTS", told.arguments)
    lines += entries(".SH OPTIONS", told.options)
    if told.commands():
        lines += [".SH COMMANDS"]
        for group, rows in told.lists.items():
            lines += entries(f".SS {roff(group)}", rows)
    lines += section("EXAMPLES", told.examples)
    if told.commands():
        names = ", ".join(rf"\fB{roff(name + '-' + command)}\fR({number})" for command in told.commands())
        lines += [".SH SEE ALSO", names]
    lines += section("NOTES", told.footer)
    return "\n".join(lines) + "\n"


def write_pages(folder, program, words, version):
    """The pages of a command and of those below it."""
    text = say(program, *words[1:], "--help")
    number = section_of(words[0])
    manual = folder / f"man{number}"
    manual.mkdir(parents=True, exist_ok=True)
    (manual / f"{'-'.join(words)}.{number}").write_text(page(words, text, version), encoding="utf-8")
    for command in Help(text).commands():
        write_pages(folder, program, [*words, command], version)


def write_completion(liana, shell, *files):
    """Without the line that names the program that was asked: the installed one is found by its name."""
    lines = [line for line in say(liana, "completion", shell).splitlines() if not line.startswith("_liana_program=")]
    for file in files:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def main(folder, *programs):
    share = pathlib.Path(folder) / "share"
    shutil.rmtree(share, ignore_errors=True)
    for program in programs:
        name = pathlib.Path(program).name
        write_pages(share / "man", program, [name], say(program, "--version").strip())
        if name == "liana":
            completions = share / "bash-completion" / "completions"  # bash loads a file by the name of the command
            write_completion(program, "bash", completions / "liana", completions / "liana-mission")
            write_completion(program, "zsh", share / "zsh" / "site-functions" / "_liana")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
