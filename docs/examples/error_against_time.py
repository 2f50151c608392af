#!/usr/bin/env python3
"""Renders a scene with two strategies and draws the error against time, with intervals.

    python3 docs/examples/error_against_time.py scenes/cornell-box.pbrt plot.svg

In a notebook, the lines of main() can be cells. Drawing needs matplotlib (Debian:
python3-matplotlib).
"""
import sys

import lanelight

STRATEGIES = {"default": "default", "independent points": "points=independent"}
COUNTS = 4, 16, 64, 256  # samples per pixel


def main(scene, plot_path):
    images = {name: [lanelight.render(scene, strategy=text, spp=spp, resolution="160x120")
                     for spp in COUNTS]
              for name, text in STRATEGIES.items()}
    for name, row in images.items():
        for image in row:
            print(f"{name:<20}{image.settings['spp']:>6g} spp  "
                  f"{image.report['cpu_seconds']:8.3g} s  error {image.error}")
    plot = lanelight.plot.renders(images)  # a notebook shows it
    lanelight.plot.draw(plot).savefig(plot_path)

    # Where the last render has spent its time, and where its noise is.
    image = lanelight.render(scene, spp=64, resolution="160x120", profile=True)
    for stage in sorted(image.profile.values(), key=lambda s: -s["seconds"])[:3]:
        print(f"{stage['name']:<26}{100 * stage['share']:5.1f} %")
    noise = image.variance.mean(axis=2)
    print(f"{image}: {100 * noise[noise > noise.mean()].sum() / noise.sum():.0f} % of the "
          f"variance is in {100 * (noise > noise.mean()).mean():.0f} % of the pixels")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
