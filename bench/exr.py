"""Reads the colours of images that lanelight has written: OpenEXR, ZIP, float channels.

The layout is that of "OpenEXR File Layout" (Academy Software Foundation): blocks of 16
lines, deflated; in them bytes were split into even and odd ones, then replaced by
differences.
"""
import array
import itertools
import pathlib
import struct
import sys
import zlib

ZIP = 3  # the compression of 16 lines at a time
FLOAT = 2


def attributes(data):
    """{name: bytes} of the header, and where the header ends."""
    if data[:4] != b"\x76\x2f\x31\x01":
        raise ValueError("not an OpenEXR file")
    found, at = {}, 8
    while data[at]:
        end = data.index(b"\0", at)
        name, at = data[at:end].decode(), data.index(b"\0", end + 1) + 1
        size = struct.unpack_from("<i", data, at)[0]
        found[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return found, at + 1


def channel_names(chlist):
    """Names in the order in which a line holds them; all must be float."""
    names, at = [], 0
    while chlist[at]:
        end = chlist.index(b"\0", at)
        kind, = struct.unpack_from("<i", chlist, end + 1)
        if kind != FLOAT:
            raise ValueError("channels are not float: render with --depth float")
        names.append(chlist[at:end].decode())
        at = end + 17
    return names


def inflated(block, size):
    """Bytes of a block: one that did not shrink is stored as it is."""
    if len(block) == size:
        return block
    raw = zlib.decompress(block)
    raw = bytes(itertools.accumulate(raw, lambda a, b: (a + b - 128) & 255))
    out = bytearray(size)
    half = (size + 1) // 2
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return bytes(out)


def read(path):
    """(width, height, values): values[3 * (y * width + x) + c], c = 0, 1, 2 for R, G, B."""
    data = pathlib.Path(path).read_bytes()
    header, at = attributes(data)
    if header["compression"][0] != ZIP:
        raise ValueError(f"{path}: compression is not ZIP")
    names = channel_names(header["channels"])
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    values = array.array("f", bytes(12 * width * height))
    line_bytes = 4 * width * len(names)
    blocks = (height + 15) // 16
    for offset in struct.unpack_from(f"<{blocks}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        lines = min(16, y1 + 1 - y)
        block = inflated(data[offset + 8:offset + 8 + size], lines * line_bytes)
        floats = array.array("f", block)
        if sys.byteorder == "big":
            floats.byteswap()
        for line in range(lines):
            first = 3 * width * (y - y0 + line)
            for c, name in enumerate("RGB"):
                start = (line * len(names) + names.index(name)) * width
                values[first + c:first + 3 * width:3] = floats[start:start + width]
    return width, height, values
