"""`liana teleop` in a terminal of its own: keys in, the picture out (docs/how-to/teleoperate.md)."""
import contextlib
import fcntl
import os
import pathlib
import pty
import re
import select
import signal
import struct
import subprocess
import tempfile
import termios
import time
import unittest

from support import SystemTest
from liana.client import wait_until
from liana.system import System, program

CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
REPEAT_S = 0.03  # of a key that is held
UNREAD_S = 2.0  # twenty pictures: a terminal keeps 4 to 64 kB


def release(handle):
    """Lets a stopped process go on, if it is still there."""
    with contextlib.suppress(ProcessLookupError):
        signal.pidfd_send_signal(handle, signal.SIGCONT)


class Driver:
    """`liana teleop` with these words, on a terminal of 80 x 24."""

    def __init__(self, test, *words):
        home = test.enterContext(tempfile.TemporaryDirectory(prefix="liana-home-", ignore_cleanup_errors=True))
        here, there = pty.openpty()
        fcntl.ioctl(there, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        homes = {"XDG_RUNTIME_DIR": home, "XDG_STATE_HOME": home, "TMPDIR": home}
        call = [program("liana"), "teleop", *map(str, words)]
        self.process = subprocess.Popen(
            call, stdin=there, stdout=there, stderr=subprocess.PIPE, text=True, env={**os.environ, **homes}
        )
        os.close(there)
        self.terminal, self.seen = here, ""
        test.addCleanup(os.close, here)
        test.addCleanup(self.process.stderr.close)
        test.addCleanup(self.process.wait)
        test.addCleanup(self.process.kill)

    def press(self, keys):
        os.write(self.terminal, keys.encode())

    def look(self):
        """Takes in what was drawn since."""
        with contextlib.suppress(OSError):  # the other side has gone
            while select.select([self.terminal], [], [], 0)[0]:
                self.seen += os.read(self.terminal, 65536).decode(errors="replace")

    def picture(self):
        """The newest whole picture, as text."""
        self.look()
        pictures = self.seen.split("\x1b[H")
        return CONTROL.sub("", pictures[-2]) if len(pictures) > 2 else ""

    def until(self, *words):
        wait_until(lambda: all(word in self.picture() for word in words), f"{words} in {self.picture()!r}")

    def number(self, pattern):
        found = re.search(pattern, self.picture())
        return float(found.group(1)) if found else None

    def hold_down(self, key, wanted):
        """As a terminal sends a key that is held."""

        def pressed():
            self.press(key)
            time.sleep(REPEAT_S)
            return wanted()

        wait_until(pressed, f"what {key} does: {self.picture()!r}")

    def child(self, name):
        """Process id of the program that it has started."""
        threads = pathlib.Path("/proc", str(self.process.pid), "task").glob("*/children")
        children = [int(number) for thread in threads for number in thread.read_text().split()]
        return next(each for each in children if pathlib.Path(f"/proc/{each}/comm").read_text().strip() == name)

    def end(self, key="x"):
        self.press(key)
        wait_until(lambda: (self.look(), self.process.poll() is not None)[1], "its end")
        return self.process.returncode


class Pad:
    """Events of a joystick (linux/joystick.h): time, value, type, number."""

    def __init__(self, file):
        self.fd = os.open(file, os.O_RDWR)  # so that the pipe has somebody at its other end from the beginning

    def button(self, number, values=(1, 0)):
        for value in values:
            os.write(self.fd, struct.pack("<IhBB", 0, value, 1, number))

    def axis(self, number, share):
        os.write(self.fd, struct.pack("<IhBB", 0, round(share * 32767), 2, number))

    def close(self):
        with contextlib.suppress(OSError):
            os.close(self.fd)


class Teleop(SystemTest):
    # req:A16
    def test_without_a_system_it_moves_a_simulated_arm_while_a_key_is_held_and_holds_when_it_is_let_go(self):
        driver = Driver(self)
        driver.until("DISABLED", "nobody owns motion")
        driver.press("w")
        driver.until("take motion")
        driver.press("t")
        driver.until("motion is yours")
        wait_until(lambda: (driver.press("n"), time.sleep(0.5), "DISABLED" not in driver.picture())[2], "homing")
        driver.until("ENABLED", "at rest")
        begin_m = driver.number(r"x +(-?[0-9.]+)")
        driver.hold_down("s", lambda: driver.number(r"x +(-?[0-9.]+)") < begin_m - 0.02)
        driver.until("at rest")
        rest_m = driver.number(r"x +(-?[0-9.]+)")
        self.assertLess(rest_m, begin_m - 0.02)
        driver.press(" ")
        driver.until("STOPPED", "key in the terminal", "DISABLED")
        self.assertEqual(driver.end(), 0)
        (folder,) = re.findall(r"recorded in (\S+);", driver.process.stderr.read())
        self.assertTrue(pathlib.Path(folder, "archive.db").exists(), folder)
        self.assertTrue(driver.seen.rstrip().endswith("\x1b[?25h\x1b[?1049l"), "the terminal is as it was")

    def test_a_driver_that_dies_gives_motion_back_and_the_arm_holds(self):
        with System() as system:
            keeper = system.client("keeper")
            keeper.go_on(2.0)
            driver = Driver(self, "--api", system.api)
            wait_until(lambda: (keeper.step(), "nobody owns" in driver.picture())[1], "its picture")
            driver.press("t")
            wait_until(lambda: keeper.step()["owner"].startswith("teleop-"), "its motion")
            driver.press("n")
            wait_until(lambda: keeper.step()["state"] == "ENABLED", "the enabled arm")
            wait_until(lambda: (driver.press("s"), keeper.step()["is_busy"])[1], "motion")
            driver.process.kill()
            wait_until(lambda: keeper.step()["owner"] == "", "the end of its motion")
            wait_until(lambda: keeper.step()["at_rest"], "the hold")
            self.assert_holds(keeper.state)

    # req:A16
    def test_a_gamepad_moves_the_arm_while_its_shoulder_button_is_held_and_stops_it_by_a_button(self):
        with System() as system:
            keeper = system.client("keeper")
            keeper.go_on(2.0)
            device, pad = self.gamepad()
            driver = Driver(self, "--api", system.api, "--gamepad", device)
            wait_until(lambda: (keeper.step(), "nobody owns" in driver.picture())[1], "its picture")
            pad.button(4)
            wait_until(lambda: keeper.step()["owner"].startswith("teleop-"), "its motion")
            pad.button(7)
            wait_until(lambda: keeper.step()["state"] == "ENABLED", "the enabled arm")
            begin_m = keeper.state["setpoint_cp"][0]
            pad.axis(1, 1.0)  # back
            keeper.go_on(1.0)
            self.assertAlmostEqual(keeper.state["setpoint_cp"][0], begin_m, 6, "nothing before the shoulder is held")
            pad.button(5, (1,))
            wait_until(lambda: keeper.step()["setpoint_cp"][0] < begin_m - 0.02, "the way back")
            pad.button(5, (0,))
            wait_until(lambda: keeper.step()["at_rest"], "the hold")
            pad.button(5, (1,))
            wait_until(lambda: keeper.step()["is_busy"], "motion again")
            pad.close()
            wait_until(lambda: (keeper.step(), "gamepad is gone" in driver.picture())[1], "the line")
            wait_until(lambda: keeper.step()["at_rest"], "the hold of a gamepad that is gone")
            self.assert_holds(keeper.state)

    def test_a_lianad_that_hangs_is_not_live_within_a_second_and_a_stop_that_it_does_not_confirm_is_told(self):
        driver = Driver(self)
        driver.until("DISABLED", "nobody owns motion")
        handle = os.pidfd_open(driver.child("lianad"))
        self.addCleanup(os.close, handle)
        self.addCleanup(release, handle)
        signal.pidfd_send_signal(handle, signal.SIGSTOP)
        begin = time.monotonic()
        driver.until("NOT LIVE")
        self.assertLess(time.monotonic() - begin, 2.0)
        driver.press("nt ")
        driver.until("NOT STOPPED", "cut the", "NOT LIVE")
        release(handle)
        driver.until("STOPPED     by", "key in the terminal", "nobody owns motion")
        driver.look()
        wait_until(lambda: "NOT" not in driver.picture(), "a live picture")
        self.assertEqual(driver.end(), 0)

    def test_after_a_stop_the_second_press_takes_motion_by_name_from_the_owner(self):
        with System() as system:
            keeper = system.client("keeper")
            keeper.go_on(2.0)
            keeper.call("acquire")
            driver = Driver(self, "--api", system.api)
            wait_until(lambda: (keeper.step(), "belongs to keeper" in driver.picture())[1], "its picture")
            driver.press("t")
            wait_until(lambda: (keeper.step(), "press t" in driver.picture())[1], "the refusal")
            driver.press("t")
            keeper.go_on(0.5)
            self.assertEqual(keeper.state["owner"], "keeper", "it works, and nobody has stopped the arm")
            keeper.call("stop")
            driver.press("t")
            wait_until(lambda: keeper.step()["owner"].startswith("teleop-"), "its motion")

    def gamepad(self):
        """A named pipe in a joystick device's place; its file, and who writes into it."""
        folder = self.enterContext(tempfile.TemporaryDirectory(prefix="liana-pad-"))
        file = os.path.join(folder, "js0")
        os.mkfifo(file)
        pad = Pad(file)
        self.addCleanup(pad.close)
        return file, pad

    def test_a_terminal_that_nobody_reads_still_stops_the_arm(self):
        with System() as system:
            keeper = system.client("keeper")
            keeper.go_on(2.0)
            driver = Driver(self, "--api", system.api)
            wait_until(lambda: (keeper.step(), "nobody owns" in driver.picture())[1], "its picture")
            begin = time.monotonic()
            while time.monotonic() < begin + UNREAD_S:  # its picture does not fit into the terminal any more
                keeper.step()
            driver.press("\x13 ")  # Ctrl-S is no key, space is
            wait_until(lambda: keeper.step()["stop"], "the stop")
            self.assertEqual(keeper.state["stop"]["reason"], "key in the terminal")

    def test_without_a_terminal_it_says_so_and_ends_with_2(self):
        done = subprocess.run([program("liana"), "teleop"], stdin=subprocess.DEVNULL, capture_output=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn(b"have to be a terminal", done.stderr)

    def test_a_link_that_cannot_listen_or_leads_to_itself_says_so_and_ends_with_2(self):
        for listen, words in ("/nowhere/link", b"cannot listen"), ("/tmp/devices", b"another socket"):
            call = [program("liana"), "link", "--listen", listen, "--devices", "/tmp/devices"]
            done = subprocess.run(call, capture_output=True, check=False, timeout=20)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
