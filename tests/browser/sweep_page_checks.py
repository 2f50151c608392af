"""Checks of the page of a sweep as a whole."""

import json
import re

from checks import check, pictures, plot, require, theme
from sweep_checks import choose, data


def column(page, key):
    return page.js("""
      const heads = [...document.querySelectorAll('#cells thead th')];
      const at = heads.findIndex((h) => h.querySelector(`[data-key="${arguments[0]}"]`));
      return [...document.querySelectorAll('#cells tbody tr')]
        .map((row) => row.cells[at].textContent)""", key)


@check
def the_summary_counts(page):
    cells = data(page)["cells"]
    done = sum(cell["status"] == "done" for cell in cells)
    text = page.find("#summary").text
    require(f"{done} of {len(cells)} done" in text, text)
    require("1 cell has failed" in text and "1 cell is missing" in text, text)
    require("2 machines" in text, text)
    require("<b>Small</b>, 2 cores, memory unknown, load 2.00; Big, 64" in text, text)


@check
def the_table_sorts(page):
    page.show("#cells")
    require(len(column(page, "spp")) == len(data(page)["cells"]), "not all cells")
    for sign in (1, -1):
        page.click('#cells [data-key="spp"]')
        numbers = [sign * int(text) for text in column(page, "spp")]
        require(numbers == sorted(numbers), numbers)
    page.click('#cells [data-key="cpu_seconds"]')
    last = page.find("#cells tbody tr:last-child").text
    require("failed" in last or "missing" in last, "what is not known is not last:", last)
    require("out of <i>memory</i>" in page.find("#cells").text, "no message")


@check
def hostile_names_are_text(page):
    require(not page.all("main i, main script"), "markup from a name")
    require("<i>odd" in page.text(), "the name is not shown")


@check
def nothing_unknown_is_spelled_out(page):
    for along in ("spp", "scene", "threads", "strategy"):
        choose(page, "along", along)
        page.scroll_through()
        text = page.text() + " ".join(page.js(
            "return [...document.querySelectorAll('[aria-label], [title]')].map((e) =>"
            "(e.getAttribute('aria-label') || '') + ' ' + (e.title || ''))"))
        words = r"\b(NaN|undefined|null|Infinity)\b"
        found = re.search(rf".{{0,40}}{words}.{{0,40}}|\[object", text)
        require(not found, along, "says", found and found[0])
    page.open()


@check
def dark_changes_everything(page):
    page.show("#plots")
    before = page.ink(plot(page, "panel-0"))["hash"]
    page.click("#theme")
    require(theme(page) == "dark", "not dark")
    require(page.ink(plot(page, "panel-0"))["hash"] != before, "the plot stayed light")
    page.click("#theme")
    page.js("localStorage.clear()")
    page.open()


@check
def a_phone_scrolls_down_only(page):
    page.resize(360, 740, mobile=True)
    for along in ("spp", "scene"):
        page.open()
        choose(page, "along", along)
        page.scroll_through()
        width = page.js("return document.documentElement.scrollWidth")
        wide = page.js("return [...document.querySelectorAll('main *')].filter((e) =>"
                       "e.getBoundingClientRect().right > 361 && !e.closest('.scroll'))"
                       ".slice(0, 3).map((e) => e.className || e.tagName)")
        require(width <= 360, along, "is", width, "wide:", wide)
    page.resize(1280, 900)
    page.open()


@pictures
def screenshots(page):
    for name, width, height, scheme in (("desktop-light", 1280, 900, "light"),
                                        ("desktop-dark", 1280, 900, "dark"),
                                        ("phone-light", 360, 740, "light")):
        page.resize(width, height, mobile=width < 500)
        page.prefer(scheme)
        page.open()
        page.scroll_through()
        page.screenshot(name)
        for part in ("summary", "plots", "images", "stages", "cells"):
            page.screenshot(f"{name}-{part}", f"#{part}")
        choose(page, "along", "scene")
        page.screenshot(f"{name}-bars", "#plots")
    page.resize(1280, 900)
    page.prefer("light")


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
