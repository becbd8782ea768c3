"""A driver of an input device (docs/reference/device-protocol.md): one hand's samples up, the arm's state down.

Sizes and offsets are those of liana_device.h; a device with two hands, or one that renders force, is written in C or C++.
"""
from __future__ import annotations

import os
import socket
import struct
from typing import NamedTuple, Optional, Sequence

from liana.client import LianaError, Path, wait_until

MAGIC, VERSION = 0x4E41494C, 1
HELLO, SAMPLE, BYE, WELCOME, REFUSED, STATE = range(1, 7)
KINDS = {"hand": 1, "vr": 2, "pointer": 3}
HEADER = struct.Struct("<IHHII")
HAND = struct.Struct("<4I8d")
HELLO_BODY = struct.Struct("<32sIIqdd")
SAMPLE_BODY = struct.Struct("<qIIIIqd7d6d")
STATE_HEAD = struct.Struct("<QqqqIIII32s4d7d6d7d")  # as far as the commanded tip
ALL_AXES = 63
PACKET_BYTES = 1024  # more than any packet has


class ArmState(NamedTuple):
    """What lianad told last; poses are `[x, y, z, qw, qx, qy, qz]` of the tip."""

    sequence: int
    tick: int
    arm_time_us: int
    answers_us: int  # device time of the newest sample that the command in force was made of, < 0: none
    held_us: int  # how long that command has been in force
    in_use: bool
    engaged: bool
    reason: str  # why the arm does not follow any more
    scale: float
    measured_cp: Sequence[float]
    setpoint_cp: Sequence[float]


def _packet(kind: int, body: bytes, sequence: int = 0) -> bytes:
    return HEADER.pack(MAGIC, VERSION, kind, HEADER.size + len(body), sequence) + body


class Device:
    """A connected device with one hand; its clock is what it is called with."""

    def __init__(self, path: Path, name: str, kind: str = "hand", rate_hz: float = 100.0, t_us: int = 0) -> None:
        """`path`: the socket of devices, lianad's API socket with `.devices` behind it."""
        self.state: Optional[ArmState] = None
        self.problem = ""  # why lianad let it go
        self._sequence = 0
        self._echo = (0, 0)
        hand = HAND.pack(ALL_AXES, 0, 0, 0, -1, -1, -1, 1, 1, 1, 0, 0)
        body = HELLO_BODY.pack(name.encode(), KINDS[kind], 1, t_us, rate_hz, 0.1) + hand + bytes(HAND.size)
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        try:
            wait_until(lambda: self.socket.connect_ex(os.fspath(path)) == 0, f"{path} to listen")
            self.socket.send(_packet(HELLO, body))
        except BaseException:
            self.close()
            raise

    def send(
        self, t_us: int, pose: Sequence[float], deadman: bool = False, valid: bool = True, stale: bool = False
    ) -> None:
        """One sample, `pose` as `[x, y, z, qw, qx, qy, qz]`; `stale`: the device has told nothing new, the arm is let
        go. LianaError when lianad has let the device go."""
        self._sequence += 1
        flags = int(valid) + 2 * int(deadman) + 4 * int(stale)
        body = SAMPLE_BODY.pack(t_us, 0, flags, 0, *self._echo, 0.0, *pose, *[0.0] * 6)
        try:
            self.socket.send(_packet(SAMPLE, body, self._sequence))
        except OSError as error:
            self.receive(t_us)
            raise LianaError(f"the device is not connected: {self.problem or error}") from error

    def receive(self, t_us: int) -> Optional[ArmState]:
        """Takes all that has come; the newest state, None before the first. Does not wait."""
        while not self.problem:
            try:
                packet = self.socket.recv(PACKET_BYTES, socket.MSG_DONTWAIT)
            except BlockingIOError:
                break
            except ConnectionResetError:
                continue  # said once; what lianad said before is still there
            if not packet:
                self.problem = "lianad is gone"
                break
            _, _, kind, _, sequence = HEADER.unpack_from(packet)
            if kind == REFUSED:
                self.problem = packet[HEADER.size :].split(b"\0", 1)[0].decode()
            elif kind == STATE:
                self._echo = (sequence, t_us)
                self.state = _state_of(sequence, packet)
        return self.state

    def close(self) -> None:
        """Leaves; the arm holds where this device steered it."""
        self.socket.close()


def _state_of(sequence: int, packet: bytes) -> ArmState:
    tick, arm_us, answers_us, held_us, flags, _, _, _, reason, scale, _, _, _, *numbers = STATE_HEAD.unpack_from(
        packet, HEADER.size
    )
    text = reason.split(b"\0", 1)[0].decode()
    in_use, engaged = bool(flags & 2), bool(flags & 4)
    return ArmState(
        sequence, tick, arm_us, answers_us, held_us, in_use, engaged, text, scale, numbers[:7], numbers[13:20]
    )
