"""Manual pages and completion, made of what the programs say themselves.

make_pages.py FOLDER PROGRAM...: writes FOLDER/share/man/man1/*.1, one page for each program and each of its commands,
and completion of `liana` for bash and zsh.
"""

import pathlib
import re
import shutil
import subprocess
import sys

ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(.*))?$")
CONTINUED = re.compile(r"^\s{10,}(\S.*)$")
LISTS = ("Positionals:", "Options:", "Subcommands:")


def say(program, *words):
    """What a program prints; its failure is ours."""
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


class Help:
    """A help text in parts: `about`, `usage`, for each list its entries (name, text), `footer`."""

    def __init__(self, text):
        self.usage, self.footer, self.lists = "", [], {name: [] for name in LISTS}
        about, current = [], None
        for line in text.splitlines():
            if line.startswith("Usage:"):
                self.usage = line.removeprefix("Usage:").strip()
            elif line in LISTS:
                current = self.lists[line]
            elif not self.usage:
                about.append(line)
            elif current is not None and (entry := ENTRY.match(line)):
                current.append([entry[1], entry[2] or ""])
            elif current and (more := CONTINUED.match(line)):
                current[-1][1] = f"{current[-1][1]} {more[1]}".strip()
            elif line.strip():
                self.footer.append(line)
        self.about = " ".join(about)

    def commands(self):
        return [name for name, _ in self.lists["Subcommands:"] if name != "help"]


def roff(text):
    """Text as roff takes it literally."""
    text = text.replace("\\", r"\e").replace("-", r"\-").replace("'", r"\(aq")
    return "\n".join("\\&" + line if line.startswith(".") else line for line in text.splitlines())


def entries(title, rows):
    if not rows:
        return []
    lines = [f".SH {title}"]
    for name, text in rows:
        lines += [".TP", rf"\fB{roff(name)}\fR", roff(text)]
    return lines


def page(words, text, version):
    """The page of one command: words are those that call it, text is its help."""
    name, told = "-".join(words), Help(text)
    usage = " ".join(words) + "".join(re.findall(r" (?:\[|SUBCOMMAND).*$", told.usage)[:1])
    lines = [f'.TH "{name.upper()}" 1 "" "{version}" "Liana"', ".SH NAME", rf"{roff(name)} \- {roff(told.about)}"]
    lines += [".SH SYNOPSIS", roff(usage)]
    lines += entries("ARGUMENTS", told.lists["Positionals:"])
    lines += entries("OPTIONS", told.lists["Options:"])
    lines += entries("COMMANDS", told.lists["Subcommands:"])
    if told.commands():
        names = ", ".join(rf"\fB{roff(name + '-' + command)}\fR(1)" for command in told.commands())
        lines += [".SH SEE ALSO", names]
    if told.footer:
        lines += [".SH NOTES", *(roff(line) + "\n.br" for line in told.footer)]
    return "\n".join(lines) + "\n"


def write_pages(folder, program, words, version):
    """The pages of a command and of those below it."""
    text = say(program, *words[1:], "--help")
    (folder / f"{'-'.join(words)}.1").write_text(page(words, text, version), encoding="utf-8")
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
    manual = share / "man" / "man1"
    manual.mkdir(parents=True)
    for program in programs:
        name = pathlib.Path(program).name
        write_pages(manual, program, [name], say(program, "--version").strip())
        if name == "liana":
            completions = share / "bash-completion" / "completions"  # bash loads a file by the name of the command
            write_completion(program, "bash", completions / "liana", completions / "liana-mission")
            write_completion(program, "zsh", share / "zsh" / "site-functions" / "_liana")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
