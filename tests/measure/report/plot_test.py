#!/usr/bin/env python3
"""Draws the synthetic study, a bench and a sweep: plot_test.py REPORT.html LANELIGHT

Compares what the figures of python/lanelight hold with the numbers of the JSON.
"""

import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

try:
    import matplotlib  # which needs numpy
except ImportError:
    print("no matplotlib")
    sys.exit(77)

REPORT, LANELIGHT = sys.argv[1:]
ROOT = pathlib.Path(__file__).resolve().parents[3]
FOLDER = pathlib.Path(tempfile.mkdtemp())
sys.path.insert(0, str(ROOT / "python"))
from lanelight import draw, plot as plots


def require(condition, *what):
    if not condition:
        raise SystemExit(" ".join(str(part) for part in what))


def run(*arguments, good=True, **variables):
    done = subprocess.run([LANELIGHT, "plot", *map(str, arguments)], capture_output=True,
                          text=True, check=False, env={**os.environ, **variables})
    require((done.returncode == 0) == good, arguments, done.returncode, done.stderr)
    return done.stdout + done.stderr


def write_study():
    page = pathlib.Path(REPORT).read_text(encoding="utf-8")
    text = re.search(r'id="study">(.*?)</script>', page, re.S)[1]
    (FOLDER / "study.json").write_text(text, encoding="utf-8")
    return json.loads(text)


def drawn(plot, panel=0):
    """Markers (series, x, y) and ends of intervals that matplotlib has, as lists."""
    axes = plots.draw(plot).axes[panel]
    names, rows = list(plot.panels[panel].series), not plot.panels[panel].x
    lines = [line for line in axes.get_lines() if line.get_marker() in list("os^Dv")]
    points = [(names[int(y)] if rows else line.get_label(), float(x), float(y))
              for line in lines for x, y in zip(line.get_xdata(), line.get_ydata())]
    ends = [tuple(segment[:, 0 if rows else 1]) for bars in axes.collections
            for segment in bars.get_segments()]
    return points, ends


def check_curves(study, scene, figure, error, time):
    wanted = {}
    for s in scene["strategies"]:
        for level in s["levels"]:
            x = level["cpu_seconds"]["value"] if time else level["spp"]
            wanted[s["name"], x] = level[error]
    plot = plots.make(study, figure, scene["name"])
    points, ends = drawn(plot)
    require(len({name for name, *_ in points}) == 6, "curves of", {p[0] for p in points})
    require(len(ends) == len(points), len(ends), "intervals of", len(points))
    for (name, x, y), (low, high) in zip(points, ends):
        interval = wanted[name, x]
        require((interval["value"], interval["low"], interval["high"]) == (y, low, high),
                figure, name, x, y, low, high)
    require(scene["name"] in plot.title and "intervals" in plot.source, plot)


def check_rows(study, scene):
    points, ends = drawn(plots.make(study, "efficiency", scene["name"]))
    order = [scene["strategies"][i] for i in scene["ranking"]]
    require([(p[0], p[1]) for p in points]
            == [(s["name"], s["efficiency"]["value"]) for s in order], "not the ranking", points)
    require(ends == [(e["low"], e["high"]) for e in (s["efficiency"] for s in order)
                     if e["low"] is not None], "intervals", ends)


def check_figure_8(study, scene):
    plot = plots.make(study, "8", scene["name"])
    slopes = {s["order"]["value"] for s in scene["strategies"] if s["order"]}
    require({x for _, x, _ in drawn(plot, 1)[0]} & slopes, "no slopes beside the curves")
    run(FOLDER / "study.json", "--figure", "8", "--scene", scene["name"], "-o",
        FOLDER / "8.csv")
    rows = list(csv.DictReader((FOLDER / "8.csv").open(encoding="utf-8")))
    found = {p.value for panel in plot.panels for _, s in panel.series.values() for p in s}
    require({float(r["value"]) for r in rows} == found, "CSV and plot differ")
    require({r["quantity"] for r in rows} == {"RMSE", "slope"}, rows[0])


def check_bench():
    rate = {"value": 2e6, "low": 1.9e6, "high": 2.2e6}
    row = {"scene": "a<b & \"$c$\"", "target": "AVX2", "threads": 1, "samples_per_second": rate}
    bench = {"schema": 1, "program": "lanelight", "confidence": 0.95,
             "machine": {"text": "none"}, "rows": [row, {**row, "threads": 2}]}
    file, out = FOLDER / "bench.json", FOLDER / "rate.svg"
    file.write_text(json.dumps(bench))
    run(file, "--figure", "rate", "-o", out)
    texts = [t.text for t in xml.parse(out).getroot().iter("{http://www.w3.org/2000/svg}text")]
    for name in ('a<b & "$c$", AVX2, 1 thread', 'a<b & "$c$", AVX2, 2 threads', "Throughput",
                 "2×10⁶", "95 % intervals of the median; lanelight; none"):
        require(name in texts, name, "is not in", texts)
    before = out.read_bytes()
    run(file, "--figure", "rate", "-o", out)
    require(out.read_bytes() == before, "two drawings of the same differ")


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
        points, ends = drawn(plots.make(sweep, figure))
        require(points == expected, figure, points)
        # Intervals are drawn where both ends are known.
        require(bool(ends) == (figure == "roulette"), figure, ends)
    for figure, rows in ("efficiency", 4), ("rate", 6):
        require(len(drawn(plots.make(sweep, figure))[0]) == rows, figure)
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


def check_programs(scene):
    file, out = FOLDER / "study.json", FOLDER / "8.png"
    arguments = (file, "--figure", "8", "--scene", scene["name"], "-o")
    said = run(*arguments, out, good=False, PATH="/nowhere")
    require("install python3-matplotlib" in said and not out.exists(), said)
    without = FOLDER / "without"
    without.mkdir()
    (without / "matplotlib.py").write_text("raise ImportError('not here')")
    said = run(*arguments, out, good=False, PYTHONPATH=str(without))
    require("install python3-matplotlib" in said and not out.exists(), said)
    run(*arguments, FOLDER / "without.csv", PYTHONPATH=str(without))
    run(*arguments, out)
    require(out.read_bytes()[:4] == b"\x89PNG", "no PNG")


def check_colors():
    style = (ROOT / "src/measure/report/page/base.css").read_text(encoding="utf-8").split("}")[0]
    pages = re.findall(r"--c\d: (#[0-9a-f]{6});", style)
    require(pages == draw.COLORS, pages, "in pages,", draw.COLORS)


def main():
    study = write_study()
    scene = study["scenes"][0]
    require("efficiency" in run(FOLDER / "study.json", "--list"), "not listed")
    check_curves(study, scene, "samples", "relmse", False)
    check_curves(study, scene, "time", "relmse", True)
    check_rows(study, scene)
    check_figure_8(study, scene)
    check_bench()
    check_sweep()
    check_errors(scene)
    check_programs(scene)
    check_colors()
    shutil.rmtree(FOLDER)


main()
