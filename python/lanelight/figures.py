"""Collects the numbers of each figure from the JSON of a study, sweep or bench."""
import math

from .draw import SECONDS, SPP, Panel, Plot, Point
from .results import FormatError

MOST_LEADING = 8  # strategies of a ranking, as MOST_CURVES of the report page


class PlotError(FormatError):
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


def sweep_figures(sweep):
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


def chosen(kind, name, known):
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


def study_plot(study, figure, scene_name, everything):
    scenes = {s["name"]: s for s in study["scenes"] if s["error"] is None}
    scene = scenes[chosen("scene", scene_name, list(scenes))]
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


def sweep_plot(sweep, figure, scene_name):
    _, title, [(panel, (y, x))] = sweep_figures(sweep)[figure]
    scene = chosen("scene", scene_name, next(
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


def bench_plot(bench):
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
