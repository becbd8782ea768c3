"""MCAP files (https://mcap.dev/spec): channels, schemas, metadata and messages, plain or in chunks, zstd or none.

Files of other programs can be read, too: content that is no JSON stays bytes. Whatever is wrong with a file is a
BadRecording. Checksums are not looked at: `liana replay` does that.
"""
from __future__ import annotations

import contextlib
import json
import pathlib
import struct
from typing import Any, Iterator, NamedTuple, Union

from liana.client import LianaError, Path

MAGIC = b"\x89MCAP0\r\n"
SCHEMA, CHANNEL, MESSAGE, CHUNK, METADATA, DATA_END = 0x03, 0x04, 0x05, 0x06, 0x0C, 0x0F
RECORD_HEAD_BYTES = 9  # operation code and length
MESSAGE_HEAD = struct.Struct("<HIQQ")  # channel, sequence, two times
MAX_CHUNK_BYTES = 1 << 30  # decompressed; writers make chunks of some MB

Bytes = Union[bytes, memoryview]


class BadRecording(LianaError):
    """A file that is no recording, or of a kind that cannot be read here; the text says which and why."""


# What parsing raises for content that is damaged, or of another kind than its name says.
DAMAGE = (
    struct.error,
    ValueError,
    LookupError,
    TypeError,
    AttributeError,
    ArithmeticError,
    RecursionError,
    MemoryError,
)


@contextlib.contextmanager
def reading(what: object) -> Iterator[None]:
    """Makes a BadRecording, which begins with `what`, of everything that is wrong with a file."""
    try:
        yield
    except BadRecording as error:
        if str(error).startswith(str(what)):
            raise
        raise BadRecording(f"{what}: {error}") from error
    except OSError as error:
        raise BadRecording(f"{what}: {error.strerror or error}: give a file that can be read") from error
    except DAMAGE as error:
        said = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        raise BadRecording(f"{what}: damaged, or of another kind ({said}): record it again") from error


def content_of(path: Path) -> bytes:
    """A file's bytes; BadRecording for what is no file, such as a pipe, which would never end."""
    with reading(path):
        if pathlib.Path(path).exists() and not pathlib.Path(path).is_file():
            raise BadRecording(f"{path}: is no file: give a recording")
        return pathlib.Path(path).read_bytes()


class Channel(NamedTuple):
    """One channel; `schema` is the schema's text, empty where it is none (protobuf), `schema_data` its bytes."""

    topic: str
    message_encoding: str
    schema_name: str
    schema_encoding: str
    schema: str
    schema_data: bytes


class Message(NamedTuple):
    """One message of a channel."""

    channel: Channel
    sequence: int  # as its writer counts; in Liana's recordings the tick
    log_time_ns: int  # nanoseconds; in Liana's recordings of arm time
    publish_time_ns: int  # nanoseconds
    data: memoryview  # in the channel's message_encoding

    def json(self) -> Any:
        """The content of a message of a JSON channel."""
        if self.channel.message_encoding != "json":
            raise BadRecording(f"channel {self.channel.topic} is {self.channel.message_encoding}, not json")
        with reading(f"channel {self.channel.topic}, message {self.sequence}"):
            return json.loads(bytes(self.data))


def unzstd(data: Bytes, size: int) -> bytes:
    """Decompressed zstd. Debian's Python has no module for it, but every Debian has the library: dpkg needs it."""
    import ctypes  # only here: it needs a library that a sealed guest (hil/vm) does not have

    try:
        library = ctypes.CDLL("libzstd.so.1")
    except OSError:
        raise BadRecording("a chunk is compressed with zstd: install libzstd1") from None
    library.ZSTD_decompress.restype = ctypes.c_size_t
    library.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    plain = ctypes.create_string_buffer(max(1, size))
    if library.ZSTD_decompress(plain, size, bytes(data), len(data)) != size:
        raise BadRecording(f"a chunk is not {size} bytes of zstd")
    return plain.raw[:size]


def decompressed(data: Bytes, compression: str, size: int) -> Bytes:
    """The one place that knows how chunks are compressed."""
    if compression == "":
        return data
    if compression == "zstd":
        return unzstd(data, size)
    raise BadRecording(f"a chunk is compressed with {compression}; read here are zstd and none")


def text_at(data: Bytes, at: int) -> tuple[str, int]:
    """A string with its length before it, and where it ends."""
    content, end = bytes_at(data, at)
    return content.decode(), end


def bytes_at(data: Bytes, at: int) -> tuple[bytes, int]:
    """Bytes with their count before them, and where they end."""
    end = at + 4 + struct.unpack_from("<I", data, at)[0]
    if end > len(data):
        raise BadRecording(
            f"{end - at - 4} bytes are announced where {len(data) - at - 4} are left: the file is damaged"
        )
    return bytes(data[at + 4 : end]), end


def records(data: Bytes, in_chunk: bool = False) -> Iterator[tuple[int, memoryview]]:
    """Operation code and content of each whole record; those of a chunk instead of the chunk."""
    view, at = memoryview(data), 0
    while at + RECORD_HEAD_BYTES <= len(view) and view[at : at + len(MAGIC)] != MAGIC:
        opcode, length = view[at], struct.unpack_from("<Q", view, at + 1)[0]
        content = view[at + RECORD_HEAD_BYTES : at + RECORD_HEAD_BYTES + length]
        if len(content) < length:
            return  # cut short
        if opcode == CHUNK and in_chunk:
            raise BadRecording("a chunk is inside a chunk, which MCAP does not allow: the file is damaged")
        if opcode == CHUNK:
            yield from records(chunk_content(content), in_chunk=True)
        else:
            yield opcode, content
        at += RECORD_HEAD_BYTES + length


def chunk_content(record: memoryview) -> Bytes:
    """Behind two times: size, checksum, compression, and the compressed records with their length."""
    size = struct.unpack_from("<Q", record, 16)[0]
    if size > MAX_CHUNK_BYTES:
        raise BadRecording(
            f"a chunk has {size} bytes: allowed {MAX_CHUNK_BYTES}: the file is damaged, or write smaller ones"
        )
    compression, at = text_at(record, 28)
    return decompressed(record[at + 8 : at + 8 + struct.unpack_from("<Q", record, at)[0]], compression, size)


def metadata_of(record: memoryview) -> tuple[str, dict[str, str]]:
    """Name and entries of a metadata record."""
    name, at = text_at(record, 0)
    end, values = at + 4 + struct.unpack_from("<I", record, at)[0], {}
    at += 4
    while at < end:
        key, at = text_at(record, at)
        values[key], at = text_at(record, at)
    return name, values


def text_or_none(data: bytes) -> str:
    """UTF-8 as text; empty for other bytes."""
    try:
        return data.decode()
    except UnicodeDecodeError:
        return ""


class Mcap:
    """A file in memory. `channels` by topic; `metadata` by name; `whole`: it has its end record."""

    def __init__(self, path: Path) -> None:
        """Reads the file and finds its messages; chunks are decompressed here."""
        self.path = path
        data = content_of(path)
        if data[: len(MAGIC)] != MAGIC:
            raise BadRecording(f"{path} is no MCAP file")
        self.channels: dict[str, Channel] = {}
        self.metadata: dict[str, dict[str, str]] = {}
        self.whole = False
        self._schemas: dict[int, tuple[str, str, bytes]] = {0: ("", "", b"")}
        self._by_id: dict[int, Channel] = {}
        self._messages: list[memoryview] = []
        with reading(path):
            for opcode, record in records(memoryview(data)[len(MAGIC) :]):
                self._take(opcode, record)

    def _take(self, opcode: int, record: memoryview) -> None:
        if opcode == MESSAGE:
            self._messages.append(record)
        elif opcode == SCHEMA:
            name, at = text_at(record, 2)
            encoding, at = text_at(record, at)
            self._schemas[struct.unpack_from("<H", record)[0]] = (name, encoding, bytes_at(record, at)[0])
        elif opcode == CHANNEL:
            self._keep_channel(record)
        elif opcode == METADATA:
            self.metadata.update([metadata_of(record)])
        elif opcode == DATA_END:
            self.whole = True

    def _keep_channel(self, record: memoryview) -> None:
        number, schema = struct.unpack_from("<HH", record)
        topic, at = text_at(record, 4)
        name, encoding, data = self._schemas[schema]
        channel = Channel(topic, text_at(record, at)[0], name, encoding, text_or_none(data), data)
        self.channels[topic] = self._by_id[number] = channel

    def messages(self, *topics: str) -> Iterator[Message]:
        """All messages in the file's order; with `topics` only those of these channels."""
        for record in self._messages:
            with reading(self.path):
                number, sequence, log_time_ns, publish_time_ns = MESSAGE_HEAD.unpack_from(record)
                channel = self._by_id[number]
            if not topics or channel.topic in topics:
                yield Message(channel, sequence, log_time_ns, publish_time_ns, record[MESSAGE_HEAD.size :])
