"""Draws a Plot with matplotlib (Debian: python3-matplotlib). See plot.py."""
import io
import math
import typing

SPP, SECONDS = "samples per pixel", "processor time of one render"  # labels of x

# The strategies' colours in the report pages (src/measure/report/page/base.css).
COLORS = ["#0067b1", "#c84c00", "#007a55", "#a6357f", "#7a6200", "#4b3fa8", "#b3202c",
          "#4d5a66"]
MARKERS = "os^Dv"
DASHES = ["-", (0, (5, 3)), (0, (1.5, 2)), (0, (6, 2, 1.5, 2))]
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
INK, MUTED = "#1c1e21", "#5b6169"
STYLE = {"font.size": 9, "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": MUTED,
         "xtick.color": MUTED, "ytick.color": MUTED, "axes.grid": True, "grid.color": "#e3e3e0",
         "axes.axisbelow": True, "axes.spines.top": False, "axes.spines.right": False,
         "text.parse_math": False, "svg.fonttype": "none", "svg.hashsalt": "lanelight"}


class Point(typing.NamedTuple):
    x: float  # positive; unused in rows
    value: float
    low: float = math.nan  # interval; NaN: unknown
    high: float = math.nan


class Panel(typing.NamedTuple):
    """Curves of y over x, or rows: an interval along a horizontal y for each series."""
    y: str  # label
    x: str = ""  # label; empty in rows
    mark: typing.Optional[float] = None  # value of y with a line of its own
    slope: typing.Optional[float] = None  # of a dashed guide
    log: bool = True  # scale of y; x is always logarithmic
    series: dict = {}  # {name: (look, [Point])}; a look is a colour, marker and dash


class Plot(typing.NamedTuple):
    title: str
    source: str  # where the numbers come from, one line
    panels: list  # one, or curves and rows beside them

    def _repr_svg_(self):
        """Shows the plot in a notebook."""
        return picture(self, "svg").decode()


def _tick_text(value, label):
    if label == SECONDS:
        for size, unit in (3600, "h"), (60, "min"), (1, "s"), (1e-3, "ms"), (1e-6, "µs"):
            if value >= 0.9999 * size:
                return f"{value / size:.3g} {unit}"
    if abs(value) < 1e-12:
        return "0"
    if 0.000999 <= abs(value) < 1e5 or label == SPP:
        return f"{value:.6g}".replace("-", "\u2212")
    factor, power = f"{value:.3e}".split("e")
    factor = "" if float(factor) == 1 else f"{float(factor):g}×"
    return f"{factor}10{str(int(power)).translate(SUPERSCRIPTS)}"


def _set_axis(axis, values, label, log, ticks=6):
    """Sets limits with some room around the values, and round ticks."""
    from matplotlib import ticker
    low, high = min(values, default=1), max(values, default=1)
    if log:
        room = max(1.2, math.sqrt(2 * low / high))
        low, high = low / room, high * room
    else:
        room = 0.08 * (high - low) or 0.5 * abs(high) + 1e-3
        low, high = low - room, high + room
    axis.axes.set(**{f"{axis.axis_name}scale": "log" if log else "linear",
                     f"{axis.axis_name}lim": (low, high), f"{axis.axis_name}label": label})
    if label == SPP:
        axis.set_major_locator(ticker.LogLocator(2, numticks=12))
    elif not log or high < 5 * low:
        axis.set_major_locator(ticker.MaxNLocator(ticks, steps=[1, 2, 5, 10]))
    else:
        subs = (1, 2, 5) if high < 300 * low else (1, 3) if high < 1e4 * low else (1,)
        axis.set_major_locator(ticker.LogLocator(10, subs, numticks=10))
    axis.set_minor_locator(ticker.NullLocator())
    axis.set_major_formatter(lambda value, _: _tick_text(value, label))


def _y_values(panel):
    """Values that y must show. An interval down to nothing must not flatten all else."""
    values = [] if panel.mark is None else [panel.mark]
    for _, points in panel.series.values():
        for p in points:
            low = max(p.low, p.value / 8) if panel.log else p.low
            values += [v for v in (p.value, low, p.high) if math.isfinite(v)]
    return values


def _guide(axes, slope):
    """Draws y ~ x^slope in the upper right, where curves leave room."""
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    start, top = math.sqrt(x0 * x1), y1 / (y1 / y0) ** 0.05
    end = min(x1 / 1.05, start * math.sqrt(y1 / y0) ** (-1 / slope))
    axes.plot([start, end], [top, top * (end / start) ** slope], color="#8d939a", lw=0.8,
              ls=(0, (5, 5)))
    axes.annotate(f"slope \u2212{'½' if slope == -0.5 else f'{-slope:g}'}",
                  (math.sqrt(start * end), top * (end / start) ** (slope / 2)), (5, 5),
                  textcoords="offset points", color=MUTED, size=8)


def _draw_curves(axes, panel):
    _set_axis(axes.xaxis, [p.x for _, points in panel.series.values() for p in points],
              panel.x, True)
    _set_axis(axes.yaxis, _y_values(panel), panel.y, panel.log)
    if panel.slope is not None:
        _guide(axes, panel.slope)
    if panel.mark is not None:
        axes.axhline(panel.mark, color=MUTED, lw=0.8, ls=":")
    for name, (look, points) in panel.series.items():
        color = COLORS[look % len(COLORS)]
        axes.plot([p.x for p in points], [p.value for p in points], color=color, lw=1.5, ms=5,
                  marker=MARKERS[look % len(MARKERS)], label=name,
                  ls=DASHES[(look + look // len(COLORS)) % len(DASHES)])
        known = [p for p in points if math.isfinite(p.low + p.high)]
        axes.vlines([p.x for p in known], [p.low for p in known], [p.high for p in known],
                    color=color, lw=1)
        axes.plot([p.x for p in known] * 2, [p.low for p in known] + [p.high for p in known],
                  color=color, ls="", marker="_", ms=6)


def _draw_rows(axes, panel, beside):
    """Beside curves there is room for fewer ticks and letters, and for a dozen rows."""
    _set_axis(axes.xaxis, _y_values(panel), panel.y, panel.log, 3 if beside else 6)
    names = [_short(name, 24 if beside else 46) for name in panel.series]
    if panel.mark is not None:
        axes.axvline(panel.mark, color=MUTED, lw=0.8, ls=(0, (4, 3)))
    axes.set(yticks=range(len(names)), yticklabels=names,
             ylim=(max(12 if beside else 0, len(names)) - 0.5, -0.5))
    axes.tick_params("y", length=0)
    axes.spines["left"].set_visible(False)
    axes.grid(False, axis="y")
    for row, (label, (look, points)) in enumerate(zip(axes.get_yticklabels(),
                                                      panel.series.values())):
        color = COLORS[look % len(COLORS)]
        label.set_color(color)
        for p in points:
            if math.isfinite(p.low + p.high):
                axes.hlines(row, p.low, p.high, color=color, lw=1.5)
            axes.plot(p.value, row, color=color, marker=MARKERS[look % len(MARKERS)], ms=5)


def _short(text, most):
    return text if len(text) <= most else text[:most] + "…"


def draw(plot):
    """Returns a matplotlib Figure of 10 inches width."""
    import matplotlib
    from matplotlib.figure import Figure
    first = plot.panels[0]
    rows = 0.26 * len(first.series)
    with matplotlib.rc_context(STYLE):
        figure = Figure((10, 1.5 + (max(3.9, rows) if first.x else rows)),
                        layout="constrained")
        figure.get_layout_engine().set(w_pad=0.15, h_pad=0.12)
        figure.suptitle(plot.title, x=0.015, ha="left", weight="bold", size=13)
        figure.supxlabel(_short(plot.source, 150), x=0.015, ha="left", color=MUTED, size=8)
        all_axes = figure.subplots(1, len(plot.panels), squeeze=False,
                                   width_ratios=[2.2, 1][:len(plot.panels)])[0]
        for axes, panel in zip(all_axes, plot.panels):
            if panel.x:
                _draw_curves(axes, panel)
            else:
                _draw_rows(axes, panel, bool(first.x))
        # Text is laid out when it is drawn, which must have the same style.
        if first.x and len(plot.panels) == 1:
            labels = all_axes[0].get_legend_handles_labels()
            all_axes[0].legend(labels[0], [_short(n, 34) for n in labels[1]], loc="upper left",
                               bbox_to_anchor=(1.01, 1), frameon=False, handlelength=3.2,
                               borderaxespad=0, labelspacing=0.9)
    return figure


def picture(plot, ending):
    """Returns the bytes of a file of that type, "svg" or "png"."""
    import matplotlib
    out = io.BytesIO()
    with matplotlib.rc_context(STYLE):
        draw(plot).savefig(out, format=ending, dpi=192,
                           metadata={"Date": None} if ending == "svg" else None)
    return out.getvalue()
