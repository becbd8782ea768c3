"""Liana installed like other software: into a prefix that is moved, used by programs of others, and removed."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.append(str(ROOT / "tests"))

from message import Messages  # noqa: E402

EXAMPLES = ROOT / "docs" / "examples"
PROGRAMS = ("liana", "lianad", "liana-archive", "liana-bench", "liana-bus", "liana-gateway", "liana-mission")
ZEROS = ",".join(["0"] * 10)
ROBOTS = sorted(file.stem for file in (ROOT / "lua" / "robots").glob("*.lua"))
TIMEOUT_S = 300


def run(*words, environment=None, check=True, cwd="/"):
    """Runs a program outside the source tree and returns what it printed and how it ended."""
    given = {name: value for name, value in os.environ.items() if not name.startswith("LIANA_")} | (environment or {})
    done = subprocess.run(
        [str(word) for word in words],
        capture_output=True,
        text=True,
        check=False,
        cwd=cwd,
        env=given,
        timeout=TIMEOUT_S,
    )
    if check and done.returncode != 0:
        raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def install(prefix, **environment):
    run("cmake", "--install", BUILD, "--prefix", prefix, environment=environment)


def files_in(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


class Installed(Messages, unittest.TestCase):
    """One prefix for all tests that change nothing in it; it is not where it was installed."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-prefix-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        manifest = BUILD / "install_manifest.txt"  # of whoever installed from this build folder
        before = manifest.read_bytes() if manifest.exists() else None
        cls.addClassCleanup(lambda: manifest.write_bytes(before) if before else manifest.unlink(missing_ok=True))
        install(cls.folder / "first")
        cls.prefix = cls.folder / "moved" / "elsewhere"
        cls.prefix.parent.mkdir()
        (cls.folder / "first").rename(cls.prefix)
        os.environ["XDG_RUNTIME_DIR"] = os.environ["XDG_STATE_HOME"] = str(cls.folder)

    def program(self, name, *words, **how):
        return run(self.prefix / "bin" / name, *words, **how)

    def test_every_program_says_the_version_of_the_project(self):
        version = re.search(r"project\(liana VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text("utf-8"))[1]
        for name in (*PROGRAMS, "liana-operator"):
            self.assertEqual(self.program(name, "--version").stdout, f"{name} {version}\n")

    def test_nothing_that_is_read_names_the_source_tree_or_the_place_of_installation(self):
        old = [str(ROOT).encode(), str(self.folder / "first").encode()]
        for path in self.prefix.rglob("*"):
            if path.parent.name == "bin" or path.suffix in (".a", ".service") or not path.is_file():
                continue  # debug information; a unit has to name its program
            for place in old:
                self.assertNotIn(place, path.read_bytes(), path)

    def test_a_moved_prefix_opens_no_file_of_the_source_tree(self):
        """Where a mount can be made the tree is hidden, and the build folder with it."""
        hide = f"mount -t tmpfs none '{ROOT}' && exec \"$@\""
        words = ["unshare", "--mount", "sh", "-c", hide, "sh"]
        hidden = words if run(*words, "true", check=False).returncode == 0 else []
        pose = run(*hidden, self.prefix / "bin" / "liana", "pose", f"--theta-deg={ZEROS}", "--json")
        self.assertEqual(len(json.loads(pose.stdout)["cable_length_m"]), 15)
        checked = run(*hidden, self.prefix / "bin" / "liana", "check", "micro_reach", "--robot", "micro")
        self.assertIn("outcome success", checked.stdout)
        named = run(*hidden, self.prefix / "bin" / "liana", "pose", "--robot", "none", "--theta-deg=0", check=False)
        self.assertEqual(named.returncode, 2)
        self.assertIn(", ".join(ROBOTS), named.stderr)

    def test_folders_of_ones_own_are_searched_before_those_installed(self):
        for name in ("one", "two"):
            robots = self.folder / name / "robots"
            robots.mkdir(parents=True)
            source = (ROOT / "lua" / "robots" / "zhu2022.lua").read_text("utf-8")
            for robot in ("mine", "zhu2022", name):
                (robots / f"{robot}.lua").write_text(source.replace('"zhu2022"', f'"{name}"'), "utf-8")
        one, two = self.folder / "one", self.folder / "two"
        path = {"LIANA_LUA_PATH": f"{one}:{two}"}

        def name_of(robot, *words, **how):
            return json.loads(self.program("liana", *words, "robot", "export", robot, **how).stdout)["name"]

        self.assertEqual(name_of("zhu2022"), "zhu2022")
        self.assertEqual(name_of("mine", environment=path), "one")
        self.assertEqual(name_of("zhu2022", environment=path), "one")
        self.assertEqual(name_of("two", environment=path), "two")
        self.assertEqual(name_of("mine", f"--lua-dir={two}", environment=path), "two")
        self.assertEqual(name_of("mine", "--lua-dir", one), "one")
        self.assertEqual(
            self.program("liana", "completion", "robots", environment=path).stdout.split(),
            sorted([*ROBOTS, "mine", "one", "two"]),
        )

    def test_a_search_path_that_is_no_folder_is_named(self):
        for words, environment, named in (
            (["--lua-dir=/no/such"], {}, ("--lua-dir", "/no/such", "folder")),
            ([], {"LIANA_LUA_PATH": "/no/such"}, ("LIANA_LUA_PATH", "/no/such", "folder")),
        ):
            done = self.program("liana", *words, "robot", "export", environment=environment, check=False)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            self.assert_names(done.stderr, *named)

    def test_the_python_client_finds_the_programs_of_its_prefix(self):
        code = "from liana import system; print(system.binaries()); print(system.table('robot', 'micro'))"
        where = {"PYTHONPATH": str(self.prefix / "share" / "liana" / "python"), "PYTHONDONTWRITEBYTECODE": "1"}
        where["PATH"] = "/usr/bin:/bin"
        binaries, robot = run(sys.executable, "-c", code, environment=where).stdout.splitlines()[:2]
        self.assertEqual(binaries, str(self.prefix / "bin"))
        self.assertEqual(json.loads(robot)["name"], "micro")

    def build_by_cmake(self, example):
        """The program of an example, named as its folder without the number."""
        folder = self.folder / "cmake" / example
        run("cmake", "-S", EXAMPLES / example, "-B", folder, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", folder)
        return folder / example.split("_", 1)[1]

    def build_by_pkg_config(self, example, package):
        where = {"PKG_CONFIG_PATH": str(self.prefix / "lib" / "pkgconfig")}
        options = run("pkg-config", "--cflags", "--libs", package, environment=where).stdout.split()
        program = self.folder / f"{example}-by-pkg-config"
        run("c++", "-std=c++20", EXAMPLES / example / "main.cpp", "-o", program, *options)
        return program

    def test_the_core_is_embedded_by_cmake_and_by_pkg_config(self):
        example = "05_embedded_core"
        for program in (self.build_by_cmake(example), self.build_by_pkg_config(example, "liana-core")):
            self.assertRegex(run(program).stdout, r"^enabled, 0 faults, largest error 0\.00\d+ deg\n$")

    def test_a_client_prints_the_state_of_a_running_system(self):
        example = "03_state_client"
        programs = [self.build_by_cmake(example), self.build_by_pkg_config(example, "liana-client")]
        words = ["console", "--simulate", "--robot", "micro", "--listen", "127.0.0.1:0", "--json"]
        command = [str(self.prefix / "bin" / "liana"), *words]
        console = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            socket = json.loads(console.stdout.readline())["api"]
            for program in programs:
                self.assertRegex(
                    run(program, socket).stdout, r"^[A-Z]+ at [0-9.]+ s, angles in degrees:( -?[0-9.]+){7}\n$"
                )
        finally:
            console.send_signal(signal.SIGINT)
            console.communicate(timeout=TIMEOUT_S)
        self.assertEqual(run(programs[0], "/no/such/socket", check=False).returncode, 1)

    def test_manual_pages_tell_every_command(self):
        manual = self.prefix / "share" / "man"
        commands = re.findall(r"^  ([a-z]+) ", self.program("liana", "help").stdout, re.MULTILINE)
        self.assertGreater(len(commands), 20)
        wanted = [f"liana-{command}" for command in commands if command != "help"] + ["liana-log-export", *PROGRAMS]
        for name in wanted:
            number = 8 if name in PROGRAMS[1:] and name != "liana-mission" else 1
            page = (manual / f"man{number}" / f"{name}.{number}").read_text("utf-8")
            self.assertIn(f'.TH "{name.upper()}" {number}', page)
            self.assertIn(".SH SYNOPSIS", page)
            self.assertEqual(".SH EXAMPLES" in page, number == 1, name)
        self.assertIn("\\-\\-theta\\-deg", (manual / "man1" / "liana-pose.1").read_text("utf-8"))
        command, program = (manual / f"man{number}" / f"liana-mission.{number}" for number in (1, 8))
        self.assertNotEqual(command.read_text("utf-8"), program.read_text("utf-8"))

    def test_installed_completion_asks_the_program_in_the_path(self):
        completion = self.prefix / "share" / "bash-completion" / "completions" / "liana"
        script = (
            f"source {completion}; COMP_WORDS=(liana pose --robot zh); COMP_CWORD=3; _liana; echo ${{COMPREPLY[@]}}"
        )
        path = {"PATH": f"{self.prefix / 'bin'}:{os.environ['PATH']}"}
        self.assertEqual(run("bash", "-c", script, environment=path).stdout, "zhu2022\n")
        self.assertTrue((self.prefix / "share" / "zsh" / "site-functions" / "_liana").is_file())

    def test_the_unit_names_the_prefix_and_has_what_real_time_takes(self):
        unit = (self.prefix / "lib" / "systemd" / "system" / "lianad@.service").read_text("utf-8")
        self.assertIn(f"ExecStart={self.folder / 'first'}/bin/lianad --time real", unit)
        for line in ("LimitRTPRIO=90", "LimitMEMLOCK=infinity", "Group=liana", "NoNewPrivileges=yes"):
            self.assertIn(f"\n{line}\n", unit)
        for option in re.findall(r" (--[a-z-]+) ", unit):
            self.assertIn(f"{option} ", self.program("lianad", "--help").stdout)
        users = (self.prefix / "lib" / "sysusers.d" / "liana.conf").read_text("utf-8")
        self.assertIn("\nu liana ", users)


class Packages(unittest.TestCase):
    """Debian's packages are components of the installation; building them is ./dev package."""

    CONTROL = (ROOT / "host" / "apps" / "install" / "debian" / "control").read_text("utf-8")

    def test_every_installed_file_is_in_one_package(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        install(folder / "all")
        packaged = []
        for package in re.findall(r"^Package: (.+)$", self.CONTROL, re.M):
            run("cmake", "--install", BUILD, "--prefix", folder / package, "--component", package)
            found = [path for path in files_in(folder / package) if (folder / package / path).is_file()]
            self.assertTrue(found, package)
            packaged += found
        installed = [path for path in files_in(folder / "all") if (folder / "all" / path).is_file()]
        others = ["share/doc/liana/LICENSE", "share/liana/installed_files.txt", "share/liana/uninstall.cmake"]
        self.assertEqual(sorted(packaged + others), installed)

    def test_the_source_package_is_built_with_what_the_build_needs(self):
        groups = (ROOT / "host" / "apps" / "install" / "packages").read_text("utf-8")
        needed = re.search(r'\[build\]="(.+?)"', groups, re.S)[1].split()
        stated = re.search(r"^Build-Depends: (.+?)^\S", self.CONTROL, re.M | re.S)[1].replace(",", " ").split()
        self.assertEqual(set(needed) - set(stated), {"g++"}, "which build-essential has")


class Removed(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="liana-prefix-"))
        self.addCleanup(shutil.rmtree, self.folder)
        manifest = BUILD / "install_manifest.txt"
        before = manifest.read_bytes() if manifest.exists() else None
        self.addCleanup(lambda: manifest.write_bytes(before) if before else manifest.unlink(missing_ok=True))

    def test_systemd_finds_nothing_wrong_with_the_unit_and_the_target_uninstall_leaves_nothing(self):
        install(self.folder / "prefix")
        where = {"PYTHONPATH": str(self.folder / "prefix" / "share" / "liana" / "python")}
        run(sys.executable, "-c", "import liana", environment=where)  # leaves __pycache__
        unit = self.folder / "lianad@left.service"
        shutil.copy(self.folder / "prefix" / "lib" / "systemd" / "system" / "lianad@.service", unit)
        verified = run("systemd-analyze", "verify", "--man=no", unit)
        self.assertNotIn(unit.name, verified.stdout + verified.stderr)
        run("cmake", "--build", BUILD, "--target", "uninstall")
        self.assertEqual(files_in(self.folder / "prefix"), [])

    def test_a_moved_prefix_is_emptied_by_its_own_script_but_for_what_others_put_there(self):
        install(self.folder / "prefix")
        moved = self.folder / "moved"
        (self.folder / "prefix").rename(moved)
        own = moved / "share" / "liana" / "lua" / "robots" / "own.lua"
        own.write_text("return {}\n", "utf-8")
        run("cmake", "-P", moved / "share" / "liana" / "uninstall.cmake")
        left = ["share", "share/liana", "share/liana/lua", "share/liana/lua/robots", "share/liana/lua/robots/own.lua"]
        self.assertEqual(files_in(moved), left)

    def test_a_package_is_staged_by_DESTDIR(self):
        install("/usr", DESTDIR=str(self.folder))
        usr = self.folder / "usr"
        self.assertEqual(run(usr / "bin" / "liana", "completion", "robots").stdout.split(), ROBOTS)
        unit = (usr / "lib" / "systemd" / "system" / "lianad@.service").read_text("utf-8")
        self.assertIn("ExecStart=/usr/bin/lianad ", unit)
        self.assertEqual(files_in(self.folder)[0], "usr")
        run("cmake", "--build", BUILD, "--target", "uninstall", environment={"DESTDIR": str(self.folder)})
        left = [path for path in usr.rglob("*") if not path.is_dir() or "liana" in path.name.lower()]
        self.assertEqual(left, [])
        self.assertTrue((usr / "bin").is_dir(), "the system's own folder")


if __name__ == "__main__":
    unittest.main()
