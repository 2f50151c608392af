"""Renders with Lanelight, reads its files and draws its plots.

    import lanelight
    image = lanelight.render("scene.pbrt", spp=64, strategy="points=halton")
    print(image.error)                     # 1.74 % [1.7, 1.78]
    image.rgb, image.variance              # numpy arrays: height x width x 3
    study = lanelight.read_study("study/study.json")
    lanelight.plot.make(study, "time", scene="room")    # shows itself in a notebook

docs/python.md describes all of it.
"""
from . import plot
from .exr import Image, Interval, read_exr
from .program import Error, Interrupted, find_program, run
from .rendering import render
from .results import FormatError, read_bench, read_profile, read_study, read_sweep

__all__ = ["Error", "FormatError", "Image", "Interrupted", "Interval", "find_program", "plot",
           "read_bench", "read_exr", "read_profile", "read_study", "read_sweep", "render",
           "run"]
