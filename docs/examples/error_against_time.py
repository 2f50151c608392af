#!/usr/bin/env python3
"""Draws the errors of a study against time, and says what an image knows of its own.

    lanelight study scene.pbrt --out study --spp 1,4,16,64
    lanelight render scene.pbrt -o out.exr --spp 64
    PYTHONPATH=python docs/examples/error_against_time.py study/study.json out.exr plot.svg

Nothing but Python 3 is needed; the plot is SVG, which any browser shows.
"""
import collections
import math
import sys
from xml.sax.saxutils import escape

import lanelight

WIDTH, HEIGHT, LEFT, BOTTOM, RIGHT, TOP = 720, 440, 70, 50, 210, 30
COLOURS = ["#4269d0", "#efb118", "#ff725c", "#6cc5b0", "#3ca951", "#ff8ab7", "#a463f2",
           "#97bbf5", "#9c6b4e", "#9498a0"]


def log_axis(values, low, high):
    """A function from values to pixels, and the powers of ten to label."""
    first, last = math.log10(min(values)), math.log10(max(values))
    first, last = first - 0.05, last + 0.05
    scale = (high - low) / (last - first)
    return (lambda v: low + scale * (math.log10(v) - first),
            [10.0 ** k for k in range(math.ceil(first), math.floor(last) + 1)])


def line(x1, y1, x2, y2, colour, extra=""):
    return (f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" '
            f'stroke="{colour}" {extra}/>')


def text(x, y, words, anchor="start"):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(words)}</text>'


def plot(rows):
    """One scene: error against processor time, a line for each strategy, with intervals."""
    seconds = [r.seconds for r in rows]
    known = [e for r in rows for e in (r.error, r.low, r.high) if e > 0]
    across, ticks_across = log_axis(seconds, LEFT, WIDTH - RIGHT)
    up, ticks_up = log_axis(known, HEIGHT - BOTTOM, TOP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
             'font-family="sans-serif" font-size="12" fill="#333">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
             text(LEFT, 18, f"{rows[0].scene}: error against time"),
             text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, "processor time (s)", "middle")]
    for tick in ticks_across:
        parts += [line(across(tick), HEIGHT - BOTTOM, across(tick), TOP, "#ddd"),
                  text(across(tick), HEIGHT - BOTTOM + 16, f"{tick:g}", "middle")]
    for tick in ticks_up:
        parts += [line(LEFT, up(tick), WIDTH - RIGHT, up(tick), "#ddd"),
                  text(LEFT - 6, up(tick) + 4, f"{100 * tick:g} %", "end")]
    strategies = collections.defaultdict(list)
    for row in rows:
        strategies[row.strategy].append(row)
    for k, (name, levels) in enumerate(strategies.items()):
        colour = COLOURS[k % len(COLOURS)]
        points = [(across(r.seconds), up(r.error)) for r in levels if r.error > 0]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" '
                     'stroke-width="2"/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>'
                  for x, y in points]
        for r in levels:
            if r.low > 0 and r.high > 0:
                parts.append(line(across(r.seconds), up(r.low), across(r.seconds),
                                  up(r.high), colour, 'stroke-opacity="0.5"'))
        y = TOP + 16 * (k + 1)
        parts += [line(WIDTH - RIGHT + 12, y - 4, WIDTH - RIGHT + 32, y - 4, colour,
                       'stroke-width="2"'),
                  text(WIDTH - RIGHT + 38, y, name if len(name) < 25 else name[:22] + "...")]
    return "\n".join(parts + ["</svg>\n"])


def main(study_path, image_path, plot_path):
    study = lanelight.read_study(study_path)
    rows = [r for r in lanelight.errors(study) if r.seconds > 0]
    if not rows:
        sys.exit(f"{study_path}: nothing was measured")
    for r in rows:
        print(f"{r.scene}  {r.strategy:<30} {r.samples:>6} spp  {r.seconds:8.3g} s  "
              f"{100 * r.error:.3g} % [{100 * r.low:.3g}, {100 * r.high:.3g}]")
    first = rows[0].scene
    with open(plot_path, "w", encoding="utf-8") as out:
        out.write(plot([r for r in rows if r.scene == first]))

    image = lanelight.read_exr(image_path)
    print(f"{image_path}: {image.width}x{image.height} pixels, "
          f"{image.attributes['spp']:g} samples each; error {100 * image.error():.3g} % by "
          f"its variances alone")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
