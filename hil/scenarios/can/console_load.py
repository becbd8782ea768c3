"""A gateway of the console with twenty clients of all records, one that reads nothing and one that sends nonsense: one of
the loads beside a latency measurement. Ends by itself when the gateway serves them no records.
"""
import json
import select
import socket
import struct
import subprocess
import sys
import time

from liana.system import program, run

WATCHERS = 20
PATIENCE_S = 2.0  # without a record
UPGRADE = (
    "GET /ws HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Protocol: liana-console-1\r\n\r\n"
)
TEXT, BINARY = 0x81, 0x82


def frame(kind, payload):
    """A short message of a client, its mask zero (RFC 6455, section 5.2)."""
    return bytes([kind, 0x80 | len(payload), 0, 0, 0, 0]) + payload


HELLO = frame(TEXT, b'{"op":"hello","name":"watcher"}')
NONSENSE = frame(TEXT, b'{"op":"nonsense"}') * 20


def connected(host):
    """A socket that has asked for the WebSocket and been answered."""
    name, port = host.split(":")
    client = socket.create_connection((name, int(port)))
    client.sendall(UPGRADE.format(host=host).encode())
    client.recv(65536)
    return client


class Watcher:
    """Answers every record."""

    def __init__(self, host):
        self.socket, self.buffer, self.records = connected(host), b"", 0
        self.socket.sendall(HELLO)

    def read(self):
        self.buffer += self.socket.recv(65536)
        while len(self.buffer) >= 4:
            kind, size, begin = self.buffer[0], self.buffer[1], 2
            if size == 126:
                size, begin = struct.unpack_from("!H", self.buffer, 2)[0], 4
            elif size == 127:
                if len(self.buffer) < 10:
                    return
                size, begin = struct.unpack_from("!Q", self.buffer, 2)[0], 10
            if len(self.buffer) < begin + size:
                return
            if kind == BINARY:
                self.records += 1
                self.socket.sendall(frame(BINARY, self.buffer[begin : begin + 4]))
            self.buffer = self.buffer[begin + size :]


def send_nonsense(flood, host):
    """A little more of it; the connection that goes on with it, another one when that one was closed."""
    try:
        flood.send(NONSENSE, socket.MSG_DONTWAIT)
        return flood
    except BlockingIOError:
        return flood
    except OSError:
        flood.close()
        flood = connected(host)
        flood.sendall(HELLO)
        return flood


def main():
    api = json.loads(run("liana", "status", "--json").stdout)["api"]
    words = ["--api", api, "--listen", "127.0.0.1:0"]
    with subprocess.Popen([program("liana-gateway"), *words], stdout=subprocess.PIPE, text=True) as gateway:
        host = gateway.stdout.readline().split("/")[2]
        watchers = {watcher.socket.fileno(): watcher for watcher in (Watcher(host) for _ in range(WATCHERS))}
        deaf, flood = Watcher(host), connected(host)
        poll = select.poll()
        for number in watchers:
            poll.register(number, select.POLLIN)
        seen, since = 0, time.monotonic()
        while deaf and gateway.poll() is None:
            for number, _ in poll.poll(20):
                watchers[number].read()
            flood = send_nonsense(flood, host)
            records = min(watcher.records for watcher in watchers.values())
            if records > seen:
                seen, since = records, time.monotonic()
            if time.monotonic() - since > PATIENCE_S:
                sys.exit("the gateway does not serve its clients")


if __name__ == "__main__":
    main()
