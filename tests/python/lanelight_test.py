"""Tests of python/lanelight.py and of docs/examples: run by ctest as python/lanelight.

    lanelight_test.py PROGRAM

Images are written here independently of the program, and by it. Run with numpy where it is
installed, and without.
"""
import importlib.util
import math
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import lanelight

PROGRAM = sys.argv.pop(1)
HAS_NUMPY = lanelight.numpy is not None


def write_exr(path, width, height, channels):
    """An image as lanelight's: ZIP, float, channels {name: values} in alphabetical order."""
    def attribute(name, kind, value):
        return (name.encode() + b"\0" + kind.encode() + b"\0"
                + struct.pack("<i", len(value)) + value)
    names = sorted(channels)
    chlist = b"".join(n.encode() + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for n in names)
    header = (b"\x76\x2f\x31\x01" + struct.pack("<i", 2)
              + attribute("channels", "chlist", chlist + b"\0")
              + attribute("compression", "compression", b"\x03")
              + attribute("dataWindow", "box2i",
                          struct.pack("<4i", 3, 5, width + 2, height + 4)) + b"\0")
    blocks = []
    for first in range(0, height, 16):
        raw = b"".join(struct.pack(f"<{width}f", *channels[n][y * width:(y + 1) * width])
                       for y in range(first, min(first + 16, height)) for n in names)
        split = raw[0::2] + raw[1::2]
        coded = bytes([split[0]] + [(split[k] - split[k - 1] + 128) & 255
                                    for k in range(1, len(split))])
        packed = zlib.compress(coded)
        packed = packed if len(packed) < len(raw) else raw
        blocks.append(struct.pack("<ii", first + 5, len(packed)) + packed)
    at, table = len(header) + 8 * len(blocks), []
    for block in blocks:
        table.append(at)
        at += len(block)
    pathlib.Path(path).write_bytes(header + struct.pack(f"<{len(table)}Q", *table)
                                   + b"".join(blocks))


def run(*arguments):
    done = subprocess.run([PROGRAM, *arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


class Synthetic(unittest.TestCase):
    def test_what_is_written_is_read(self):
        rng = random.Random(2)
        width, height = 7, 37  # two blocks of lines and a rest
        channels = {n: [rng.uniform(0, 4) if n != "G" else 0.5 for _ in range(7 * 37)]
                    for n in ("B", "G", "R", "samples", "variance.R")}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "image.exr")
            write_exr(path, width, height, channels)
            image = lanelight.read_exr(path)
        self.assertEqual((image.width, image.height), (width, height))
        self.assertEqual((image.x0, image.y0), (3, 5))
        self.assertEqual(set(image.channels), set(channels))
        values = image.rgb()
        for c, name in enumerate("RGB"):
            for expected, found in zip(channels[name], values[c::3]):
                self.assertAlmostEqual(expected, found, places=6)

    def test_other_files_are_refused_by_name(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "no.exr"
            for data in b"P6 no image", b"\x76\x2f\x31\x01\x02\x00\x00\x00":
                path.write_bytes(data)
                with self.assertRaisesRegex(lanelight.FormatError, "no.exr"):
                    lanelight.read_exr(path)
            path.write_text('{"schema": 3}')
            with self.assertRaisesRegex(lanelight.FormatError, "lanelight study"):
                lanelight.read_study(path)


class Written(unittest.TestCase):
    """By the program."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.at = pathlib.Path(cls.folder.name)
        cls.scene = str(ROOT / "scenes" / "cornell-box.pbrt")
        run("render", cls.scene, "-o", str(cls.at / "out.exr"), "--resolution", "40x30",
            "--spp", "64", "--aov", "--quiet")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_images_have_their_channels_and_errors(self):
        image = lanelight.read_exr(self.at / "out.exr")
        self.assertEqual((image.width, image.height), (40, 30))
        self.assertLessEqual({"R", "albedo.R", "depth.Z", "samples", "variance.B"},
                             set(image.channels))
        self.assertEqual(set(image.channels["samples"]), {64.0})
        self.assertEqual(image.attributes["spp"], 64)
        self.assertRegex(image.attributes["strategy"], "points=sobol")
        # The plain mean is near the better estimate that the program states.
        stated = math.sqrt(image.attributes["relmse"])
        self.assertGreater(image.error(), stated / 2)
        self.assertLess(image.error(), stated * 2)

    def test_half_is_read_and_arrays_are_shaped(self):
        path = self.at / "half.exr"
        run("render", self.scene, "-o", str(path), "--resolution", "40x30", "--spp", "64",
            "--depth", "half", "--quiet")
        half, full = lanelight.read_exr(path), lanelight.read_exr(self.at / "out.exr")
        for a, b in zip(half.rgb(), full.rgb()):
            self.assertAlmostEqual(a, b, delta=1e-3 * max(1, b))
        if HAS_NUMPY:
            pixels = full.array("R", "G", "B")
            self.assertEqual(pixels.shape, (30, 40, 3))
            self.assertEqual(list(pixels.reshape(-1)), list(full.rgb()))

    def test_without_numpy_the_same_is_read(self):
        with_numpy = lanelight.read_exr(self.at / "out.exr").channels
        kept, lanelight.numpy = lanelight.numpy, None
        try:
            self.assertEqual(lanelight.read_exr(self.at / "out.exr").channels.keys(),
                             with_numpy.keys())
            plain = lanelight.read_exr(self.at / "out.exr")
            for name, values in plain.channels.items():
                self.assertEqual(values.tobytes(), with_numpy[name].tobytes())
            with self.assertRaisesRegex(RuntimeError, "python3-numpy"):
                plain.array("R")
        finally:
            lanelight.numpy = kept

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "no matplotlib")
    def test_the_example_draws_a_study(self):
        run("study", self.scene, "--out", str(self.at / "study"), "--resolution", "16x12",
            "--spp", "1,4", "--repetitions", "4", "--quiet", "--strategies",
            "default;points=halton")
        plot = self.at / "plot.svg"
        done = subprocess.run(
            [sys.executable, ROOT / "docs/examples/error_against_time.py",
             self.at / "study" / "study.json", self.at / "out.exr", plot],
            env={**os.environ, "PYTHONPATH": str(ROOT / "python")}, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("40x30 pixels, 64 samples each", done.stdout)
        rows = list(lanelight.errors(lanelight.read_study(self.at / "study/study.json")))
        self.assertEqual({(r.strategy, r.samples) for r in rows},
                         {(s, n) for s in ("default", "points=halton") for n in (1, 4)})
        for row in rows:
            self.assertIn(f"{row.strategy:<30}", done.stdout)
            self.assertGreater(row.error, 0)
        drawn = xml.etree.ElementTree.parse(plot).getroot()
        self.assertEqual(drawn.tag, "{http://www.w3.org/2000/svg}svg")


if __name__ == "__main__":
    unittest.main()
