"""MCAP files as https://mcap.dev/spec describes them: header, chunks, data end, a small summary, footer."""
import ctypes
import ctypes.util
import struct
import zlib

MAGIC = b"\x89MCAP0\r\n"


def text(value):
    encoded = value.encode()
    return struct.pack("<I", len(encoded)) + encoded


def record(opcode, content):
    return struct.pack("<BQ", opcode, len(content)) + content


def zstd(data):
    library = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
    library.ZSTD_compressBound.restype = library.ZSTD_compress.restype = ctypes.c_size_t
    room = library.ZSTD_compressBound(ctypes.c_size_t(len(data)))
    out = ctypes.create_string_buffer(room)
    size = library.ZSTD_compress(out, ctypes.c_size_t(room), data, ctypes.c_size_t(len(data)), 19)
    return out.raw[:size]


def lz4(data):
    library = ctypes.CDLL(ctypes.util.find_library("lz4") or "liblz4.so.1")
    library.LZ4F_compressFrameBound.restype = library.LZ4F_compressFrame.restype = ctypes.c_size_t
    room = library.LZ4F_compressFrameBound(ctypes.c_size_t(len(data)), None)
    out = ctypes.create_string_buffer(room)
    size = library.LZ4F_compressFrame(out, ctypes.c_size_t(room), data, ctypes.c_size_t(len(data)), None)
    return out.raw[:size]


COMPRESSED = {"": bytes, "zstd": zstd, "lz4": lz4}


def write(path, topics, messages, compression="", chunk_bytes=100_000, profile="ros2", encoding="cdr",
          schema_encoding="ros2msg"):
    """`topics`: {name: (type, definition)}; `messages`: (ns, topic, bytes) in order. `compression` None: no chunks."""
    ids = {topic: i + 1 for i, topic in enumerate(topics)}
    out = bytearray(MAGIC + record(1, text(profile) + text("tests/exchange/mcap.py")))
    described = b""
    for topic, (kind, definition) in topics.items():
        schema = definition.encode()
        described += record(3, struct.pack("<H", ids[topic]) + text(kind) + text(schema_encoding) +
                            struct.pack("<I", len(schema)) + schema)
        described += record(4, struct.pack("<HH", ids[topic], ids[topic]) + text(topic) + text(encoding) +
                            struct.pack("<I", 0))
    chunk, times, first = bytearray(), [], True

    def flush():
        nonlocal chunk, times
        if not chunk:
            return
        packed = COMPRESSED[compression](bytes(chunk))
        out.extend(record(6, struct.pack("<QQQI", min(times, default=0), max(times, default=0), len(chunk),
                                         zlib.crc32(bytes(chunk))) + text(compression) +
                          struct.pack("<Q", len(packed)) + packed))
        chunk, times = bytearray(), []

    target = out if compression is None else chunk
    target += described
    for number, (ns, topic, data) in enumerate(messages):
        message = record(5, struct.pack("<HIQQ", ids[topic], number, ns, ns) + data)
        if compression is None:
            out += message
            continue
        chunk += message
        times.append(ns)
        if len(chunk) > chunk_bytes:
            flush()
    if compression is not None:
        flush()
    out += record(15, struct.pack("<I", 0))
    start = len(out)
    out += described
    out += record(2, struct.pack("<QQI", start, 0, 0)) + MAGIC
    with open(path, "wb") as file:
        file.write(out)
