"""Files of the host for the guest's memory. Over 9p every open is a question to the host, and a guest that skips idle
time skips the answer's time as well: minutes pass in it while a busy host reads a file, or finds that there is none. A
sealed guest has nothing else, and asks nothing."""

import os
import pathlib
import shutil
import stat
import subprocess

PREFIX = "preload"  # directory of the start file system; guest_init lays it over the host's files


def libraries(program):
    """Shared libraries of a program and its loader, by name as the loader asks for them."""
    done = subprocess.run(["ldd", program], capture_output=True, text=True, check=False)
    words = [word for line in done.stdout.splitlines() for word in line.split() if word.startswith("/")]
    return [word for word in words if os.path.exists(word)]


def programs(names):
    """Paths of programs on the search path, with their libraries."""
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    found = [name if "/" in name else shutil.which(name, path=path) for name in names]
    found = [os.path.abspath(name) for name in found if name]
    return sorted({each for program in found for each in [program, *libraries(os.path.realpath(program))]})


def with_links(path):
    """Every symbolic link on the way to `path`, and what they lead to."""
    links, done = [], pathlib.Path("/")
    parts = list(pathlib.Path(path).parts[1:])
    while parts:
        done = done / parts.pop(0)
        if done.is_symlink():
            links.append(done)
            target = pathlib.Path(os.path.normpath(done.parent / os.readlink(done)))
            parts, done = list(target.parts[1:]) + parts, pathlib.Path("/")
    return links, done


def collect(paths):
    """All files, links and their directories below the given paths."""
    found = {each for each in pathlib.Path("/").iterdir() if each.is_symlink()}  # /bin, /lib and the like
    for path in paths:
        links, real = with_links(path)
        found.update(links)
        found.add(real)
        if real.is_dir():
            found.update(each for each in real.rglob("*") if each.is_symlink() or each.is_file())
    return sorted(found | {parent for each in found for parent in each.parents})


def record(name, mode, content):
    """One file of a cpio archive, format newc."""
    fields = [0, mode, 0, 0, 1, 0, len(content), 0, 0, 0, 0, len(name) + 1, 0]
    head = b"070701" + b"".join(b"%08X" % field for field in fields) + name.encode() + b"\0"
    return head + bytes(-len(head) % 4) + content + bytes(-len(content) % 4)


def archive(paths):
    """A cpio archive of what collect() finds."""
    parts = [record(PREFIX, 0o040755, b"")]
    for path in collect(paths):
        if path == pathlib.Path("/"):
            continue
        mode = path.lstat().st_mode
        content = os.readlink(path).encode() if stat.S_ISLNK(mode) else path.read_bytes() if stat.S_ISREG(mode) else b""
        parts.append(record(PREFIX + str(path), mode, content))
    return b"".join([*parts, record("TRAILER!!!", 0, b"")])
