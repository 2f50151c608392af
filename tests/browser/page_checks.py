"""Checks of the page as a whole."""

import json
import re

from checks import check, pictures, plot, require, theme


@check
def scenes_switch(page):
    names = [tab.text for tab in page.all("#scenes a")]
    require(len(names) == 5, "tabs:", names)
    for index, name in enumerate(names):
        page.js("document.querySelectorAll('#scenes a')[arguments[0]].click()", index)
        page.settle()
        require(page.find("#content").get_attribute("data-scene") == name, "not", name)
        require(page.find("h1").text == name, "wrong title for", name)
        page.driver.refresh()
        page.settle()
        require(page.find("h1").text == name, name, "is not remembered")
    page.open()


@check
def machines_are_named(page):
    text = page.find("#summary").text
    require("<b>Synthetic</b> 1000, 4 cores, 8.0 GiB, load 1.50; unknown" in text, text)
    page.js("document.querySelectorAll('#scenes a')[1].click()")
    page.settle()
    require("Synthetic 2000, 2 cores" in page.find("#summary").text, "not the writer's")
    page.open()


@check
def hostile_names_are_text(page):
    require(not page.all("main b b, main script"), "markup from a name")
    require("</script><b>\"bold\"" in page.text(), "the name is not shown")


@check
def nothing_unknown_is_spelled_out(page):
    for index in range(5):
        page.js("document.querySelectorAll('#scenes a')[arguments[0]].click()", index)
        page.settle()
        page.scroll_through()
        page.js("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
        text = page.text() + " ".join(page.js(
            "return [...document.querySelectorAll('[aria-label], [title]')].map((e) =>"
            "(e.getAttribute('aria-label') || '') + ' ' + (e.title || ''))"))
        words = r"\b(NaN|undefined|null|Infinity)\b"
        found = re.search(rf".{{0,40}}{words}.{{0,40}}|\[object", text)
        require(not found, "scene", index, "says", found and found[0])
    page.open()


@check
def dark_changes_everything(page):
    page.show("#curves")
    before = page.ink(plot(page, "spp"))["hash"]
    light = page.js("return getComputedStyle(document.body).backgroundColor")
    page.click("#theme")
    require(theme(page) == "dark", "not dark")
    dark = page.js("return getComputedStyle(document.body).backgroundColor")
    require(light != dark, "the background stayed", light)
    require(page.ink(plot(page, "spp"))["hash"] != before, "the plot stayed light")
    page.driver.refresh()
    page.settle()
    require(theme(page) == "dark", "forgotten")
    page.click("#theme")
    page.js("localStorage.clear()")
    page.prefer("dark")
    page.open()
    require(theme(page) == "dark",
            "the system's wish is ignored")
    page.prefer("light")
    page.open()


@check
def a_phone_scrolls_down_only(page):
    page.resize(360, 740, mobile=True)
    for index in range(5):
        page.open()
        page.js("document.querySelectorAll('#scenes a')[arguments[0]].click()", index)
        page.settle()
        page.scroll_through()
        width = page.js("return document.documentElement.scrollWidth")
        wide = page.js("return [...document.querySelectorAll('main *')].filter((e) =>"
                       "e.getBoundingClientRect().right > 361 && !e.closest('.scroll'))"
                       ".slice(0, 3).map((e) => e.className || e.tagName)")
        require(width <= 360, "scene", index, "is", width, "wide:", wide)
    page.resize(1280, 900)
    page.open()


@check
def nothing_jumps(page):
    page.open()
    page.scroll_through()
    shift = page.js("""const o = new PerformanceObserver(() => {});
      o.observe({type: 'layout-shift', buffered: true});
      return o.takeRecords().filter((e) => !e.hadRecentInput)
        .reduce((sum, e) => sum + e.value, 0);""")
    require(shift < 0.02, "layout shift", shift)


@pictures
def screenshots(page):
    for name, width, height, scheme in (("desktop-light", 1280, 900, "light"),
                                        ("desktop-dark", 1280, 900, "dark"),
                                        ("phone-light", 360, 740, "light"),
                                        ("phone-dark", 360, 740, "dark")):
        page.resize(width, height, mobile=width < 500)
        page.prefer(scheme)
        page.open()
        page.scroll_through()
        page.screenshot(name)
        for part in page.js("return [...document.querySelectorAll('main > section')]"
                            ".map((s) => s.id)"):
            page.screenshot(f"{name}-{part}", f"#{part}")
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
