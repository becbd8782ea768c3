"""A client of the console's gateway in the standard library alone (docs/reference/console-protocol.md): a WebSocket
(RFC 6455), and what Liana says over it.
"""
import base64
import hashlib
import hmac
import json
import os
import socket
import ssl
import struct
import time
import urllib.parse

PATIENCE_S = 60.0  # wall clock after which something counts as hung
TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
HEADER = struct.Struct("<IIdd")
ANSWERED_TOGETHER = 2  # records


class Refused(Exception):
    """The gateway answered the upgrade with another status than 101; `status` is it, `body` what it said."""

    def __init__(self, status, body):
        super().__init__(f"{status}: {body}")
        self.status, self.body = status, body


class Closed(ConnectionError):
    """The connection has ended; `code` of its close frame, 0 without one."""

    def __init__(self, code=0, reason=""):
        super().__init__(f"{code} {reason}")
        self.code, self.reason = code, reason


def connected(address, receive_bytes=0):
    """A TCP connection, with TLS where the address says so; (socket, host:port)."""
    parts = urllib.parse.urlsplit(address)
    plain = socket.socket(socket.AF_INET6 if ":" in parts.hostname else socket.AF_INET)
    if receive_bytes:
        plain.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_bytes)
    plain.settimeout(PATIENCE_S)
    try:
        plain.connect((parts.hostname, parts.port))
    except OSError:
        plain.close()
        raise
    if parts.scheme != "https":
        return plain, parts.netloc
    context = ssl.create_default_context()
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    return context.wrap_socket(plain), parts.netloc


def http_get(address, path="/", headers=(), method="GET"):
    """(status, headers as text, body) of one request, sent as it is given."""
    connection, host = connected(address)
    with connection:
        lines = [f"{method} {path} HTTP/1.1", *(headers or [f"Host: {host}"]), "Connection: close", "", ""]
        connection.sendall("\r\n".join(lines).encode())
        answer = b""
        while piece := connection.recv(65536):
            answer += piece
    head, _, body = answer.partition(b"\r\n\r\n")
    return int(head.split()[1]) if head else 0, head.decode(), body


class WebSocket:
    """Messages to and from a server; answers pings while it reads."""

    def __init__(
        self, address, path="/ws", protocol="liana-console-1", origin=None, host=None, receive_bytes=0, extensions=None
    ):
        self.socket, netloc = connected(address, receive_bytes)
        key = base64.b64encode(os.urandom(16)).decode()
        lines = [
            f"GET {path} HTTP/1.1",
            f"Host: {host or netloc}",
            "Upgrade: websocket",
            "Connection: Upgrade",
            f"Sec-WebSocket-Key: {key}",
            "Sec-WebSocket-Version: 13",
        ]
        lines += [f"Sec-WebSocket-Protocol: {protocol}"] if protocol else []
        lines += [f"Origin: {origin}"] if origin else []
        lines += [f"Sec-WebSocket-Extensions: {extensions}"] if extensions else []
        self.socket.sendall("\r\n".join([*lines, "", ""]).encode())
        self.buffer = b""
        while b"\r\n\r\n" not in self.buffer:
            piece = self.socket.recv(65536)
            if not piece:
                self.socket.close()
                raise Refused(0, "closed")
            self.buffer += piece
        head, _, self.buffer = self.buffer.partition(b"\r\n\r\n")
        self.head = head.decode()
        status = int(head.split()[1])
        if status != 101:
            self.socket.close()
            raise Refused(status, self.buffer.decode(errors="replace"))

    def send(self, payload, kind=TEXT):
        """One message; zeros as mask: nobody between here and there is to be protected."""
        payload = payload.encode() if isinstance(payload, str) else payload
        size = len(payload)
        length = (
            struct.pack("!B", 0x80 | size)
            if size < 126
            else struct.pack("!BH", 0xFE, size)
            if size < 65536
            else struct.pack("!BQ", 0xFF, size)
        )
        self.socket.sendall(bytes([0x80 | kind]) + length + bytes(4) + payload)

    def _exactly(self, count):
        while len(self.buffer) < count:
            piece = self.socket.recv(1 << 18)
            if not piece:
                raise Closed()
            self.buffer += piece
        taken, self.buffer = self.buffer[:count], self.buffer[count:]
        return taken

    def receive(self):
        """The next message: (kind, payload). Raises Closed, TimeoutError."""
        message = b""
        while True:
            first, second = self._exactly(2)
            size = second & 127
            if size == 126:
                (size,) = struct.unpack("!H", self._exactly(2))
            elif size == 127:
                (size,) = struct.unpack("!Q", self._exactly(8))
            payload = self._exactly(size)
            kind = first & 15
            if kind == CLOSE:
                raise Closed(struct.unpack("!H", payload[:2])[0] if payload else 0, payload[2:].decode())
            if kind == PING:
                self.send(payload, PONG)
            if kind in (PING, PONG):
                continue
            message += payload
            started = kind or started
            if first & 0x80:
                return started, message

    def close(self):
        self.socket.close()


class Console(WebSocket):
    """A client that has said hello (or the `hello` that it was given). `state` is the newest record as a dict by field, `facts` the newest facts."""

    def __init__(self, address, name="test", token_name=None, token=None, answers=True, hello=None, **options):
        super().__init__(address, **options)
        self.answers_records = answers
        self.state, self.facts, self.facts_number, self.header = {}, {}, 0, None
        self.welcome, self.away, self.events, self.answers = None, None, [], {}
        self.lost_events, self.complaints, self.last_id, self.welcomes = 0, [], 0, 0
        self.sequences = []
        self.challenge = json.loads(self.receive()[1])
        self.hello = hello or {"op": "hello", "name": name}
        if token is not None:
            proof = hmac.new(token.encode(), self.challenge["nonce"].encode(), hashlib.sha256).hexdigest()
            self.hello |= {"token_name": token_name, "proof": proof}
        self.say(self.hello)

    def say(self, message):
        self.send(json.dumps(message))

    def take(self):
        """Reads one message and keeps it; its op, or "record"."""
        kind, payload = self.receive()
        if kind == BINARY:
            self._take_record(payload)
            return "record"
        message = json.loads(payload)
        op = message["op"]
        if op == "welcome":
            self.welcome, self.away = message, None
            self.welcomes += 1
        elif op == "away":
            self.away = message["text"]
        elif op == "facts":
            self.facts, self.facts_number = message["state"], message["facts"]
        elif op == "event":
            self.events.append(message)
        elif op == "events_lost":
            self.lost_events += message["count"]
        elif op == "answer" and "id" in message:
            self.answers[message["id"]] = message
        else:
            self.complaints.append(message)
        return op

    def _take_record(self, payload):
        assert len(payload) == self.welcome["layout"]["bytes"], len(payload)
        self.header = HEADER.unpack_from(payload)
        self.sequences.append(self.header[0])
        if self.answers_records and len(self.sequences) % ANSWERED_TOGETHER == 0:
            self.answer_record()
        self.state = {"tick": int(self.header[2]), "time_s": self.header[3]}
        for field in self.welcome["layout"]["fields"]:
            values = struct.unpack_from(f"<{field['count']}f", payload, field["offset"])
            self.state[field["name"]] = list(values)

    def answer_record(self):
        self.send(struct.pack("<I", self.header[0]), BINARY)

    def until(self, wanted, patience_s=PATIENCE_S):
        """Reads on until wanted(self)."""
        deadline = time.monotonic() + patience_s
        while not wanted(self):
            if time.monotonic() > deadline:
                raise TimeoutError(f"state {self.state}, facts {self.facts}, complaints {self.complaints}")
            self.take()
        return self

    def request(self, op, **fields):
        """Sends a request and does not wait; its id."""
        self.last_id += 1
        self.say({"op": "request", "id": self.last_id, "request": {"op": op, **fields}})
        return self.last_id

    def ask(self, op, **fields):
        """Sends a request and reads on until its answer; that."""
        number = self.request(op, **fields)
        self.until(lambda me: number in me.answers)
        return self.answers.pop(number)

    def call(self, op, **fields):
        answer = self.ask(op, **fields)
        assert answer["ok"], answer
        return answer["answer"]

    def stop(self, reason=""):
        self.last_id += 1
        self.say({"op": "stop", "id": self.last_id, "reason": reason})
        return self.last_id

    def enable(self):
        self.call("acquire")
        self.until(lambda me: me.facts.get("state") == "DISABLED" and me.facts["is_homed"])
        self.call("state_command", command="enable")
        self.until(lambda me: me.facts["state"] == "ENABLED" and me.facts["at_rest"])
