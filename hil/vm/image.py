"""Kernel and start file system of the virtual machine, made once from Debian's packages and kept in a cache."""

import gzip
import hashlib
import os
import pathlib
import shutil
import subprocess

KERNEL_PACKAGE = "linux-image-rt-amd64"
# What the guest loads; what these need is found by modprobe.
MODULES = [
    "virtio_pci",
    "9pnet_virtio",
    "9p",
    "overlay",
    "can-raw",
    "can-bcm",
    "can-gw",
    "vcan",
    "kvaser_pci",
    "slcan",
    "sch_tbf",
    "sch_netem",
]
# Program -> the Debian package it comes from.
PROGRAMS = {
    "qemu-system-x86_64": "qemu-system-x86",
    "busybox": "busybox-static",
    "modprobe": "kmod",
    "depmod": "kmod",
    "cpio": "cpio",
    "dpkg": "dpkg",
    "apt-get": "apt",
}
HERE = pathlib.Path(__file__).resolve().parent


class VmError(Exception):
    """Something that the user has to put right; the message says what."""


def find_program(name):
    """Path of a program, also in the directories of the superuser; None when there is none."""
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


def check_programs():
    """Refuses with the names of all missing packages."""
    missing = sorted({package for program, package in PROGRAMS.items() if find_program(program) is None})
    busybox = find_program("busybox")
    if busybox and subprocess.run(["ldd", busybox], capture_output=True).returncode == 0:
        missing.append("busybox-static")  # the dynamic one cannot start without the libraries of the host
    if missing:
        raise VmError(f"missing packages: {' '.join(missing)}; install them: apt-get install {' '.join(missing)}")


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise VmError(f"{' '.join(map(str, command))} failed:\n{(done.stdout + done.stderr).strip()}")
    return done.stdout


def cache_directory():
    chosen = os.environ.get("LIANA_VM_CACHE")
    return pathlib.Path(chosen) if chosen else pathlib.Path.home() / ".cache" / "liana-vm"


def kernel_package():
    """The package with the kernel itself, which linux-image-rt-amd64 depends on."""
    for line in run(["apt-cache", "depends", KERNEL_PACKAGE]).splitlines():
        name = line.split()[-1]
        if "Depends:" in line and name.startswith("linux-image-"):
            return name
    raise VmError(f"apt does not know {KERNEL_PACKAGE}; run apt-get update")


def unpack_kernel(target):
    """Downloads and unpacks the kernel below `target`; nothing is installed and no boot loader is touched."""
    partial = target.with_name(f"{target.name}-{os.getpid()}.part")  # guests start side by side
    partial.mkdir(parents=True)
    run(["apt-get", "download", kernel_package()], cwd=partial)
    package = next(partial.glob("*.deb"))
    run(["dpkg", "-x", package, partial / "root"])
    package.unlink()
    release = next((partial / "root/lib/modules").iterdir()).name
    run([find_program("depmod"), "-b", partial / "root", release])
    try:
        partial.rename(target)
    except OSError:
        shutil.rmtree(partial)
        if not target.exists():  # else another guest was sooner
            raise


def kernel():
    """(kernel image, module root, release) of the newest unpacked kernel; unpacks one when there is none."""
    target = cache_directory() / "kernel"
    if not target.exists():
        unpack_kernel(target)
    release = next((target / "root/lib/modules").iterdir()).name
    return target / "root/boot" / f"vmlinuz-{release}", target / "root", release


def modules_in_order(root, release):
    """Paths of the modules to load, each after those it needs."""
    ordered = []
    for name in MODULES:
        for line in run([find_program("modprobe"), "-d", root, "-S", release, "--show-depends", name]).splitlines():
            words = line.split()
            if words[0] == "insmod" and words[1] not in ordered:
                ordered.append(words[1])
    return ordered


def fill(staging, modules):
    for folder in ["bin", "modules", "proc", "sys", "dev", "lower", "layer", "root"]:
        (staging / folder).mkdir(parents=True)
    shutil.copy(find_program("busybox"), staging / "bin/busybox")
    shutil.copy(HERE / "guest_init", staging / "init")
    (staging / "init").chmod(0o755)
    for module in modules:
        shutil.copy(module, staging / "modules")
    (staging / "modules/order").write_text("".join(os.path.basename(module) + "\n" for module in modules))


def start_file_system(root, release):
    """Path of the initramfs; made again when guest_init, the modules or busybox have changed."""
    modules = modules_in_order(root, release)
    content = (
        "\n".join(modules).encode()
        + (HERE / "guest_init").read_bytes()
        + pathlib.Path(find_program("busybox")).read_bytes()
    )
    target = cache_directory() / f"initramfs-{hashlib.sha256(content).hexdigest()[:16]}.cpio.gz"
    if target.exists():
        return target
    staging = cache_directory() / f"staging-{os.getpid()}"
    shutil.rmtree(staging, ignore_errors=True)
    fill(staging, modules)
    names = "\n".join(str(path.relative_to(staging)) for path in sorted(staging.rglob("*")))
    archive = subprocess.run(
        ["cpio", "-o", "-H", "newc", "--quiet"], cwd=staging, input=names.encode(), stdout=subprocess.PIPE, check=True
    ).stdout
    partial = target.with_name(target.name + f".{os.getpid()}")
    partial.write_bytes(gzip.compress(archive, 6))
    partial.rename(target)
    shutil.rmtree(staging)
    return target
