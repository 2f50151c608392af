"""Checks of what plots are saved as, and of the faults that pages of studies had."""

import csv
import io
import xml.etree.ElementTree as xml

from checks import check, require
from saved import saved


@check
def plots_are_saved_as_what_they_show(page):
    page.scroll_through()
    for name in ("hero", "seconds", "spp", "calibration", "convergence"):
        file = saved(page, name, "svg")
        require(file["name"].endswith(f"{name}.svg"), file["name"])
        root = xml.fromstring(file["text"])
        ns = "{http://www.w3.org/2000/svg}"
        points = [p for p in root.iter(f"{ns}path") if p.get("class") == "marker"]
        texts = [t.text for t in root.iter(f"{ns}text")]
        require(any("Lanelight study" in (t or "") for t in texts), "no source:", texts)
        require("var(" not in file["text"], "colours of the page in", name)
        rows = list(csv.DictReader(io.StringIO(saved(page, name, "csv")["text"])))
        curve = [r for r in rows if r["at"]]
        require(len(points) == len(curve) > 4, name, len(points), "markers", len(curve))
        require({(p.get("data-series"), p.get("data-y")) for p in points} ==
                {(r["series"], r["value"]) for r in curve}, name, "CSV and SVG differ")
        require({r["series"] for r in rows} <= set(texts), "no legend in", name, texts)


@check
def a_png_is_saved(page):
    page.scroll_through()
    file = saved(page, "spp", "png")
    require(file["name"].endswith(".png") and file["first"] == ord("P"), file["name"])
    require(file["size"] > 20000, "a small picture:", file["size"])


@check
def saved_plots_are_light(page):
    page.scroll_through()
    light = saved(page, "spp", "svg")["text"]
    page.click("#theme")
    require(saved(page, "spp", "svg")["text"] == light, "dark colours in a file")
    page.click("#theme")
    page.js("localStorage.clear()")


@check
def names_do_not_break_within_words(page):
    page.show("#ranking")
    page.click('#ranking [data-value="all"]')
    for height in page.js("return [...document.querySelectorAll('#ranking .strategy-name')]"
                          ".map((n) => n.offsetHeight)"):
        require(height < 70, "a name is", height, "pixels high")
    page.click('#ranking [data-value="main"]')


@check
def the_winner_and_its_rivals_are_told_apart(page):
    for index in (0, 4):
        page.click("#scenes a", index)
        page.settle(10)
        colors = page.js("return [...document.querySelectorAll('.hero-legend line')]"
                         ".map((l) => getComputedStyle(l).stroke)")
        names = [n.text for n in page.all(".hero-legend .strategy-name")]
        require(len(names) >= 2 and len(set(colors)) == len(names), index, names, colors)
        sentence = page.find("#summary .verdict").text
        if "may be equally efficient" in sentence and "others" not in sentence:
            for name in sentence.split("; ")[1].split(" may be")[0].split(", "):
                require(name in names, name, "has no label:", names)
    page.reset()


@check
def guides_name_slopes_of_their_axes(page):
    page.show("#curves")
    require("slope −1" in saved(page, "spp", "svg")["text"], "no slope −1 of relative MSE")
    page.click('#curves [data-value="rmse"]')
    text = saved(page, "spp", "svg")["text"]
    require("slope −½" in text and "RMSE slope" not in text, "no slope −½ of RMSE")
    page.click('#curves [data-value="relmse"]')


@check
def difference_has_content_at_once(page):
    page.show("#compare")
    page.click('#compare [data-value="difference"]')
    ink = page.ink(page.find('[data-pane="difference"]'))
    require(ink["coloured"] > 0.01 * ink["pixels"], "the difference is blank:", ink)
    page.click('#compare [data-value="side"]')


@check
def the_reference_is_short(page):
    height = page.js("return document.querySelector('.reference-strategy').offsetHeight")
    require(height < 110, "the reference's text is", height, "pixels high")
