"""Tests of python/lanelight and of docs/examples: run by ctest as python/lanelight.

    lanelight_test.py PROGRAM

Images are written here independently of the program, and by it.
"""
import contextlib
import importlib.util
import io
import json
import os
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import warnings
import xml.etree.ElementTree
import zlib

if not importlib.util.find_spec("numpy"):
    print("no numpy (Debian: python3-numpy)")
    sys.exit(77)
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import lanelight

os.environ["LANELIGHT"] = sys.argv.pop(1)
SCENE = ROOT / "scenes" / "cornell-box.pbrt"
TEXT = """Film "rgb" "integer xresolution" 40 "integer yresolution" 30
Camera "perspective"
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Translate 0 0 4
Shape "sphere"
"""
# Renders too long, and says what Ctrl-C left.
STOPPED = """
import sys, lanelight
try:
    lanelight.render(sys.argv[1], spp="1M", progress=True,
                     output=sys.argv[2] if len(sys.argv) > 2 else None)
except lanelight.Interrupted as stop:
    print(stop.path, stop.image.rgb.shape, stop)
"""


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


def has(*modules):
    return all(importlib.util.find_spec(name) for name in modules)


def python(*arguments, path=ROOT / "python", **variables):
    return subprocess.run([sys.executable, *map(str, arguments)], capture_output=True,
                          text=True, check=False,
                          env={**os.environ, "PYTHONPATH": str(path), **variables})


class Folder(unittest.TestCase):
    """Each test has an empty folder, whose name has a space."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lanelight test ")
        self.addCleanup(folder.cleanup)
        self.at = pathlib.Path(folder.name)


class Reading(Folder):
    def test_written_values_are_read(self):
        rng = random.Random(2)
        width, height = 7, 37  # two blocks of lines and a rest
        channels = {n: [rng.uniform(0, 4) if n != "G" else 0.5 for _ in range(7 * 37)]
                    for n in ("B", "G", "R", "samples", "variance.R")}
        write_exr(self.at / "image.exr", width, height, channels)
        image = lanelight.read_exr(self.at / "image.exr")
        self.assertEqual((image.width, image.height, image.x0, image.y0), (7, 37, 3, 5))
        self.assertEqual(set(image.channels), set(channels))
        for name, values in channels.items():
            numpy.testing.assert_array_equal(
                image.channels[name], numpy.float32(values).reshape(height, width))
        numpy.testing.assert_array_equal(numpy.asarray(image)[..., 1], image.channels["G"])

    def test_other_files_are_refused_by_name(self):
        path = self.at / "no.exr"
        for data in b"P6 no image", b"\x76\x2f\x31\x01\x02\x00\x00\x00":
            path.write_bytes(data)
            with self.assertRaisesRegex(lanelight.FormatError, "no.exr"):
                lanelight.read_exr(path)
        for text, words in (('{"schema": 3}', "lanelight study"), ("?", "lanelight study"),
                            ('{"kind": "lanelight-study", "schema": 9}', "schema 9"),
                            ('{"kind": "profile"}', "`lanelight profile` wrote it")):
            path.write_text(text)
            with self.assertRaisesRegex(lanelight.FormatError, words):
                lanelight.read_study(path)

    def test_results_are_read(self):
        sweep = self.at / "sweep.toml"
        sweep.write_text(f'[grid]\nscene = ["{SCENE}"]\nspp = [1]\nresolution = ["9x9"]\n')
        lanelight.run("sweep", sweep, out=self.at / "sweep", quiet=True)
        read = lanelight.read_sweep(self.at / "sweep" / "sweep.json")
        self.assertEqual(len(read["cells"]), 1)
        path = self.at / "some.json"
        lanelight.run("profile", SCENE, spp=1, resolution="9x9", json=path, quiet=True)
        self.assertTrue(lanelight.read_profile(path)["rows"])
        path.write_text(json.dumps({"schema": 1, "program": "lanelight", "rows": []}))
        self.assertEqual(lanelight.read_bench(path)["rows"], [])


class Rendering(Folder):
    def test_image_has_what_the_report_says(self):
        image = lanelight.render(SCENE, spp=64, resolution="40x30", aov=True, profile=True,
                                 strategy="points=halton", seed=3, output=self.at / "a.exr")
        self.assertEqual(image.rgb.shape, (30, 40, 3))
        self.assertEqual(image.variance.shape, (30, 40, 3))
        self.assertLessEqual({"albedo.R", "depth.Z", "variance.B"}, set(image.channels))
        self.assertTrue((image.channels["samples"] == 64).all())
        stated = image.report["error"]["relmse"]
        for end, value in zip(("value", "low", "high"), image.error):
            self.assertAlmostEqual(value, stated[end] ** 0.5, places=6)
        # The plain mean is near the better estimate of the program.
        plain = (image.variance / (image.rgb ** 2 + 0.01)).mean() ** 0.5
        self.assertTrue(0.5 < plain / image.error.value < 2)
        self.assertEqual((image.settings["spp"], image.settings["seed"]), (64, "3"))
        self.assertIn("points=halton", image.settings["strategy"])
        self.assertGreater(image.profile["intersect_triangles"]["seconds"], 0)
        self.assertEqual(image.png[:4], b"\x89PNG")
        self.assertEqual([p.name for p in self.at.iterdir()], ["a.exr"])
        half = lanelight.render(SCENE, spp=64, resolution="40x30", depth="half",
                                strategy="points=halton", seed=3)
        numpy.testing.assert_allclose(half.rgb, image.rgb, rtol=1e-3, atol=1e-3)

    def test_texts_and_crops_are_rendered(self):
        image = lanelight.render(TEXT, spp=4, crop=(1, 2, 11, 12))
        self.assertEqual((image.x0, image.y0, image.rgb.shape), (1, 2, (10, 10, 3)))

    def test_errors_are_the_programs(self):
        for flags, code, words in (({"spb": 3}, 2, "--spb"), ({"spp": -1}, 2, "not an integer"),
                                   ({"program": "/no/lanelight"}, None, "cannot start"),
                                   ({"scene": "no scene.pbrt"}, 1, "no scene.pbrt"),
                                   ({"scene": TEXT + "Foo"}, 1, "scene.pbrt:7:1: error: ")):
            with self.assertRaisesRegex(lanelight.Error, words) as raised:
                lanelight.render(**{"scene": TEXT, "spp": 1, **flags})
            self.assertEqual(raised.exception.exit_code, code)
        with self.assertRaisesRegex(TypeError, "image.report"):
            lanelight.render(TEXT, json="report.json")

    def test_missed_targets_are_warnings(self):
        with self.assertWarnsRegex(UserWarning, "target was not reached"):
            image = lanelight.render(SCENE, resolution="40x30", spp=16, target="0.01%")
        self.assertEqual(image.settings["spp"], 16)

    def test_progress_is_shown_if_requested(self):
        for progress, words in (True, "100 %"), (False, ""), (None, ""):
            with contextlib.redirect_stderr(io.StringIO()) as shown:
                lanelight.render(SCENE, spp=16, resolution="40x30", progress=progress)
            self.assertEqual(bool(shown.getvalue()), bool(words))
            self.assertIn(words, shown.getvalue())

    def test_ctrl_c_leaves_the_image_so_far(self):
        for arguments in [str(self.at / "out.exr")], []:
            process = subprocess.Popen(
                [sys.executable, "-c", STOPPED, SCENE, *arguments], text=True,
                stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
            shown = ""
            while "samples/s" not in shown:
                shown += process.stderr.read(1)
                self.assertIsNone(process.poll(), shown)
            process.send_signal(signal.SIGINT)
            said, errors = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 0, errors)
            path = pathlib.Path(said[:said.index(".exr") + 4])
            if arguments:
                self.assertEqual(path.parent, self.at)
            else:
                self.addCleanup(shutil.rmtree, path.parent)
            self.assertIn(str(lanelight.read_exr(path).rgb.shape), said)
            self.assertIn("the image so far is", said)


class Uses(Folder):
    @unittest.skipUnless(has("matplotlib"), "no matplotlib")
    def test_the_example_draws(self):
        plot = self.at / "plot.svg"
        done = python(ROOT / "docs/examples/error_against_time.py", SCENE, plot)
        self.assertEqual(done.returncode, 0, done.stderr)
        for words in "independent points      16 spp", "intersect_triangles", "160x120":
            self.assertIn(words, done.stdout)
        drawn = xml.etree.ElementTree.parse(plot).getroot()
        self.assertEqual(drawn.tag, "{http://www.w3.org/2000/svg}svg")

    @unittest.skipUnless(has("matplotlib"), "no matplotlib")
    def test_studies_draw_themselves(self):
        lanelight.run("study", SCENE, out=self.at, resolution="16x12", spp=(1, 4),
                      repetitions=4, quiet=True, strategies="default;points=halton")
        study = lanelight.read_study(self.at / "study.json")
        plot = lanelight.plot.make(study, "samples")
        curves = plot.panels[0].series
        self.assertEqual(set(curves), {"default", "points=halton"})
        self.assertEqual([p.x for p in curves["default"][1]], [1, 4])
        self.assertIn("<svg", plot._repr_svg_())

    @unittest.skipUnless(has("pip", "setuptools", "wheel"), "no pip, setuptools or wheel")
    def test_pip_installs_the_package(self):
        shutil.copytree(ROOT / "python", self.at / "python")
        done = python("-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps",
                      "--target", self.at / "site", self.at / "python")
        self.assertEqual(done.returncode, 0, done.stderr)
        code = "import lanelight; print(lanelight.__file__, lanelight.run('--version'))"
        said = python("-c", code, path=self.at / "site").stdout
        installed = next((self.at / "site").glob("lanelight-*.dist-info")).stem
        self.assertIn(str(self.at / "site"), said)
        self.assertIn(installed.replace("-", " "), said)
        said = python("-c", code, path=self.at / "site", LANELIGHT="", PATH="/none").stderr
        self.assertIn("build it with `./run build`", said)


if __name__ == "__main__":
    warnings.simplefilter("error", ResourceWarning)
    unittest.main()
