#!/usr/bin/env python3
"""Draws the synthetic study and a made-up bench: plot_test.py REPORT.html LANELIGHT

Reads the SVG files as XML, and looks whether markers lie where the numbers are on the axes
that the ticks say. Standard library only.
"""

import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

REPORT, LANELIGHT = sys.argv[1:]
FOLDER = pathlib.Path(tempfile.mkdtemp())
NS = "{http://www.w3.org/2000/svg}"


def require(condition, *what):
    if not condition:
        raise SystemExit(" ".join(str(part) for part in what))


def run(*arguments, good=True, **options):
    done = subprocess.run([LANELIGHT, "plot", *map(str, arguments)], capture_output=True,
                          text=True, check=False, **options)
    require((done.returncode == 0) == good, arguments, done.returncode, done.stderr)
    return done.stdout + done.stderr


def write_study():
    page = pathlib.Path(REPORT).read_text(encoding="utf-8")
    text = re.search(r'id="study">(.*?)</script>', page, re.S)[1]
    (FOLDER / "study.json").write_text(text, encoding="utf-8")
    return json.loads(text)


def place_of(root, kind, coordinate, log):
    """Pixels of a value, by the two outermost ticks."""
    ticks = [(float(t.get("data-value")), float(t.get(coordinate)))
             for t in root.iter(f"{NS}text") if t.get("class") == kind]
    require(len(ticks) >= 2, "too few ticks", kind, ticks)
    f = math.log if log else float
    (v0, p0), (v1, p1) = min(ticks), max(ticks)
    return lambda v: p0 + (f(v) - f(v0)) / (f(v1) - f(v0)) * (p1 - p0)


def points(root):
    for path in root.iter(f"{NS}path"):
        if path.get("class") != "point":
            continue
        x, y = map(float, re.findall(r"[-\d.]+", path.get("transform")))
        yield path.get("data-series"), float(path.get("data-x")), \
            float(path.get("data-y")), x, y


def bars(root):
    return [{name: float(line.get(name)) for name in ("x1", "y1", "x2", "y2")}
            for line in root.iter(f"{NS}line") if line.get("class") == "bar"]


def draw(figure, *arguments):
    out = FOLDER / f"{figure}.svg"
    run(FOLDER / "study.json", "--figure", figure, "-o", out, *arguments)
    return xml.parse(out).getroot()


def check_curves(scene, figure, error, time):
    root = draw(figure, "--scene", scene["name"])
    x_at = place_of(root, "tick-x", "x", True)
    y_at = place_of(root, "tick-y", "y", True)
    wanted = {}
    for s in scene["strategies"]:
        for level in s["levels"]:
            x = level["cpu_seconds"]["value"] if time else level["spp"]
            wanted[s["name"], x] = level[error]
    drawn = list(points(root))
    require(len({name for name, *_ in drawn}) == 6, "curves of", {d[0] for d in drawn})
    for name, x, y, px, py in drawn:
        require(wanted[name, x]["value"] == y, figure, name, x, y)
        # Texts are four pixels lower than their ticks.
        require(abs(px - x_at(x)) < 0.1 and abs(py - (y_at(y) - 4)) < 0.1, figure, name, x,
                y, px, py)
    require(len(bars(root)) == len(drawn), len(bars(root)), "error bars of", len(drawn))
    for bar, (name, x, *_) in zip(bars(root), drawn):
        for end, place in ("low", bar["y1"]), ("high", bar["y2"]):
            at = y_at(wanted[name, x][end]) - 4
            require(abs(place - at) < 0.1, figure, name, x, end, place, at)
    text = " ".join(t.text for t in root.iter(f"{NS}text"))
    require(scene["name"] in text and "intervals" in text, "no title or source:", text)


def check_rows(scene):
    root = draw("efficiency", "--scene", scene["name"])
    x_at = place_of(root, "tick-x", "x", True)
    order = [scene["strategies"][i] for i in scene["ranking"]]
    drawn = list(points(root))
    require([d[0] for d in drawn] == [s["name"] for s in order], "not the ranking", drawn)
    for s, (_, _, value, px, _) in zip(order, drawn):
        require(value == s["efficiency"]["value"], s["name"], value)
        require(abs(px - x_at(value)) < 0.1, s["name"], px, x_at(value))
    with_bars = [s["efficiency"] for s in order if s["efficiency"]["low"] is not None]
    require(len(bars(root)) == len(with_bars), len(bars(root)), len(with_bars))
    for bar, efficiency in zip(bars(root), with_bars):
        for end, place in ("low", bar["x1"]), ("high", bar["x2"]):
            require(abs(place - x_at(efficiency[end])) < 0.1, end, place, efficiency)


def check_figure_8(scene):
    root = draw("8", "--scene", scene["name"])
    slopes = [s["order"]["value"] for s in scene["strategies"] if s["order"]]
    texts = [t.text for t in root.iter(f"{NS}text")]
    require("slope" in texts and "RMSE" in texts, texts)
    found = {d[2] for d in points(root)}
    require(found & set(slopes), "no slopes beside the curves")
    run(FOLDER / "study.json", "--figure", "8", "--scene", scene["name"], "-o",
        FOLDER / "8.csv")
    rows = list(csv.DictReader((FOLDER / "8.csv").open(encoding="utf-8")))
    require({float(r["value"]) for r in rows} == found, "CSV and SVG differ")
    require({r["quantity"] for r in rows} == {"RMSE", "slope"}, rows[0])


def check_bench():
    rate = {"value": 2e6, "low": 1.9e6, "high": 2.2e6}
    row = {"scene": "a<b & \"c\"", "target": "AVX2", "threads": 1, "samples_per_second": rate}
    bench = {"schema": 1, "program": "lanelight", "confidence": 0.95,
             "machine": {"text": "none"}, "rows": [row, {**row, "threads": 2}]}
    file, out = FOLDER / "bench.json", FOLDER / "rate.svg"
    file.write_text(json.dumps(bench))
    run(file, "--figure", "rate", "-o", out)
    names = [d[0] for d in points(xml.parse(out).getroot())]
    require(names == ['a<b & "c", AVX2, 1 thread', 'a<b & "c", AVX2, 2 threads'], names)


def check_sweep():
    axis = {"parameter": False, "numeric": True, "unset": False}
    axes = [{**axis, "name": "scene", "numeric": False, "values": ["room"]},
            {**axis, "name": "strategy", "numeric": False, "values": ["default", "q"]},
            {**axis, "name": "roulette", "parameter": True, "unset": True,
             "values": ["0.1", "0.5"]},
            {**axis, "name": "spp", "values": ["16", "4"]}]
    groups, cells = [], []
    for strategy, part in ("default", None), ("q", "0.1"), ("q", "0.5"):
        for spp in 16, 4:
            values = {"scene": "room", "strategy": strategy, "spp": str(spp)}
            if part:
                values["roulette"] = part
            error = float(part or 1) / spp
            cells.append({"measured": {
                "relmse": error, "relmse_low": error / 2, "relmse_high": None,
                "cpu_seconds": spp / 10, "samples_per_second": 1e6}})
            groups.append({"values": values, "cells": [len(cells) - 1],
                           "strategy": strategy + (f":{part}" if part else ""),
                           "efficiency": {"value": 1 / float(part), "low": 1, "high": 99}
                           if part else None})
    sweep = {"schema": 2, "kind": "lanelight-sweep", "file": "s.toml", "axes": axes,
             "seeds": 1, "baseline": "default", "machines": [], "groups": groups,
             "cells": cells}
    file, out = FOLDER / "sweep.json", FOLDER / "sweep.svg"
    file.write_text(json.dumps(sweep))
    listed = [line.split()[0] for line in run(file, "--list").splitlines()]
    require(listed == ["samples", "time", "efficiency", "rate", "roulette"], listed)
    wanted = {
        "samples": [("default", 4, .25), ("default", 16, .0625),
                    ("q:0.1", 4, .025), ("q:0.1", 16, .00625),
                    ("q:0.5", 4, .125), ("q:0.5", 16, .03125)],
        "time": [("default", .4, .25), ("default", 1.6, .0625),
                 ("q:0.1", .4, .025), ("q:0.1", 1.6, .00625),
                 ("q:0.5", .4, .125), ("q:0.5", 1.6, .03125)],
        "roulette": [("q, spp 16", .1, 10), ("q, spp 16", .5, 2),
                     ("q, spp 4", .1, 10), ("q, spp 4", .5, 2)]}
    for figure, expected in wanted.items():
        run(file, "--figure", figure, "-o", out)
        root = xml.parse(out).getroot()
        require([d[:3] for d in points(root)] == expected, figure, list(points(root)))
        # Bars go as far as both ends are known.
        require(bool(bars(root)) == (figure == "roulette"), figure, bars(root))
    for figure, rows in ("efficiency", 4), ("rate", 6):
        run(file, "--figure", figure, "-o", out)
        require(len(list(points(xml.parse(out).getroot()))) == rows, figure)
    said = run(file, "--figure", "nothing", "-o", out, good=False)
    require('unknown figure "nothing"' in said, said)
    file.write_text(json.dumps({**sweep, "axes": [1]}))
    require("damaged" in run(file, "--list", good=False), "a damaged sweep is drawn")


def check_errors(scene):
    file, out = FOLDER / "study.json", FOLDER / "none.svg"
    one = ("--scene", scene["name"])
    for arguments, words in (
            ((file, "--figure", "9", "-o", out, *one), 'unknown figure "9"'),
            ((file, "--figure", "4", "-o", out, *one), "is a picture"),
            ((file, "--figure", "8", "-o", out), "choose one by --scene"),
            ((file, "--figure", "8", "-o", out, "--scene", "no"), 'unknown scene "no"'),
            ((file, "--figure", "8", "-o", FOLDER / "x.pdf", *one), ".svg, .png or .csv"),
            ((file, "--figure", "8", "-o", FOLDER / "no" / "x.svg", *one), "no/x.svg"),
            ((FOLDER / "no.json", "--figure", "8", "-o", out), "cannot read"),
            ((FOLDER / "8.csv", "--figure", "8", "-o", out), "not JSON"),
            ((file,), "--list")):
        said = run(*arguments, good=False)
        require(words in said, arguments, "says", said)
    foreign = FOLDER / "foreign.json"
    for text, words in (("{}", "is not what can be drawn"), ("[1]", "is not what can be"),
                        ('{"kind": "lanelight-study", "schema": 2}', "has schema 2"),
                        ('{"kind": "lanelight-study", "schema": 1}', "damaged")):
        foreign.write_text(text)
        said = run(foreign, "--figure", "8", "-o", out, good=False)
        require(words in said, text, "says", said)
    require(not out.exists(), "an error left a file")


def check_png(scene):
    file, out = FOLDER / "study.json", FOLDER / "8.png"
    arguments = (file, "--figure", "8", "-o", out, "--scene", scene["name"])
    said = run(*arguments, good=False, env={"PATH": "/nowhere"})
    require("librsvg2-bin" in said and not out.exists(), said)
    if shutil.which("rsvg-convert"):
        run(*arguments)
        require(out.read_bytes()[:4] == b"\x89PNG", "no PNG")


def main():
    study = write_study()
    scene = study["scenes"][0]
    require("efficiency" in run(FOLDER / "study.json", "--list"), "not listed")
    check_curves(scene, "samples", "relmse", False)
    check_curves(scene, "time", "relmse", True)
    check_rows(scene)
    check_figure_8(scene)
    check_bench()
    check_sweep()
    check_errors(scene)
    check_png(scene)
    shutil.rmtree(FOLDER)


main()
