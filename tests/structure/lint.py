"""How sources look, and what a program can say of them.
  lint.py format [--check]   format the C++ and Python sources, or say which need it
  lint.py tidy [PATH...]     clang-tidy over the sources below PATH, or over those that differ from the last commit
`./dev test deep` runs every check of CHECKS."""

import collections
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
JOBS = str(os.cpu_count())
INCLUDE = '#include "{}"  // NOLINT(bugprone-suspicious-include)\n'  # of a batch for clang-tidy


def does(*command, **options):
    """Whether the command, called at the top of the tree, ends well; one that is not there does not."""
    try:
        return subprocess.run(command, cwd=ROOT, check=False, **options).returncode == 0
    except OSError as error:
        print(f"{command[0]}: {error.strerror}", file=sys.stderr, flush=True)
        return False


def configure(preset, **options):
    """CMake's configuration, which is shown only where it fails."""
    told = ["cmake", "--preset", preset]
    done = subprocess.run(told, cwd=ROOT, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        print(done.stdout + done.stderr, file=sys.stderr, flush=True)
    return done.returncode == 0


def output(*command):
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.splitlines()


def sources(*patterns):
    """Files that git knows or would know; no links to folders."""
    listed = output("git", "ls-files", "--cached", "--others", "--exclude-standard", "--", *patterns)
    return sorted({path for path in listed if (ROOT / path).is_file()})


def scripts(program):
    """Files whose first line names this program."""
    found = []
    for path in sources():
        with open(ROOT / path, "rb") as file:
            line = file.readline(80)
        if line.startswith(b"#!") and line.split()[-1].split(b"/")[-1] == program.encode():
            found.append(path)
    return found


def each(command, files, at_a_time=20, **options):
    """Whether the command takes all files, as many calls at once as there are processors."""
    given = "\0".join(files).encode()
    return does("xargs", "-0", "-r", "-P", JOBS, "-n", str(at_a_time), *command, input=given, **options)


def format_cpp(check=False):
    return each(["clang-format", *(["--dry-run", "--Werror"] if check else ["-i"])], sources("*.cpp", "*.hpp"))


def format_python(check=False):
    files = sorted({*sources("*.py"), *scripts("python3")})
    return each(["black", "-l", "120", *(["--check"] if check else [])], files, len(files))


def check_shell():
    return each(["shellcheck"], scripts("bash") + scripts("sh"))


def batches(files, folder):
    """Writes sources that include these, up to 20 that are compiled alike in each, and their commands; returns them. What
    no target compiles is left out."""
    commands = {}
    for entry in json.loads((ROOT / "build/tidy/compile_commands.json").read_text()):
        options, _, _ = entry["command"].rpartition(" -o ")  # which CMake writes last, with -c and the file
        commands[os.path.relpath(entry["file"], ROOT)] = options
    alike = collections.defaultdict(list)
    for file in files:
        if file in commands:
            alike[commands[file]].append(file)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    entries = []
    for options, members in alike.items():
        for first in range(0, len(members), 20):
            batch = folder / f"batch_{len(entries)}.cpp"
            batch.write_text("".join(INCLUDE.format(ROOT / file) for file in members[first : first + 20]))
            command = f"{options} -c {batch}"
            entries.append({"directory": str(ROOT / "build/tidy"), "file": str(batch), "command": command})
    (folder / "compile_commands.json").write_text(json.dumps(entries))
    return [entry["file"] for entry in entries], [file for file in files if file not in commands]


def tidy(files):
    """What clang-tidy has to say of them fails. Its preset is only configured: it names the commands. Headers take it
    longer than sources, so it sees sources in batches."""
    if not configure("tidy"):
        return False
    folder = ROOT / "build/tidy/batches"
    together, alone = batches(files, folder)
    # On standard error it only counts warnings of headers that are not ours.
    tool = ["clang-tidy", f"--config-file={ROOT / '.clang-tidy'}", "--quiet", "--warnings-as-errors=*"]
    in_batch = [*tool, f"--header-filter=^{ROOT}/.*[.]cpp$", "-p", str(folder)]
    good = each(in_batch, together, 1, stderr=subprocess.DEVNULL)
    # Of what no target compiles it guesses the command.
    return each([*tool, "-p", "build/tidy"], alone, 6, stderr=subprocess.DEVNULL) and good


def runs(*command):
    return lambda: does(*command)


CHECKS = {
    "luacheck": runs("luacheck", "-q", "--no-color", "lua", "tests/lua"),
    "clang-format": lambda: format_cpp(check=True),
    "black": lambda: format_python(check=True),
    "shellcheck": check_shell,
    "the checks of structure find what is planted": runs(
        "python3", "-m", "unittest", "discover", "-q", "-s", "tests/structure", "-p", "*_test.py"
    ),
    "includes, libraries and clocks": runs("python3", "tests/structure/check_includes.py"),
    "type names": runs("python3", "tests/structure/check_type_names.py"),
    "retired words (docs/development/glossary.md)": runs("codespell"),
    "lengths of sentences in the pages": runs("python3", "docs/check_prose.py"),
    "quoted sentences of messages": runs("python3", "tests/structure/quoted_sentences.py"),
    "namespaces of rooms": runs("python3", "tests/structure/check_namespaces.py"),
    "the acceptance page": runs("python3", "tests/structure/accept.py", "--check"),
    "the page of missions and their library": runs("python3", "docs/mission_page.py", "--check"),
    "documentation links": runs("python3", "docs/check_links.py"),
}


def complain(text):
    print(f"lint: {text}", file=sys.stderr)
    return 2


def tidied(paths):
    absent = [path for path in paths if not (ROOT / path).exists()]
    if absent:
        return complain(f"tidy: {absent[0]} is not there; give files or folders, or nothing for what differs")
    changed = output("git", "diff", "--name-only", "--diff-filter=d", "HEAD")
    changed += output("git", "ls-files", "--others", "--exclude-standard")
    files = [path for path in (sources(*paths) if paths else changed) if path.endswith(".cpp")]
    if not files:
        print("no sources there")
    return 0 if not files or tidy(files) else 1


def main(command, *words):
    if command == "tidy":
        return tidied(words)
    if command != "format" or words not in ((), ("--check",)):
        return complain(f"{' '.join((command, *words))} is not known; allowed: format, format --check, tidy PATH...")
    cpp, python = format_cpp(bool(words)), format_python(bool(words))
    return 0 if cpp and python else 1


if __name__ == "__main__":
    sys.exit(main(*(sys.argv[1:] or [""])))
