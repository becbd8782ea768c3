"""An adapter on a serial line at each end of a bus, as the kernel's slcan driver knows them: what one end sends, the
other receives, and a controller's error states are told as adapters tell them. The interfaces vanish when this program
ends.

    python3 serial_line.py COMMANDS NAME NAME [NAME NAME ...]        each pair of names is a bus

COMMANDS is made, a named pipe; a line `0 sb256256` tells the driver behind the first name of pair 0: s, then a
(active), w (warning), p (passive) or b (bus-off), then receive and transmit error counter, three digits each."""
import fcntl
import os
import pty
import select
import struct
import subprocess
import sys
import termios
import tty

SLCAN = 17  # line discipline
NAME_OF_INTERFACE = 0x8910  # SIOCGIFNAME
QUEUE = "128"  # frames; the driver's own default is too short for the targets of a bus


def interface(name):
    """A new interface of this name: the adapter's side of its line, and the driver's, which has to stay open."""
    adapter, driver = pty.openpty()
    tty.setraw(driver)
    fcntl.ioctl(driver, termios.TIOCSETD, struct.pack("i", SLCAN))
    found = fcntl.ioctl(driver, NAME_OF_INTERFACE, bytes(16)).split(b"\0")[0].decode()
    subprocess.run(["ip", "link", "set", found, "name", name, "txqueuelen", QUEUE], check=True)
    subprocess.run(["ip", "link", "set", name, "up"], check=True)
    return adapter, driver


class Wire:
    """Carries whole frames from one adapter to another."""

    def __init__(self, target):
        self.target, self.rest = target, b""

    def carry(self, received):
        whole, end, self.rest = (self.rest + received).rpartition(b"\r")
        if end:
            os.write(self.target, whole + end)


def main():
    path, names = sys.argv[1], sys.argv[2:]
    ends = [interface(name) for name in names]
    adapters = [adapter for adapter, _ in ends]
    wires = {adapters[index]: Wire(adapters[index ^ 1]) for index in range(len(adapters))}
    os.mkfifo(path)
    commands = os.open(path, os.O_RDWR)
    while True:
        for ready in select.select([*adapters, commands], [], [])[0]:
            received = os.read(ready, 4096)
            if ready != commands:
                wires[ready].carry(received)
                continue
            for line in received.decode().splitlines():
                bus, words = line.split()
                os.write(adapters[2 * int(bus)], words.encode() + b"\r")


if __name__ == "__main__":
    main()
