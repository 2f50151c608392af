"""Reads what Lanelight writes: OpenEXR images with all their channels, and studies.

Nothing but Python 3 is needed. Where numpy is installed, images are read faster, and
Exr.array() gives numpy arrays.

    import lanelight
    image = lanelight.read_exr("out.exr")
    print(image.width, image.height, image.attributes["spp"], image.error())
    colours = image.array("R", "G", "B")                   # height x width x 3, with numpy
    for row in lanelight.errors(lanelight.read_study("study/study.json")):
        print(row.scene, row.strategy, row.samples, row.seconds, row.error)

The layout of images is that of "OpenEXR File Layout" (Academy Software Foundation): blocks
of 1 or 16 lines, deflated; in them bytes were split into even and odd ones, then replaced by
differences.
"""
import array
import itertools
import json
import math
import pathlib
import struct
import sys
import typing
import zlib

try:
    import numpy
except ImportError:
    numpy = None

# Compressions, and the lines of a block of each.
NONE, ZIPS, ZIP = 0, 2, 3
LINES = {NONE: 1, ZIPS: 1, ZIP: 16}
# Types of channels: unsigned integers of 32 bits, floats of 16 and of 32.
UINT, HALF, FLOAT = 0, 1, 2
BYTES = {UINT: 4, HALF: 2, FLOAT: 4}

EPSILON = 0.01  # added to squares of means in relative errors, as Lanelight does
STUDY_KIND = "lanelight-study"


class FormatError(ValueError):
    """A file that is not what it should be, or has what this module does not read."""


class Exr:
    """An image.

    width, height: pixels; x0, y0: where they begin in the full image (render --crop).
    channels: {name: array.array("f")}, values row by row from the top.
    attributes: {name: value} of the header: numbers, texts, or bytes of other types.
    """

    def __init__(self, attributes, window, channels):
        self.attributes, self.channels = attributes, channels
        self.x0, self.y0 = window[:2]
        self.width, self.height = window[2] + 1 - window[0], window[3] + 1 - window[1]

    def array(self, *names):
        """These channels as a numpy array: height x width x number of names. Needs numpy."""
        if numpy is None:
            raise RuntimeError("array() needs numpy (Debian: python3-numpy)")
        planes = [numpy.frombuffer(self.channels[n], dtype=numpy.float32) for n in names]
        return numpy.stack(planes, axis=-1).reshape(self.height, self.width, len(names))

    def rgb(self):
        """Colours as one array.array: values[3 * (y * width + x) + c], c = 0, 1, 2."""
        values = array.array("f", bytes(12 * self.width * self.height))
        for c, name in enumerate("RGB"):
            values[c::3] = self.channels[name]
        return values

    def variance(self, channel):
        """Variances of a channel's pixel means, a list; NaN where they are not known."""
        unit = 2.0 ** self.attributes.get("varianceExponent", 0)
        return [unit * v for v in self.channels["variance." + channel]]

    def error(self):
        """The root of the relative MSE against the converged image, as the variances tell
        it: the mean of variance / (mean^2 + 0.01) over pixels and colours. 0.01 is 1 %.
        The attribute `relmse` is a better estimate, with its interval (docs/output.md)."""
        terms = [v / (m * m + EPSILON) for c in "RGB"
                 for m, v in zip(self.channels[c], self.variance(c)) if v == v]
        if not terms:
            raise FormatError("no pixel has a variance: it takes two observations")
        return math.sqrt(sum(terms) / len(terms))


def _attribute(kind, raw):
    """The value of a header's attribute."""
    if kind == "string":
        return raw.decode(errors="replace")
    known = {"int": "<i", "float": "<f", "double": "<d", "box2i": "<4i", "v2i": "<2i",
             "v2f": "<2f", "chromaticities": "<8f"}.get(kind)
    if known is None:
        return raw
    values = struct.unpack(known, raw)
    return values[0] if len(values) == 1 else values


def _header(data):
    """{name: value} of the header, and where it ends."""
    if data[:4] != b"\x76\x2f\x31\x01":
        raise FormatError("not an OpenEXR file")
    version, = struct.unpack_from("<I", data, 4)
    if version & 0x1a00:
        raise FormatError("tiled, deep and multi-part images are not read")
    found, at = {}, 8
    while data[at]:
        end = data.index(b"\0", at)
        kind_end = data.index(b"\0", end + 1)
        size, = struct.unpack_from("<i", data, kind_end + 1)
        raw = data[kind_end + 5:kind_end + 5 + size]
        found[data[at:end].decode()] = _attribute(data[end + 1:kind_end].decode(), raw)
        at = kind_end + 5 + size
    return found, at + 1


def _channel_list(chlist):
    """[(name, type)] in the order in which a line holds them."""
    channels, at = [], 0
    while chlist[at]:
        end = chlist.index(b"\0", at)
        kind, _, across, down = struct.unpack_from("<iiii", chlist, end + 1)
        if kind not in BYTES or (across, down) != (1, 1):
            raise FormatError("a channel of another type, or with fewer pixels")
        channels.append((chlist[at:end].decode(), kind))
        at = end + 17
    return channels


def _inflated(block, size):
    """Bytes of a block: one that did not shrink is stored as it is."""
    if len(block) == size:
        return block
    raw = zlib.decompress(block)
    if numpy is not None:
        steps = numpy.frombuffer(raw, dtype=numpy.uint8).copy()
        steps[1:] -= 128
        raw = numpy.cumsum(steps, dtype=numpy.uint8).tobytes()
    else:
        raw = bytes(itertools.accumulate(raw, lambda a, b: (a + b - 128) & 255))
    out = bytearray(size)
    half = (size + 1) // 2
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return bytes(out)


def _floats(raw, kind):
    """Values of a line of one channel."""
    if kind == FLOAT:
        values = array.array("f", raw)
        if sys.byteorder == "big":
            values.byteswap()
        return values
    return array.array("f", struct.unpack(
        f"<{len(raw) // BYTES[kind]}{'e' if kind == HALF else 'I'}", raw))


def read_exr(path):
    """The image in this file, an Exr. FormatError, with the file's name, for what is no such
    image or has what Lanelight does not write: tiles, parts, other compressions."""
    try:
        return _read_exr(pathlib.Path(path).read_bytes())
    except (FormatError, struct.error, zlib.error, IndexError, KeyError) as error:
        raise FormatError(f"{path}: {error}") from error


def _read_exr(data):
    attributes, at = _header(data)
    compression = attributes["compression"][0]
    if compression not in LINES:
        raise FormatError("neither ZIP nor uncompressed")
    listed = _channel_list(attributes["channels"])
    x0, y0, x1, y1 = attributes["dataWindow"]
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channels = {name: array.array("f", bytes(4 * width * height)) for name, _ in listed}
    line_bytes = width * sum(BYTES[kind] for _, kind in listed)
    lines = LINES[compression]
    blocks = (height + lines - 1) // lines
    for offset in struct.unpack_from(f"<{blocks}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        count = min(lines, y1 + 1 - y)
        block = _inflated(data[offset + 8:offset + 8 + size], count * line_bytes)
        start = 0
        for line in range(count):
            first = (y - y0 + line) * width
            for name, kind in listed:
                end = start + width * BYTES[kind]
                channels[name][first:first + width] = _floats(block[start:end], kind)
                start = end
    return Exr(attributes, (x0, y0, x1, y1), channels)


def read_study(path):
    """study.json as dictionaries and lists (docs/study.md). FormatError for another file."""
    study = json.loads(pathlib.Path(path).read_text())
    if not isinstance(study, dict) or study.get("kind") != STUDY_KIND:
        raise FormatError(f"{path}: not the study.json of `lanelight study`")
    return study


class ErrorRow(typing.NamedTuple):
    """What a strategy reached. Errors are roots of relative MSEs, 0.01 is 1 %."""
    scene: str
    strategy: str
    samples: int      # per pixel
    seconds: float    # processor time of a render
    error: float
    low: float        # interval of the error, at the study's confidence;
    high: float       # NaN: an end that is not known


def errors(study):
    """An ErrorRow for each scene, strategy and number of samples that was measured."""
    for scene in study["scenes"]:
        for strategy in scene.get("strategies", []):
            for level in strategy["levels"]:
                relmse = level["relmse"]
                ends = [math.nan if relmse[k] is None else math.sqrt(max(relmse[k], 0))
                        for k in ("value", "low", "high")]
                yield ErrorRow(scene["name"], strategy["name"], level["spp"],
                               level["cpu_seconds"]["value"], *ends)
