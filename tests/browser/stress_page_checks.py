"""Checks of the page of stress cases as a whole."""

import csv
import io
import json
import re
import xml.etree.ElementTree as xml

from checks import check, pictures, require, theme
from saved import saved
from stress_checks import choose, data


def rows(page):
    return page.js("return [...document.querySelectorAll('#cases tbody tr')]"
                   ".map((r) => r.cells[0].firstChild.textContent)")


def filter_by(page, key, value):
    page.js("const s = document.querySelector(`[data-filter=\"${arguments[0]}\"]`);"
            "s.value = arguments[1]; s.dispatchEvent(new Event('change'))", key, value)
    page.settle()


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
    page.open()


@check
def the_machine_is_named(page):
    text = page.find("#summary").text
    require("<b>Synthetic</b>, 2 cores, memory unknown, load unknown" in text, text)


@check
def hostile_names_are_text(page):
    require(not page.all("main b b, main script, .tile b"), "markup from a name")
    choose(page, "shapes")
    require("<b>odd</b>" in page.find("#map").text, "the name is not shown")
    page.open()


@check
def nothing_unknown_is_spelled_out(page):
    for name in ("strategies", "noisy", "rare", "angle", "wrong-inside"):
        choose(page, name)
        text = page.text() + " ".join(page.js(
            "return [...document.querySelectorAll('[aria-label], [title]')].map((e) =>"
            "(e.getAttribute('aria-label') || '') + ' ' + (e.title || ''))"))
        words = r"\b(NaN|undefined|null|Infinity)\b"
        found = re.search(rf".{{0,40}}{words}.{{0,40}}|\[object", text)
        require(not found, name, "says", found and found[0])
        wrong = page.js("return [...document.querySelectorAll('svg *')].filter((e) =>"
                        "[...e.attributes].some((a) =>"
                        "/NaN|undefined|null/.test(a.value)))"
                        ".slice(0, 3).map((e) => e.outerHTML)")
        require(not wrong, name, "draws", wrong)
    page.open()


@check
def dark_changes_colours(page):
    colour = ("return getComputedStyle(document.querySelector('.tile .curve')).stroke +"
              "getComputedStyle(document.body).backgroundColor")
    before = page.js(colour)
    page.click("#theme")
    require(theme(page) == "dark" and page.js(colour) != before, "the page stayed light")
    page.click("#theme")
    page.js("localStorage.clear()")
    page.open()


@check
def nothing_is_cut_off(page):
    for width, height in ((1920, 1080), (1280, 800), (360, 740)):
        page.resize(width, height, mobile=width < 500)
        page.open()
        page.scroll_through()
        wide = page.js("return [...document.querySelectorAll('main *')].filter((e) =>"
                       "e.getBoundingClientRect().right > innerWidth + 1 &&"
                       "!e.closest('.scroll') && !e.closest('svg'))"
                       ".slice(0, 3).map((e) => e.className || e.tagName)")
        full = page.js("return document.documentElement.scrollWidth")
        require(full <= width, "at", width, "it is", full, "wide:", wide)
    page.resize(1280, 900)
    page.open()


@check
def the_picture_is_on_the_first_screen(page):
    for width, height in ((1920, 1080), (1280, 800)):
        page.resize(width, height)
        page.open()
        last = page.js("return Math.max(...[...document.querySelectorAll('.tile')]"
                       ".map((t) => t.getBoundingClientRect().bottom))")
        require(last < height, "tiles end at", last, "of", height)
    page.resize(1280, 900)


@pictures
def screenshots(page):
    for name, width, height, scheme in (("desktop-light", 1920, 1080, "light"),
                                        ("desktop-dark", 1280, 800, "dark"),
                                        ("phone-light", 360, 740, "light")):
        page.resize(width, height, mobile=width < 500)
        page.prefer(scheme)
        page.open()
        page.screenshot(name)
        for part in ("map", "strategies", "cases"):
            page.screenshot(f"{name}-{part}", f"#{part}")
    page.resize(1280, 900)
    page.prefer("light")
    page.open()


@check
def nothing_is_fetched(page):
    for entry in page.driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] != "Network.requestWillBeSent":
            continue
        url = message["params"]["request"]["url"]
        require(url.startswith(("file:", "data:", "about:")), "fetches", url)


@check
def console_is_silent(page):
    require(not page.console(), "\n".join(page.console()))


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
