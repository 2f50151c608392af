"""Reads OpenEXR images with all their channels and attributes.

The layout is that of "OpenEXR File Layout" (Academy Software Foundation): blocks of 1 or 16
lines, deflated. Before that, bytes were split into even and odd ones and replaced by
differences.
"""
import json
import math
import os
import pathlib
import struct
import typing
import zlib

import numpy

from .results import FormatError

# Lines of a block, by compression: none, ZIPS, ZIP.
LINES = {0: 1, 2: 1, 3: 16}
# Types of channels: unsigned integers of 32 bits, floats of 16 and of 32 bits.
TYPES = {0: "<u4", 1: "<f2", 2: "<f4"}
# Types of attributes that are numbers; others stay bytes.
NUMBERS = {"int": "<i", "float": "<f", "double": "<d", "box2i": "<4i", "v2i": "<2i",
           "v2f": "<2f", "chromaticities": "<8f"}


class Interval(typing.NamedTuple):
    """A value with its 95 % interval. NaN: unknown."""
    value: float
    low: float
    high: float

    def __str__(self) -> str:
        """Returns the numbers in percent."""
        if math.isnan(self.value):
            return "unknown"
        return f"{100 * self.value:.3g} % [{100 * self.low:.3g}, {100 * self.high:.3g}]"


class Image:
    """An image; numpy.asarray(image) returns its colours.

    channels: {name: array of height x width}; attributes: {name: value} of the header.
    x0, y0: position of the first pixel in the full image (crop).
    Images of render() also have `report`, its JSON report (docs/output.md); `profile`, the
    stages of the report by name, if requested; and `png`, the bytes of a PNG. Otherwise
    these are None.
    """
    report: dict | None = None
    profile: dict | None = None
    png: bytes | None = None

    def __init__(self, attributes: dict, x0: int, y0: int, channels: dict) -> None:
        self.attributes, self.x0, self.y0, self.channels = attributes, x0, y0, channels
        self.height, self.width = next(iter(channels.values())).shape

    def array(self, *names: str) -> numpy.ndarray:
        """Returns these channels: height x width x number of names."""
        return numpy.stack([self.channels[name] for name in names], axis=-1)

    @property
    def rgb(self) -> numpy.ndarray:
        """Colours: height x width x 3, linear."""
        return self.array("R", "G", "B")

    @property
    def variance(self) -> numpy.ndarray:
        """Variances of the pixels' means: height x width x 3; NaN where unknown."""
        unit = 2.0 ** self.attributes.get("varianceExponent", 0)
        return unit * self.array("variance.R", "variance.G", "variance.B").astype(float)

    @property
    def error(self) -> Interval:
        """Root of the relative MSE that the program estimates: 0.01 is 1 %."""
        ends = (self.attributes.get(k, math.nan) for k in ("relmse", "relmseLow", "relmseHigh"))
        return Interval(*(math.sqrt(max(end, 0)) for end in ends))

    @property
    def settings(self) -> dict:
        """Settings of the render, with seed, samples per pixel and strategy."""
        known = {k: self.attributes[k] for k in ("seed", "spp", "strategy", "version")
                 if k in self.attributes}
        return {**json.loads(self.attributes.get("settings", "{}")), **known}

    def __array__(self, dtype: typing.Any = None) -> numpy.ndarray:
        return self.rgb if dtype is None else self.rgb.astype(dtype)

    def __repr__(self) -> str:
        return (f"<lanelight.Image {self.width}x{self.height}, "
                f"{self.attributes.get('spp', math.nan):g} samples per pixel, "
                f"error {self.error}>")

    def _repr_png_(self) -> bytes | None:
        return self.png


def read_exr(path: str | os.PathLike) -> Image:
    """Returns the image in this file. Raises FormatError, with the file's name, for tiles,
    parts and compressions that Lanelight does not write, and for damaged files."""
    try:
        return _read(pathlib.Path(path).read_bytes())
    except (FormatError, struct.error, zlib.error, IndexError, KeyError, ValueError) as error:
        raise FormatError(f"{path}: {error}") from error


def _header(data: bytes) -> tuple[dict, int]:
    """Returns {name: value} of the header, and where it ends."""
    if data[:4] != b"\x76\x2f\x31\x01":
        raise FormatError("not an OpenEXR file")
    if struct.unpack_from("<I", data, 4)[0] & 0x1a00:
        raise FormatError("tiled, deep and multi-part images are not read")
    found, at = {}, 8
    while data[at]:
        end = data.index(b"\0", at)
        kind_end = data.index(b"\0", end + 1)
        size, = struct.unpack_from("<i", data, kind_end + 1)
        kind, value = data[end + 1:kind_end].decode(), data[kind_end + 5:kind_end + 5 + size]
        if kind == "string":
            value = value.decode(errors="replace")
        elif kind in NUMBERS:
            values = struct.unpack(NUMBERS[kind], value)
            value = values[0] if len(values) == 1 else values
        found[data[at:end].decode()] = value
        at = kind_end + 5 + size
    return found, at + 1


def _line_type(chlist: bytes, width: int) -> numpy.dtype:
    """Returns the type of a line: its channels one after the other."""
    fields, at = [], 0
    while chlist[at]:
        end = chlist.index(b"\0", at)
        kind, _, across, down = struct.unpack_from("<iiii", chlist, end + 1)
        if kind not in TYPES or (across, down) != (1, 1):
            raise FormatError("a channel of another type, or with fewer pixels")
        fields.append((chlist[at:end].decode(), TYPES[kind], (width,)))
        at = end + 17
    return numpy.dtype(fields)


def _inflated(block: bytes, size: int) -> bytes:
    """Returns the bytes of a block. A block that did not shrink is stored as it is."""
    if len(block) == size:
        return block
    raw = numpy.frombuffer(zlib.decompress(block), dtype=numpy.uint8).copy()
    raw[1:] -= 128
    raw = numpy.cumsum(raw, dtype=numpy.uint8)
    out = numpy.empty(size, dtype=numpy.uint8)
    half = (size + 1) // 2
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return out.tobytes()


def _read(data: bytes) -> Image:
    attributes, at = _header(data)
    lines_of_block = LINES.get(attributes["compression"][0])
    if lines_of_block is None:
        raise FormatError("neither ZIP nor uncompressed")
    x0, y0, x1, y1 = attributes["dataWindow"]
    line_type = _line_type(attributes["channels"], x1 - x0 + 1)
    height = y1 - y0 + 1
    lines = numpy.zeros(height, dtype=line_type)
    blocks = -(-height // lines_of_block)
    for offset in struct.unpack_from(f"<{blocks}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        count = min(lines_of_block, y1 + 1 - y)
        block = _inflated(data[offset + 8:offset + 8 + size], count * line_type.itemsize)
        lines[y - y0:y - y0 + count] = numpy.frombuffer(block, dtype=line_type)
    channels = {name: lines[name].astype(numpy.float32) for name in line_type.names}
    return Image(attributes, x0, y0, channels)
