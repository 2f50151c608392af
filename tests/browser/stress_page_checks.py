"""Checks of the page of stress cases as a whole."""

import csv
import io
import xml.etree.ElementTree as xml

from checks import NAMES, STATES, check, data, pick, require
from saved import saved
from stress_checks import choose

NAMES += ["<b>odd</b>"]
STATES += [lambda page, name=name: choose(page, name)
           for name in ("strategies", "noisy", "rare", "angle", "wrong-inside", "shapes")]


def rows(page):
    return page.js("return [...document.querySelectorAll('#cases tbody tr')]"
                   ".map((r) => r.cells[0].firstChild.textContent)")


def filter_by(page, key, value):
    pick(page, f'[data-filter="{key}"]', value)


@check
def the_table_filters_and_sorts(page):
    cases = data(page)["cases"]
    require(rows(page) == [c["name"] for c in cases], rows(page))
    filter_by(page, "group", "others")
    require(rows(page) == ["single"], rows(page))
    filter_by(page, "group", "")
    filter_by(page, "outcome", "failed")
    require(rows(page) == ["wrong-inside"], rows(page))
    require("off by +20 %" in page.find("#cases").text, "no reason")
    filter_by(page, "outcome", "")
    page.click('#cases [data-key="outcome"]')
    require(rows(page)[:2] == ["wrong-inside", "noisy"], rows(page))
    page.reset()


@check
def the_machine_is_named(page):
    text = page.find("#summary").text
    require("<b>Synthetic</b>, 2 cores, memory unknown, load unknown" in text, text)


@check
def the_picture_is_on_the_first_screen(page):
    for width, height in ((1920, 1080), (1280, 800)):
        page.resize(width, height)
        page.open()
        last = page.js("return Math.max(...[...document.querySelectorAll('.tile')]"
                       ".map((t) => t.getBoundingClientRect().bottom))")
        require(last < height, "tiles end at", last, "of", height)


@check
def plots_are_saved_as_they_are_shown(page):
    name = data(page)["cases"][0]["name"]
    choose(page, name)
    page.show("#map")
    shown = len(page.all('[data-plot="error"] .marker'))
    light = saved(page, "error", "svg")
    root = xml.fromstring(light["text"])
    ns = "{http://www.w3.org/2000/svg}"
    markers = [p for p in root.iter(f"{ns}path") if p.get("class") == "marker"]
    texts = [t.text or "" for t in root.iter(f"{ns}text")]
    saved_rows = list(csv.DictReader(io.StringIO(saved(page, "error", "csv")["text"])))
    require(len(markers) == shown == len(saved_rows) > 2, len(markers), shown, len(saved_rows))
    require({r["series"] for r in saved_rows} <= set(texts), "no legend:", texts)
    require(any(name in t for t in texts), "no title:", texts)
    require("var(" not in light["text"], "colours of the page")
    require("rgb(" in light["text"], "no colours at all")
    page.click("#theme")
    require(saved(page, "error", "svg")["text"] == light["text"], "dark colours in a file")
    page.click("#theme")
    page.js("localStorage.clear()")
    require(saved(page, "error", "png")["first"] == ord("P"), "no PNG")
