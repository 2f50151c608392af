"""Checks of what the page of a sweep draws, against the numbers that it holds."""

import math

from checks import check, data, markers, note_of, pick, plot, require


def choose(page, name, value):
    pick(page, f'[data-menu="{name}"]', value)


def mean(cells, name):
    numbers = [cell["measured"].get(name) for cell in cells]
    if not numbers or None in numbers:
        return None
    return sum(numbers) / len(numbers)


def cells_of(page, **wanted):
    """Finished cells with these values; underscores stand for dashes."""
    return [cell for cell in page.js("return study.cells") if cell["status"] == "done" and all(
        cell["values"].get(axis.replace("_", "-"), "not set") == value
        for axis, value in wanted.items())]


def expected(page, points, lines, fixed, x, y):
    """{line: [(x, y)]} of two functions of cells."""
    result = []
    for line in lines:
        found = []
        for point in points:
            cells = cells_of(page, **fixed, **line, **point)
            pair = (x(cells), y(cells)) if cells else (None, None)
            if None not in pair:
                found.append(pair)
        result.append(sorted(found))
    return result


def close(a, b):
    return math.isclose(a, b, rel_tol=1e-5)  # cells have six digits


def require_lines(drawn, lines, what):
    """Both: the points of every line."""
    require(len(drawn) == len(lines), what, "has", len(drawn), "lines")
    for points, line in zip(drawn, lines):
        require(len(points) == len(line) > 0 and
                all(close(a, b) for p, q in zip(points, line) for a, b in zip(p, q)),
                what, "draws", points, "instead of", line)


SPP = [{"spp": n} for n in ("1", "4", "16", "64")]
STRATEGIES = [{"strategy": s} for s in ("default", "points=halton")]
THREADS = [{"threads": n} for n in ("1", "2", "4")]


def show(page, measure, against="along"):
    page.click(f'#plots [data-value="{measure}"]')
    page.click(f'#plots [data-value="{against}"]')


@check
def plots_are_drawn(page):
    page.scroll_through()
    for name in ("panel-0", "panel-1"):
        ink = page.ink(plot(page, name))
        require(ink["ink"] > 0.01 * ink["pixels"], name, "is blank:", ink)
        require(ink["coloured"] > 800, name, "has no curves:", ink)
    titles = [item.text for item in page.all("#plots figcaption")]
    require(titles == ["box", "<i>odd"], "a plot for each scene:", titles)


@check
def errors_are_means_over_the_seeds(page):
    choose(page, "threads", "4")
    for measure in ("relmse", "rmse"):
        show(page, measure, "time")
        for panel, scene in enumerate(("box", "<i>odd")):
            fixed = {"scene": scene, "threads": "4"}
            lines = expected(page, SPP, STRATEGIES, fixed,
                             lambda cells: mean(cells, "cpu_seconds"),
                             lambda cells: mean(cells, measure))
            require([len(line) for line in lines] == [3, 3], "one sample has no error",
                    lines)
            require_lines(markers(page, f"panel-{panel}"), lines, measure)


@check
def rates_stand_at_their_samples(page):
    for measure in ("rays_per_second", "samples_per_second"):
        show(page, measure)
        lines = expected(page, SPP, STRATEGIES, {"scene": "box", "threads": "4"},
                         lambda cells: float(cells[0]["values"]["spp"]),
                         lambda cells: mean(cells, measure))
        require_lines(markers(page, "panel-0"), lines, measure)


@check
def any_two_axes_can_be_chosen(page):
    show(page, "samples_per_second")
    choose(page, "along", "threads")
    choose(page, "lines", "spp")
    choose(page, "strategy", "points=halton")
    fixed = {"scene": "box", "strategy": "points=halton"}
    lines = expected(page, THREADS, SPP, fixed,
                     lambda cells: float(cells[0]["measured"]["used_threads"]),
                     lambda cells: mean(cells, "samples_per_second"))
    require_lines(markers(page, "panel-0"), lines, "threads")
    names = [item.text for item in page.all(".legend-item")]
    require(names == ["1 spp", "4 spp", "16 spp", "64 spp"], "legend:", names)
    # Choosing the other one's axis makes them change places.
    choose(page, "along", "spp")
    require(page.find('[data-menu="lines"]').get_attribute("value") == "threads",
            "they do not change places")
    page.reset()


@check
def axes_without_positions_get_rows(page):
    choose(page, "along", "scene")
    show(page, "samples_per_second")
    require(page.find("#plots .curves") is None, "curves of scenes")
    rows = page.js("return [...document.querySelectorAll('.rate-row')].slice(1).map((r) =>"
                   "r.querySelector('path:last-of-type') && [r.textContent,"
                   "r.querySelector('.whisker path').getBoundingClientRect().x])")
    fixed = {"spp": page.find('[data-menu="spp"]').get_attribute("value"),
             "threads": page.find('[data-menu="threads"]').get_attribute("value")}
    rates = [mean(cells_of(page, strategy=s["strategy"], scene=scene, **fixed),
                  "samples_per_second")
             for s in STRATEGIES for scene in ("box", "<i>odd")]
    require(len(rows) == 4, "rows:", rows)
    require(page.text(".rate-axis .rate-name") == "Samples per second", "no name of the axis")
    (_, x0), (_, x1) = rows[0], rows[1]
    for (text, x), rate in zip(rows, rates):
        share = (x - x0) / (x1 - x0)
        require(abs(share - (rate - rates[0]) / (rates[1] - rates[0])) < 0.05, text, x)
    page.reset()


@check
def without_known_errors_there_is_no_plot(page):
    show(page, "relmse", "time")
    choose(page, "along", "scene")
    require(plot(page, "panel-0"), "no plot where there are errors")
    choose(page, "spp", "1")
    require(plot(page, "panel-0") is None, "an empty plot")
    require("Relative MSE was not measured for this selection" in page.text(), "no word of it")
    page.reset()


@check
def stage_costs_are_per_sample(page):
    page.show("#stages")
    stages = data(page)["stages"]
    rows = page.js("return [...document.querySelectorAll('.stage-row')].map((r) => ["
                   "r.querySelector('.bar').offsetWidth,"
                   "[...r.querySelectorAll('.bar-part')].map((p) => [p.ariaLabel,"
                   "p.offsetWidth])])")
    threads = page.find('[data-menu="threads"]').get_attribute("value")
    wanted = []
    for line in [{"scene": scene, **s} for scene in ("box", "<i>odd") for s in STRATEGIES]:
        for point in SPP:
            cells = cells_of(page, threads=threads, **line, **point)
            sums = [sum(cell["stages"][i] or 0 for cell in cells) / len(cells)
                    for i in range(len(stages))]
            wanted.append((sum(sums) / mean(cells, "samples"), sums))
    require(len(rows) == len(wanted), "bars:", len(rows))
    longest, most = max(row[0] for row in rows), max(cost for cost, _ in wanted)
    for (width, parts), (cost, sums) in zip(rows, wanted):
        require(abs(width / longest - cost / most) < 0.02, "length", width, cost)
        for label, part in parts:
            share = sums[stages.index(label.split()[0])] / sum(sums)
            require(abs(part / width - share) < 0.02, label, part, width, share)
            require(abs(float(label.split()[1]) - 100 * share) < 0.6, label, share)


@check
def the_legend_hides_lines_everywhere(page):
    before = page.ink(plot(page, "panel-0"))["hash"]
    page.click(".legend-item")
    require(page.ink(plot(page, "panel-0"))["hash"] != before, "the plot did not change")
    hidden = page.js("return [...document.querySelectorAll('.stage-row')]"
                     ".map((row) => row.hidden)")
    require(hidden == ([True] * 4 + [False] * 4) * 2, "stage rows:", hidden)
    page.click(".legend-item")
    require(page.ink(plot(page, "panel-0"))["hash"] == before, "not as before")


@check
def hovering_a_marker_tells_its_values(page):
    show(page, "relmse", "time")
    page.show("#plots")
    text = note_of(page, '[data-plot="panel-0"] .marker')
    for part in ("default", "4 spp", "Relative MSE", "[", "2 seeds"):
        require(part in text, "the tip says:", repr(text))
