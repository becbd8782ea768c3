"""One end of the embedded bus (docs/reference/bus-protocol.md), woken and answered packet by packet."""
import collections
import socket
import struct

HELLO, WELCOME, WAKE, YIELD = 1, 2, 3, 4
CONTROLLER, PLANT = 0, 1
SHUTDOWN, SLOT_START = 1, 2
WAKE_ON_SYNC, LEAVE = 1, 2
FRAME = struct.Struct("<QIBBBB8s")

Frame = collections.namedtuple("Frame", "bus id data")
Wake = collections.namedtuple("Wake", "flags slot now_us frames")


class EmbeddedBus:
    """`period_us` is the bus table's; lockstep time only."""

    def __init__(self, path, role, name):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.socket.connect(str(path))
        self.socket.send(struct.pack("<BBBB28s", HELLO, 1, role, 0, name.encode()))
        welcome = self.socket.recv(65536)
        assert welcome[0] == WELCOME, welcome
        (self.period_us,) = struct.unpack_from("<I", welcome, 4)

    def wake(self):
        """The next wake-up; None when the bus has ended."""
        packet = self.socket.recv(65536)
        if not packet or packet[0] != WAKE:
            return None
        flags, count, slot, now_us = struct.unpack_from("<BHIQ", packet, 1)
        if flags & SHUTDOWN:
            return None
        frames = [
            Frame(bus, identifier, data[:length])
            for _, identifier, bus, length, own, _, data in FRAME.iter_unpack(packet[16 : 16 + FRAME.size * count])
            if not own
        ]
        return Wake(flags, slot, now_us, frames)

    def answer(self, frames, until_us, flags=0):
        records = [FRAME.pack(0, frame.id, frame.bus, len(frame.data), 0, 0, bytes(frame.data)) for frame in frames]
        self.socket.send(struct.pack("<BBHIQ", YIELD, flags, len(records), 0, until_us) + b"".join(records))
