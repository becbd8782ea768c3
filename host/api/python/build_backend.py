"""Makes the wheel of this package for pip (PEP 517, PEP 660) with the standard library alone: an isolated build of any
other backend would have to download it.
"""
import base64
import hashlib
import pathlib
import re
import tarfile
import tomllib
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = tomllib.loads((HERE / "pyproject.toml").read_text("utf-8"))["project"]
VERSION = re.search(r'^__version__ = "(.+?)"', (HERE / "liana/__init__.py").read_text("utf-8"), re.M)[1]
NAME = f"{PROJECT['name']}-{VERSION}"
SOURCES = sorted([*HERE.glob("liana/*.py"), HERE / "liana/py.typed"])
WHEEL = "Wheel-Version: 1.0\nGenerator: liana\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


def metadata():
    """The content of METADATA and PKG-INFO."""
    lines = ["Metadata-Version: 2.1", f"Name: {PROJECT['name']}", f"Version: {VERSION}"]
    lines += [f"Summary: {PROJECT['description']}", f"License: {PROJECT['license']['text']}"]
    lines.append(f"Requires-Python: {PROJECT['requires-python']}")
    for extra, packages in PROJECT["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f'Requires-Dist: {package}; extra == "{extra}"' for package in packages]
    return "\n".join(lines) + "\n"


def write_wheel(folder, files):
    """A wheel in `folder` with these files (name: bytes); its name."""
    info = f"{NAME}.dist-info"
    files = {**files, f"{info}/METADATA": metadata().encode(), f"{info}/WHEEL": WHEEL.encode()}
    record = ""
    wheel = f"{NAME}-py3-none-any.whl"
    with zipfile.ZipFile(pathlib.Path(folder) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name), content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{name},sha256={digest},{len(content)}\n"
        archive.writestr(zipfile.ZipInfo(f"{info}/RECORD"), f"{record}{info}/RECORD,,\n")
    return wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    return write_wheel(wheel_directory, {f"liana/{path.name}": path.read_bytes() for path in SOURCES})


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """For `pip install --editable`: a path to this folder."""
    return write_wheel(wheel_directory, {"liana.pth": f"{HERE}\n".encode()})


def build_sdist(sdist_directory, config_settings=None):
    name = f"{NAME}.tar.gz"
    with tarfile.open(pathlib.Path(sdist_directory) / name, "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for path in [*SOURCES, HERE / "pyproject.toml", HERE / "build_backend.py"]:
            archive.add(path, f"{NAME}/{path.relative_to(HERE)}")
    return name
