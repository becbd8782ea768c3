"""What anybody can send to the console's gateway: it ends no gateway, and keeps nobody out for long."""
import contextlib
import socket
import ssl
import struct
import threading
import time
import unittest
import zlib

from console_client import Console, WebSocket, connected
from gateway_support import Gateway, GatewayAloneTest


def h2_frame(kind, flags, stream, payload=b""):
    """A frame of RFC 9113."""
    return struct.pack(">I", len(payload))[1:] + bytes([kind, flags]) + struct.pack(">I", stream) + payload


class BeforeTheHello(GatewayAloneTest):
    def secured(self):
        words = ["--token-file", self.tokens, *self.certificate()]
        return Gateway(self, self.api, *words)

    def raw(self, gateway):
        """A connection that has said nothing."""
        return self.enterContext(contextlib.closing(connected(gateway.address.replace("https://", "http://"))[0]))

    def tls(self, gateway, *protocols):
        context = ssl.create_default_context()
        context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
        context.set_alpn_protocols(list(protocols))
        return self.enterContext(context.wrap_socket(self.raw(gateway)))

    def answer_to(self, connection, sent):
        """What comes until the connection ends or 2 s have passed."""
        connection.settimeout(2)
        answer = b""
        with contextlib.suppress(OSError):
            connection.sendall(sent)
            while piece := connection.recv(65536):
                answer += piece
        return answer

    def assert_serves(self, gateway):
        self.assertIsNone(gateway.process.poll(), gateway.log())
        token = {"token_name": "anna", "token": "operates-the-arm-0001"} if "https" in gateway.address else {}
        begin = time.monotonic()
        with contextlib.closing(Console(gateway.address, **token)) as console:
            console.until(lambda me: me.away)
        self.assertLess(time.monotonic() - begin, 10)

    def test_http_2_is_spoken_to_nobody(self):
        preface = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + h2_frame(4, 0, 0)
        for gateway in (self.secured(), Gateway(self, self.api)):
            connections = [self.raw(gateway)]
            if gateway.address.startswith("https"):
                both, only = self.tls(gateway, "h2", "http/1.1"), self.tls(gateway, "h2")
                self.assertEqual((both.selected_alpn_protocol(), only.selected_alpn_protocol()), ("http/1.1", None))
                connections += [both, only]
            for connection in connections:
                self.assertNotIn(h2_frame(4, 1, 0), self.answer_to(connection, preface))
            host = gateway.address.split("/")[2]
            for path in ("/ws", "/"):
                asked = f"GET {path} HTTP/1.1\r\nHost: {host}\r\nUpgrade: h2c\r\n"
                asked += "Connection: Upgrade, HTTP2-Settings\r\n"
                asked += "HTTP2-Settings: AAMAAABkAARAAAAAAAIAAAAA\r\nSec-WebSocket-Protocol: liana-console-1\r\n\r\n"
                secured = gateway.address.startswith("https")
                connection = self.tls(gateway, "http/1.1") if secured else self.raw(gateway)
                self.assertIn(b" 400 ", self.answer_to(connection, asked.encode()).split(b"\r\n")[0])
            self.assert_serves(gateway)

    def test_a_websocket_over_http_2_with_long_frames_does_not_end_it(self):
        gateway = self.secured()
        fields = {":method": "CONNECT", ":protocol": "websocket", ":path": "/ws", ":scheme": "https"}
        fields |= {":authority": "localhost", "sec-websocket-version": "13"}
        fields |= {"sec-websocket-protocol": "liana-console-1"}
        head = b"".join(b"\0%c%b%c%b" % (len(k), k.encode(), len(v), v.encode()) for k, v in fields.items())
        window = struct.pack(">I", 10**6)
        begin = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + h2_frame(4, 0, 0) + h2_frame(1, 4, 1, head)
        begin += h2_frame(8, 0, 1, window) + h2_frame(8, 0, 0, window)
        data = (b"\x81\xfe\x7f\xff\0\0\0\0" + b"A" * 8200)[:8200]
        for protocols in (["h2"], ["h2", "http/1.1"], ["http/1.1"]):
            for _ in range(5):
                self.answer_to(self.tls(gateway, *protocols), begin + 6 * h2_frame(0, 0, 1, data))
        self.assert_serves(gateway)

    def test_a_connection_that_wants_to_be_something_else_is_closed(self):
        gateway = Gateway(self, self.api)
        host = gateway.address.split("/")[2]
        for line in (f"CONNECT {host}", "CONNECT /", "PRI *", "OPTIONS *", "TRACE /"):
            connections = [self.raw(gateway) for _ in range(20)]
            for connection in connections:
                connection.sendall(f"{line} HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
            for connection in connections:
                connection.settimeout(12)
                with contextlib.suppress(ConnectionError):
                    while connection.recv(65536):
                        pass
        for upgrade in ("foo", "h2c", "websocket, h2c", "TLS/1.0", ""):
            asked = f"GET /ws HTTP/1.1\r\nHost: {host}\r\nConnection: Upgrade\r\nUpgrade: {upgrade}\r\n\r\n"
            self.assertNotIn(b" 101 ", self.answer_to(self.raw(gateway), asked.encode()))
        self.assert_serves(gateway)

    def test_health_is_answered_without_token_and_tls_and_nothing_else_is(self):
        gateway = self.secured()
        place = gateway.address.split("/")[2]
        for path, good in (("health", True), ("metrics", False), ("", False)):
            asked = f"GET /{path} HTTP/1.1\r\nHost: {place}\r\n\r\n"
            self.assertEqual(b" 200 " in self.answer_to(self.raw(gateway), asked.encode()), good, path)

    def test_requests_with_bodies_and_behind_each_other_end_nothing_but_their_connection(self):
        gateway = Gateway(self, self.api)
        post = b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 10\r\n\r\n12345"
        chunked = b"POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n"
        get = f"GET / HTTP/1.1\r\nHost: {gateway.address.split('/')[2]}\r\n\r\n".encode()
        for first in (post, chunked, get, get[:-2] + b"Content-Length: 10\r\n\r\n"):
            for _ in range(100):
                connection = self.raw(gateway)
                connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                with contextlib.suppress(OSError):
                    for piece in (first, b"67890" + first, b"67890GET / HTTP/1.0\r\n\r\n", b"x" * 100, first * 20):
                        connection.sendall(piece)
                        time.sleep(0.002)
        self.assertEqual(self.answer_to(self.raw(gateway), get + get).count(b"HTTP/1.1 200"), 1)
        self.assertIn(b" 405 ", self.answer_to(self.raw(gateway), post).split(b"\r\n")[0])
        self.assert_serves(gateway)

    def test_who_says_a_byte_now_and_then_has_10_s_for_a_request(self):
        for gateway in (Gateway(self, self.api), self.secured()):
            slow = [self.raw(gateway) for _ in range(90)]
            begin = time.monotonic()
            words = b"GET / HTTP/1.1\r\nX: " if "https" not in gateway.address else b"\x16\x03\x01\x02\x00\x01\x00\x01"
            for i in range(200):
                for connection in slow[:]:
                    try:
                        connection.send(words[i : i + 1] or b"x")
                    except OSError:
                        slow.remove(connection)
                if not slow or time.monotonic() - begin > 20:
                    break
                time.sleep(0.1)
            self.assertEqual(len(slow), 0)
            self.assert_serves(gateway)

    def test_who_reads_the_page_slowly_is_closed_after_half_a_minute(self):
        page = self.folder / "page.html"
        page.write_bytes(b"x" * 20_000_000)
        gateway = Gateway(self, self.api, "--page", page)
        slow = self.enterContext(contextlib.closing(connected(gateway.address, receive_bytes=4096)[0]))
        slow.sendall(f"GET / HTTP/1.1\r\nHost: {gateway.address.split('/')[2]}\r\n\r\n".encode())
        begin = time.monotonic()
        while "refused slow from" not in gateway.log() and time.monotonic() - begin < 60:
            slow.recv(4096)
            time.sleep(0.1)
        self.assertLess(time.monotonic() - begin, 45)
        self.assert_serves(gateway)

    def test_places_that_are_all_taken_are_free_for_others_at_once(self):
        for gateway in (Gateway(self, self.api), self.secured()):
            idle = [self.raw(gateway) for _ in range(300)]  # as many handshakes that never end
            self.assert_serves(gateway)
            self.assertIn("refused too_many from 127.0.0.1", gateway.log())
            self.assertEqual(len(idle), 300)

    def test_a_flood_of_handshakes_keeps_nobody_out_and_its_lines_are_counted(self):
        gateway = self.secured()
        over = threading.Event()

        def flood():
            while not over.is_set():
                with contextlib.suppress(OSError), contextlib.closing(connected(gateway.address)[0]) as connection:
                    connection.sendall(b"GET /nothing HTTP/1.1\r\n\r\n" * 50)
                    connection.recv(1000)
                with contextlib.suppress(OSError), contextlib.closing(self.raw(gateway)) as connection:
                    connection.sendall(b"\x16\x03\x01\xff\xff" + b"\xff" * 3000)
                    connection.recv(1000)

        threads = [threading.Thread(target=flood) for _ in range(4)]
        for thread in threads:
            thread.start()
        try:
            for _ in range(10):
                self.assert_serves(gateway)
        finally:
            over.set()
            for thread in threads:
                thread.join()
        self.assertLess(len(gateway.log().splitlines()), 40)
        self.assertLess(len(gateway.log()), 10_000)

    def test_nothing_that_is_sent_is_unpacked(self):
        gateway = Gateway(self, self.api)
        deflate = "permessage-deflate; client_max_window_bits; server_no_context_takeover, x-webkit-deflate-frame"
        before_kB = gateway.resident_kB()
        packed = zlib.compressobj(9, zlib.DEFLATED, -15)
        bomb = packed.compress(bytes(80_000_000)) + packed.flush(zlib.Z_SYNC_FLUSH)[:-4]
        self.assertLess(len(bomb), 100_000)
        for kind in (0x40 | 1, 0x40 | 2, 0x20 | 1, 0x10 | 1):
            client = WebSocket(gateway.address, extensions=deflate)
            self.assertNotIn("extensions", client.head.lower())
            client.receive()
            with contextlib.closing(client), self.assertRaises(OSError):
                client.send(bomb, kind)
                while True:
                    client.receive()
        self.assertLess(gateway.resident_kB(), before_kB + 4096)
        self.assert_serves(gateway)


if __name__ == "__main__":
    unittest.main()
