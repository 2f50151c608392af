"""Checks of the page of a sweep over a number of strategies, with ten seeds."""

from checks import check, data, markers, pick, require
from sweep_checks import choose, close, show


def group(page, **wanted):
    """The group with exactly these values; underscores stand for what names cannot have."""
    names = {"roulette": "roulette=throughput"}
    wanted = {names.get(key, key): value for key, value in wanted.items()}
    return next(g for g in data(page)["groups"] if g["values"] == wanted)


@check
def the_number_is_the_axis(page):
    page.scroll_through()
    scenes = [item.text for item in page.all("#plots figcaption")]
    require(scenes == ["kitchen", "attic", "cellar"], "folders name scenes:", scenes)
    require(page.find('[data-menu="seed"]') is None, "a seed can be chosen")
    for panel, scene in enumerate(scenes):
        level, curve = markers(page, f"panel-{panel}")
        require(level == [(0.05, 1), (0.8, 1)], "the baseline is not level:", level)
        require([x for x, _ in curve] == [0.05, 0.2, 0.8], "positions:", curve)
        for x, (_, y) in zip(("0.05", "0.2", "0.8"), curve):
            own = group(page, scene=scene, strategy="roulette=throughput:*", roulette=x,
                        spp="16")
            require(close(y, own["efficiency"]["value"]), x, y, own)


@check
def bars_are_the_intervals(page):
    page.show("#plots")
    own = group(page, scene="kitchen", strategy="roulette=throughput:*", roulette="0.2",
                spp="16")
    drawn, wanted = page.js("""
      const host = document.querySelector('[data-plot="panel-0"]'), {frame} = host.plot;
      const bars = host.querySelectorAll('.bars')[1].getAttribute('d').match(/[\\d.]+/g);
      const at = bars.findIndex((x) => Math.abs(x - frame.x(0.2)) < 0.1);
      return [[+bars[at + 1], +bars[at + 3]], arguments[0].map((v) => frame.y(v))]""",
                           [own["efficiency"]["low"], own["efficiency"]["high"]])
    require(all(abs(a - b) < 0.1 for a, b in zip(drawn, wanted)), "bars:", drawn, wanted)


@check
def choices_of_an_axis_are_rows(page):
    choose(page, "along", "points")
    show(page, "efficiency")
    page.show("#plots")
    text = page.find('[data-plot="panel-0"]').text
    for name in ("default", "sobol", "independent", "halton"):
        require(name in text, name, "is not in", text)
    require("[" in text, "no intervals:", text)
    page.reset()


@check
def the_slider_changes_the_pictures(page):
    page.show("#images")
    def pictures():
        return page.js("return [...document.querySelectorAll('.thumbnail')].map((t) =>"
                       "[t.textContent, t.querySelector('canvas') &&"
                       "t.querySelector('canvas').toDataURL()])")
    page.scroll_through()
    last = pictures()
    require(len(last) == 12, "pictures:", [name for name, _ in last])
    require(last[1][0] == "kitchen, roulette=throughput:0.05", last[1][0])
    require(page.find("#images output").text == "16 spp", "the slider says nothing")
    pick(page, "[data-control=amount]", 0)
    page.scroll_through()
    first = pictures()
    require([name for name, _ in first] == [name for name, _ in last], "other names")
    require(first[0][1] != last[0][1], "the same pictures")


@check
def one_sentence_says_what_was_found(page):
    leaders, text = data(page)["leaders"], page.find(".headline").text
    require(len(leaders) == 3 and "3 scenes" in text, text)
    better = sum(l["best"] != l["baseline"] and (l["efficiency"]["low"] or 0) > 1
                 for l in leaders)
    require(f"significantly better than default on {better or 'none'} of the scenes" in text, text)
    require(leaders[0]["best"] in text, text)
