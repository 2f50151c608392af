"""Checks of what the page of stress cases draws, against the numbers that it holds."""

import math

from checks import check, data, note_of, require


def case(page, name):
    return next(c for c in data(page)["cases"] if c["name"] == name)


def choose(page, name):
    page.js("document.querySelector(`.tile[data-case=\"${arguments[0]}\"]`).click()",
            name)
    page.settle()


SERIES = ("points=halton", "points=sobol", "roulette=none")


def points(page, name, target="AVX3", series=None, drawn_only=False):
    return [p for p in case(page, name)["points"] if p["target"] == target and
            (series is None or p["series"] == series) and
            not (drawn_only and (p["refused"] or p["not_measured"]))]


def drawn(page, plot):
    """Markers of every curve of a plot: [[(x, y), ...], ...] in pixels."""
    return page.js("""
      const box = document.querySelector(`[data-plot="${arguments[0]}"]`);
      const start = box.getBoundingClientRect();
      return [...box.querySelectorAll('g[data-series]')].map((g) =>
        [...g.querySelectorAll('.marker')].map((m) => {
          const b = m.getBoundingClientRect();
          return [b.x + b.width / 2 - start.x, b.y + b.height / 2 - start.y];
        }))""", plot)


def require_linear(pairs, what):
    """Values and pixels must lie on one line, within a pixel."""
    require(len(pairs) >= 2, what, "has too few points:", pairs)
    (v0, p0), (v1, p1) = min(pairs), max(pairs)
    require(v1 > v0, what, "does not vary", pairs)
    for v, p in pairs:
        wanted = p0 + (p1 - p0) * (v - v0) / (v1 - v0)
        require(abs(p - wanted) < 1.2, what, "draws", v, "at", p, "instead of", wanted)


@check
def the_sentence_comes_first(page):
    require(page.find("h1").text == data(page)["sentence"], page.find("h1").text)
    require(page.find("h1").get_attribute("data-outcome") == "failed", "no alarm")


@check
def every_map_has_a_tile(page):
    names = page.js("return [...document.querySelectorAll('.tile')].map((t) =>"
                    "t.dataset.case)")
    maps = [c["name"] for c in data(page)["cases"]
            if any(p["parameter"] is not None for p in c["points"])]
    require(sorted(names) == sorted(maps), names)
    require(names[0] == "wrong-inside", "the failed one is not the first:", names)
    for c in data(page)["cases"]:
        axis = c["axis"]
        for p in page.all(f'.tile[data-case="{c["name"]}"]'):
            title = page.js("return arguments[0].querySelector('.tile-axis').innerText", p)
            require(title == axis["name"] + (f' ({axis["unit"]})' if axis["unit"] else ""), title)
            outcome = p.get_attribute("data-outcome")
            require(outcome == c["outcome"], c["name"], outcome)
    require(page.find(".chip").text == "single", "no chip for a single point")


@check
def tiles_mark_the_promise_and_the_break(page):
    box = page.js("""
      const t = document.querySelector('.tile[data-case="strategies"] svg');
      const r = t.querySelector('.promise');
      return {from: +r.getAttribute('x'), width: +r.getAttribute('width'),
              breaks: [...t.querySelectorAll('.break')].map((b) => +b.getAttribute('x1')),
              bad: t.querySelectorAll('.dot.bad').length}""")
    # 1e-4 to 1e4 with 4 % of 8 decades on either side; promised 1e-2 to 1e2.
    at = lambda exponent: 200 * (exponent + 4 + 0.32) / 8.64
    require(abs(box["from"] - at(-2)) < 0.5, box)
    require(abs(box["width"] - at(2) + at(-2)) < 0.5, box)
    require(len(box["breaks"]) == 2, box)
    for x, exponent in zip(sorted(box["breaks"]), (-4, 4)):
        require(abs(x - at(exponent)) < 0.5, exponent, box)
    require(box["bad"] == 2, "wrong points:", box)


@check
def the_four_plots_draw_the_numbers(page):
    choose(page, "strategies")
    measures = {
        "error": lambda p: math.log10(abs(p["measured"] - 1) or 1e-99),
        "noise": lambda p: math.log10(p["standard_error"]),
        "cost": lambda p: math.log10(p["seconds"] / p["samples"]),
        "lanes": lambda p: p["lanes_used"] / p["lane_slots"],
    }
    for plot, measure in measures.items():
        curves = drawn(page, plot)
        require(len(curves) == 3, plot, "has", len(curves), "curves")
        xs, ys = [], []
        for curve, series in zip(curves, SERIES):
            numbers = points(page, "strategies", series=series, drawn_only=True)
            wanted = 7 if series == "roulette=none" else 8
            require(len(curve) == len(numbers) == wanted, plot, series, len(curve))
            xs += [(math.log10(p["parameter"]), c[0]) for p, c in zip(numbers, curve)]
            # No error at all has a place of its own, at the bottom.
            ys += [(measure(p), c[1]) for p, c in zip(numbers, curve) if measure(p) > -99]
        require_linear(xs, plot + " x")
        if plot != "noise":  # the same everywhere
            require_linear(ys, plot)
    page.click('#map [data-value="rays"]')
    rays = [(math.log10(p["rays"] / p["samples"]), c[1])
            for curve, series in zip(drawn(page, "cost"), SERIES)
            for p, c in zip(points(page, "strategies", series=series, drawn_only=True), curve)]
    require_linear(rays, "rays")


@check
def linear_axes_are_linear(page):
    choose(page, "angle")
    numbers = points(page, "angle")
    require_linear([(p["parameter"], c[0]) for p, c in
                    zip(numbers, drawn(page, "error")[0])], "angle")
    require("angle (degrees)" in page.find("#map").text, "no name of the axis")


@check
def refusals_and_failures_are_marked(page):
    choose(page, "strategies")
    require(len(page.all('[data-plot="error"] .refused')) == 1, "no cross")
    require(len(page.all('[data-plot="error"] circle.bad')) == 2, "no rings")
    text = note_of(page, '[data-plot="error"] .refused')
    require('<b>x</b> of 1e-4 is below "1e-3"' in text, text)
    choose(page, "wrong-inside")
    require("inside the supported range, 10 m: off by +20 %" in page.find("#map").text,
            page.find("#map").text)


@check
def the_legend_hides_curves(page):
    choose(page, "strategies")
    page.click("#map .legend-item")
    require(len(drawn(page, "error")) == 2, "still there")
    page.click("#map .legend-item")
    require(len(drawn(page, "error")) == 3, "gone")
    page.js("document.querySelectorAll('#map .legend-item')[1].dispatchEvent("
            "new PointerEvent('pointerenter'))")
    opacities = page.js("return [...document.querySelectorAll("
                        "'[data-plot=\"error\"] g[data-series]')]"
                        ".map((g) => getComputedStyle(g).opacity)")
    require(opacities == ["0.18", "1", "0.18"], "nothing stands out", opacities)


@check
def targets_change_everything(page):
    choose(page, "strategies")
    before = drawn(page, "cost")
    tabs = [tab.text for tab in page.all("#scenes a")]
    require(tabs == ["AVX3", "EMU128"], tabs)
    page.click('[data-target="EMU128"]')
    require("on EMU128" in page.find("#map h2").text, page.find("#map h2").text)
    numbers = points(page, "strategies", "EMU128", "points=sobol", drawn_only=True)
    ys = [(math.log10(p["seconds"]), c[1]) for p, c in zip(numbers, drawn(page, "cost")[1])]
    require_linear(ys, "cost on EMU128")
    require(len(before) == len(drawn(page, "cost")), "other curves")
    page.reset()


@check
def the_heat_map_tells_efficiencies(page):
    rows = page.js("""
      return [...document.querySelectorAll('#strategies tbody tr')].map((r) =>
        [...r.cells].map((c) => c.textContent))""")
    require(tuple(row[0] for row in rows) == SERIES, rows)
    for row in rows:
        require(row[1] == "refused", row)
        numbers = points(page, "strategies", series=row[0])
        for text, p in zip(row[2:], numbers[-8:]):
            if p["not_measured"]:
                require(text == "·", "not measured:", text)
                continue
            value = p["efficiency"]["value"]
            require(abs(float(text) / value - 1) < 0.06, text, value)
    bad = page.all("#strategies td.bad")
    require(len(bad) == 3 + 2, "marks of what is wrong:", len(bad))
    titles = [cell.text for cell in page.all("#strategies .map-title")]
    require(titles == ["strategies"], "shapes are no strategies", titles)
    inside = page.all("#strategies thead .inside")
    require(len(inside) == 5, "promised values:", len(inside))
