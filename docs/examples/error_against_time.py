#!/usr/bin/env python3
"""Prints the errors of a study, draws them against time, and says what an image knows.

    lanelight study scene.pbrt --out study --spp 1,4,16,64
    lanelight render scene.pbrt -o out.exr --spp 64
    PYTHONPATH=python docs/examples/error_against_time.py study/study.json out.exr plot.svg

Drawing needs matplotlib (Debian: python3-matplotlib).
"""
import sys

import lanelight
import lanelight_plot


def main(study_path, image_path, plot_path):
    study = lanelight.read_study(study_path)
    rows = [r for r in lanelight.errors(study) if r.seconds > 0]
    if not rows:
        sys.exit(f"{study_path}: nothing was measured")
    for r in rows:
        print(f"{r.scene}  {r.strategy:<30} {r.samples:>6} spp  {r.seconds:8.3g} s  "
              f"{100 * r.error:.3g} % [{100 * r.low:.3g}, {100 * r.high:.3g}]")
    plot = lanelight_plot.make(study, "time", rows[0].scene)
    lanelight_plot.draw(plot).savefig(plot_path)

    image = lanelight.read_exr(image_path)
    print(f"{image_path}: {image.width}x{image.height} pixels, "
          f"{image.attributes['spp']:g} samples each; error {100 * image.error():.3g} % by "
          f"its variances alone")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
