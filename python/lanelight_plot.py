"""Draws what studies, sweeps and benches have measured, for papers.

`lanelight plot` runs this file. From Python:

    import json, lanelight_plot
    with open("study/study.json") as file:
        plot = lanelight_plot.make(json.load(file), "time", scene="room")
    lanelight_plot.draw(plot).savefig("time.pdf")    # a matplotlib Figure
    print(lanelight_plot.csv_text(plot))

Drawing needs matplotlib (Debian: python3-matplotlib), all else Python 3 only.
"""
import csv
import io
import json
import math
import os
import sys

from lanelight_draw import SECONDS, SPP, Panel, Plot, Point, draw, picture

MOST_LEADING = 8  # strategies of a ranking, as MOST_CURVES of the report page
SCHEMAS = {"study": 1, "sweep": 2, "bench": 1}


class PlotError(ValueError):
    """A plot that the file does not have; says which ones it has."""


def _point(x, data, low=None, high=None):
    """A point at x of an interval of the JSON, a number or None."""
    if not isinstance(data, dict):
        data = {"value": data, "low": low, "high": high}
    return Point(x, *(math.nan if data.get(k) is None else float(data[k])
                      for k in ("value", "low", "high")))


def _drawn(panel, points):
    """The points that have a place on the panel's axes."""
    return [p for p in points
            if math.isfinite(p.value) and p.x > 0 and (p.value > 0 or not panel.log)]


def _kind(data):
    """Which command wrote the JSON. Throws PlotError for other files and schemas."""
    known = isinstance(data, dict)
    kind = str(data.get("kind", "")).removeprefix("lanelight-") if known else ""
    if known and kind not in ("study", "sweep"):
        kind = "bench" if "rows" in data and "program" in data else ""
    if not kind:
        raise PlotError("is not what can be drawn: study.json of `lanelight study`, sweep.json "
                        "of `lanelight sweep`, or what `lanelight bench --json` writes")
    if data["schema"] != SCHEMAS[kind]:
        raise PlotError(f"has schema {data['schema']}; this program draws schema "
                        f"{SCHEMAS[kind]}")
    return kind


# Figures: {name: (what it shows, title, [(Panel, points)])}. points(strategy) of a study; of a
# sweep, the measure along y and the axis along x.

def _levels(error, time=False):
    return lambda s: [_point(level["cpu_seconds"]["value"] if time else level["spp"],
                             level[error]) for level in s["levels"]]


STUDY_FIGURES = {
    "8": ("the paper's figure 8: RMSE against samples, and the slopes", "Convergence",
          [(Panel("RMSE", SPP, slope=-0.5), _levels("rmse")),
           (Panel("slope", mark=-0.5, log=False), lambda s: [_point(1, s["order"])])]),
    "samples": ("relative MSE against samples per pixel", "Error against samples",
                [(Panel("relative MSE", SPP, slope=-1), _levels("relmse"))]),
    "time": ("relative MSE against processor time", "Error against time",
             [(Panel("relative MSE", SECONDS, slope=-1), _levels("relmse", time=True))]),
    "efficiency": ("the ranking: efficiency relative to the baseline", "Efficiency",
                   [(Panel("efficiency relative to the baseline", mark=1),
                     lambda s: [_point(1, s["efficiency"])])])}


def _sweep_figures(sweep):
    efficiency = f"efficiency relative to {sweep['baseline']}"
    found = {
        "samples": (*STUDY_FIGURES["samples"][:2],
                    [(Panel("relative MSE", SPP, slope=-1), ("relmse", "spp"))]),
        "time": (*STUDY_FIGURES["time"][:2],
                 [(Panel("relative MSE", SECONDS, slope=-1), ("relmse", "cpu_seconds"))]),
        "efficiency": ("efficiency relative to the baseline", "Efficiency",
                       [(Panel(efficiency, mark=1), ("efficiency", ""))]),
        "rate": ("samples per wall second", "Throughput",
                 [(Panel("samples per wall second"), ("samples_per_second", ""))])}
    for axis in sweep["axes"]:
        if axis["parameter"] and axis["numeric"]:
            name = axis["name"]
            found[name] = ("efficiency against this part of the strategy",
                           f"Efficiency against {name}",
                           [(Panel(efficiency, name, mark=1), ("efficiency", name))])
    return found


def figures(data):
    """{name: what it shows} of the plots that this JSON can be drawn as."""
    kind = _kind(data)
    if kind == "bench":
        return {"rate": "samples per wall second of every row, with intervals"}
    known = STUDY_FIGURES if kind == "study" else _sweep_figures(data)
    return {name: shows for name, (shows, *_) in known.items()}


def _chosen(kind, name, known):
    if name in known:
        return name
    listed = ", ".join(f'"{k}"' for k in known)
    if not name and kind == "scene" and len(known) == 1:
        return known[0]
    if not name and kind == "scene" and known:
        raise PlotError(f"has several scenes; choose one by --scene: {listed}")
    raise PlotError(f'has an unknown {kind} "{name}"; supported: {listed or "nothing"}'
                    if known else f"has no {kind} to draw")


def _strategies(scene, figure, everything):
    """The strategies to draw, best first."""
    ranking = scene["ranking"]
    of_paper = [i for i in ranking if scene["strategies"][i]["figure"] is not None]
    if figure == "8" and of_paper and not everything:
        ranking = [i for i in ranking if i in of_paper or i == scene["baseline"]]
    elif len(ranking) > MOST_LEADING and not everything:
        ranking = [i for place, i in enumerate(ranking)
                   if place < MOST_LEADING - 1 or i == scene["baseline"]]
    return [scene["strategies"][i] for i in ranking]


def _study_plot(study, figure, scene_name, everything):
    scenes = {s["name"]: s for s in study["scenes"] if s["error"] is None}
    scene = scenes[_chosen("scene", scene_name, list(scenes))]
    strategies = _strategies(scene, figure, everything)
    _, title, panels = STUDY_FIGURES[figure]
    drawn = [panel._replace(series={s["name"]: (look, _drawn(panel, points(s)))
                                    for look, s in enumerate(strategies)})
             for panel, points in panels]
    settings, versions = study["settings"], study["machine"]["versions"]
    width, height = scene["resolution"]
    return Plot(f"{title}: {scene['name']}",
                f"{100 * settings['confidence']:g} % intervals of {settings['repetitions']} "
                f"repetitions; {width} x {height} pixels; lanelight "
                f"{versions.get('lanelight', '?')}, commit {versions.get('commit', '?')}; "
                f"{study['machine'].get('text', 'unknown machine')}", drawn)


def _measure(sweep, group, name, x=1):
    """The mean over seeds; of a single cell its value with the render's own interval."""
    if name == "efficiency":
        return _point(x, group["efficiency"])
    if "measured" in group:
        return _point(x, group["measured"][name])
    cell = sweep["cells"][group["cells"][0]]["measured"]
    return _point(x, *(cell.get(name + end) for end in ("", "_low", "_high")))


def _series_name(sweep, group, figure, x):
    """The strategy, and the values of axes that vary beside the scene and x."""
    parts = [] if figure == x else [group["strategy"]]
    for axis in sweep["axes"]:
        key, value = axis["name"], group["values"].get(axis["name"])
        amount = key in ("spp", "time") or key.startswith("target")
        along = key in ("scene", x) or (x == "cpu_seconds" and amount)
        of_strategy = key == "strategy" or axis["parameter"]
        if along or not value or len(axis["values"]) + axis["unset"] < 2:
            continue
        if figure == x or not of_strategy:
            parts.append(value if key == "strategy" else f"{key} {value}")
    return ", ".join(parts) or "all"


def _sweep_plot(sweep, figure, scene_name):
    _, title, [(panel, (y, x))] = _sweep_figures(sweep)[figure]
    scene = _chosen("scene", scene_name, next(
        (a["values"] for a in sweep["axes"] if a["name"] == "scene"), []))
    series = {}
    for group in sweep["groups"]:
        if group["values"]["scene"] != scene:
            continue
        place = (1 if not panel.x else _measure(sweep, group, x).value if x == "cpu_seconds"
                 else float(group["values"].get(x) or math.nan))
        name = _series_name(sweep, group, figure, x)
        for point in _drawn(panel, [_measure(sweep, group, y, place)]):
            series.setdefault(name, (len(series), []))[1].append(point)
    for _, points in series.values():
        points.sort(key=lambda p: p.x)
    seeds, machines = sweep["seeds"], sweep["machines"]
    return Plot(f"{title}: {scene}",
                (f"95 % intervals over {seeds} seeds" if seeds > 1
                 else "95 % intervals that renders state of their errors")
                + f"; {sweep['file']}; "
                + (machines[0]["text"] if machines else "unknown machine"),
                [panel._replace(series=series)])


def _bench_plot(bench):
    series, targets = {}, []
    for row in bench["rows"]:
        if row["target"] not in targets:
            targets.append(row["target"])
        threads = row["threads"]
        name = f"{row['scene']}, {row['target']}, {threads} thread{'s' * (threads != 1)}"
        points = _drawn(Panel(""), [_point(1, row["samples_per_second"])])
        series[name] = (targets.index(row["target"]), points)
    return Plot("Throughput", f"{100 * bench['confidence']:g} % intervals of the median; "
                f"{bench['program']}; {bench['machine']['text']}",
                [Panel("samples per wall second", series=series)])


def make(data, figure, scene="", everything=False):
    """The Plot of that name (see figures). scene: by name; may be empty if there is one.
    everything: all strategies of a study, not the paper's or the leading ones. Throws
    PlotError for what is not there, and KeyError and the like for damaged data."""
    kind = _kind(data)
    if kind == "study" and len(figure) == 1 and figure in "1234567":
        raise PlotError(f"has no plot of figure {figure}, which is a picture: report.html beside "
                        "it shows it, and the folder of the scene has its pixels as EXR")
    _chosen("figure", figure, list(figures(data)))
    plot = (_bench_plot(data) if kind == "bench" else _sweep_plot(data, figure, scene)
            if kind == "sweep" else _study_plot(data, figure, scene, everything))
    if not any(points for p in plot.panels for _, points in p.series.values()):
        raise PlotError(f'has no numbers for figure "{figure}" of '
                        f'"{plot.title.split(": ")[-1]}"')
    return plot


def csv_text(plot):
    """A row for each point; a number that is not known is empty."""
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


def _write(path, content):
    """Writes a file whole or not at all; devices as they are."""
    path = os.path.realpath(path)
    if os.path.exists(path) and not os.path.isfile(path):
        with open(path, "wb") as file:
            file.write(content)
        return
    temporary = f"{path}.{os.getpid()}.0.tmp"
    try:
        with open(temporary, "xb") as file:
            file.write(content)
        os.replace(temporary, path)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)


def _run(file, figure, out, scene, everything):
    with open(file, encoding="utf-8") as stream:
        data = json.load(stream)
    if not figure:
        known = figures(data)
        widest = max(map(len, known))
        return "".join(f"{name:{widest}}  {shows}\n" for name, shows in known.items())
    plot = make(data, figure, scene, bool(everything))
    ending = os.path.splitext(out)[1][1:]
    _write(out, csv_text(plot).encode() if ending == "csv" else picture(plot, ending))
    return ""


def main(file, figure, out, scene, everything):
    """What `lanelight plot` does: without a figure, prints which there are."""
    try:
        os.write(1, _run(file, figure, out, scene, everything).encode())
    except BrokenPipeError:
        pass
    except ImportError as error:
        # The python3 of PATH may be another one than the system's, which has its packages.
        system = "/usr/bin/python3"
        if (os.path.exists(system)
                and os.path.realpath(system) != os.path.realpath(sys.executable)):
            os.execv(system, [system, *sys.orig_argv[1:]])
        return (f"error: {error}: drawing needs matplotlib; install python3-matplotlib "
                "(Debian), or write .csv")
    except PlotError as error:
        return f"error: '{file}' {error}"
    except OSError as error:
        return f"error: cannot write '{out}': {error.strerror}"
    except UnicodeDecodeError:
        return f"error: '{file}' is not JSON: it is not a text file"
    except json.JSONDecodeError as error:
        return f"error: '{file}' is not JSON: {error}"
    except KeyError as error:
        return f"error: '{file}' is damaged: it has no member {error}"
    except IndexError:
        return f"error: '{file}' is damaged: a list in it is empty"
    except (TypeError, ValueError, AttributeError) as error:
        return f"error: '{file}' is damaged: {type(error).__name__}: {error}"
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
