"""Draws what studies, sweeps and benches have measured, for papers.

    study = lanelight.read_study("study/study.json")
    plot = lanelight.plot.make(study, "time", scene="room")    # shows itself in a notebook
    lanelight.plot.draw(plot).savefig("time.pdf")              # a matplotlib Figure
    print(lanelight.plot.csv_text(plot))

Drawing needs matplotlib (Debian: python3-matplotlib).
"""
import csv
import io
import math

from .draw import SECONDS, Panel, Plot, Point, draw, picture
from .figures import (STUDY_FIGURES, PlotError, bench_plot, chosen, study_plot, sweep_figures,
                      sweep_plot)
from .results import check_schema, kind_of


def _kind(data):
    kind = kind_of(data)
    if kind not in ("study", "sweep", "bench"):
        raise PlotError("is not what can be drawn: study.json of `lanelight study`, sweep.json "
                        "of `lanelight sweep`, or what `lanelight bench --json` writes")
    check_schema(data, kind)
    return kind


def figures(data: dict) -> dict:
    """Returns {name: what it shows} of the plots of this study, sweep or bench."""
    kind = _kind(data)
    if kind == "bench":
        return {"rate": "samples per wall second of every row, with intervals"}
    known = STUDY_FIGURES if kind == "study" else sweep_figures(data)
    return {name: shows for name, (shows, *_) in known.items()}


def make(data: dict, figure: str, scene: str = "", everything: bool = False) -> Plot:
    """Returns the Plot of that name (see figures). scene: by name; may be empty if there is
    one. everything: all strategies of a study, not the paper's or the leading ones. Raises
    PlotError for plots that the data lack, and KeyError and the like for damaged data."""
    kind = _kind(data)
    if kind == "study" and len(figure) == 1 and figure in "1234567":
        raise PlotError(f"has no plot of figure {figure}, which is a picture: report.html beside "
                        "it shows it, and the folder of the scene has its pixels as EXR")
    chosen("figure", figure, list(figures(data)))
    plot = (bench_plot(data) if kind == "bench" else sweep_plot(data, figure, scene)
            if kind == "sweep" else study_plot(data, figure, scene, everything))
    if not any(points for p in plot.panels for _, points in p.series.values()):
        raise PlotError(f'has no numbers for figure "{figure}" of '
                        f'"{plot.title.split(": ")[-1]}"')
    return plot


def renders(images: dict, title: str = "Error against time") -> Plot:
    """Returns a Plot of {name: images of lanelight.render}: a curve for each name. Images
    whose error is unknown are left out."""
    series = {name: (look, [Point(image.report["cpu_seconds"], *image.error)
                            for image in images[name] if image.error.value > 0])
              for look, name in enumerate(images)}
    return Plot(title, "95 % intervals that renders state of their errors",
                [Panel("error (root of the relative MSE)", SECONDS, slope=-0.5, series=series)])


def csv_text(plot: Plot) -> str:
    """Returns a row for each point; unknown numbers are empty."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow("series quantity value low high at at_quantity".split())
    for panel in plot.panels:
        for name, (_, points) in panel.series.items():
            for p in points:
                numbers = [repr(v).removesuffix(".0") if math.isfinite(v) else ""
                           for v in (p.value, p.low, p.high, float(p.x))]
                writer.writerow([name, panel.y, *numbers[:3],
                                 *([numbers[3], panel.x] if panel.x else ["", ""])])
    return out.getvalue()
