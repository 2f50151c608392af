"""Checks of every page of numbers."""

import json
import re
import time

from checks import NAMES, STATES, check, pictures, require, theme


def states(page):
    """Shows the page in each of the ways in which it can be seen."""
    page.open()
    for number, enter in enumerate(STATES or [lambda _: None]):
        enter(page)
        page.draw_all()
        yield number


def require_width(page, width, height, where):
    page.resize(width, height, mobile=width < 500)
    page.settle()
    full = page.js("return document.documentElement.scrollWidth")
    wide = page.js("""
        return [...document.querySelectorAll('main *')].filter((e) =>
          e.getBoundingClientRect().right > innerWidth + 1 &&
          !e.closest('.scroll') && !e.closest('svg'))
          .slice(0, 3).map((e) => e.className || e.tagName)""")
    require(full <= width, "at", width, where, "is", full, "wide:", wide)


@check
def every_state_shows_names_as_text_and_fits_a_phone(page):
    """Numbers that are unknown are not shown."""
    missing = set(NAMES)
    for number in states(page):
        require(not page.all("main script, main b b, main b i, .tile b"), "markup from a name")
        missing -= {name for name in missing if name in page.text()}
        page.js("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
        text = page.text() + " ".join(page.js("""
            return [...document.querySelectorAll('[aria-label], [title]')].map((e) =>
              `${e.getAttribute('aria-label') || ''} ${e.title || ''}`)"""))
        found = re.search(r".{0,40}\b(NaN|undefined|null|Infinity)\b.{0,40}|\[object", text)
        require(not found, "state", number, "says", found and found[0])
        wrong = page.js("""
            return [...document.querySelectorAll('svg *')].filter((e) =>
              [...e.attributes].some((a) => /NaN|undefined|null|Infinity/.test(a.value)))
              .slice(0, 3).map((e) => e.outerHTML)""")
        require(not wrong, "state", number, "draws", wrong)
        require_width(page, 360, 740, f"state {number}")
        page.resize(1280, 900)
    require(not missing, "is not shown:", missing)


@check
def nothing_is_wider_than_the_window(page):
    for opened, resized in (((360, 740), (390, 844)), ((1920, 1080), (1440, 900))):
        page.resize(*opened, mobile=opened[0] < 500)
        page.open()
        page.draw_all()
        require_width(page, *opened, "when opened")
        require_width(page, *resized, "when resized")


def require_theme_when_opened(page, wanted, what):
    """Opens the page again until it has that theme. A page may run in another process than
    the one before it, and what that one has stored arrives there late on a busy machine."""
    for _ in range(20):
        page.open()
        if theme(page) == wanted:
            return
        time.sleep(0.25)
    raise AssertionError(what)


@check
def dark_changes_everything(page):
    page.open()
    page.draw_all()

    def colours():
        drawing = page.find("main svg, main canvas.pane")
        return (page.js("return getComputedStyle(document.body).backgroundColor"),
                page.ink(drawing)["hash"] if drawing.tag_name == "svg" else None)

    light = colours()
    page.click("#theme")
    require(theme(page) == "dark", "not dark")
    dark = colours()
    require(all(a != b or a is None for a, b in zip(light, dark)), "stayed light", light, dark)
    require_theme_when_opened(page, "dark", "forgotten")
    page.click("#theme")
    page.js("localStorage.clear()")
    page.prefer("dark")
    require_theme_when_opened(page, "dark", "the system's preference is ignored")
    page.prefer("light")
    page.reset()


@pictures
def screenshots(page):
    for width, scheme in ((390, "light"), (390, "dark"), (1440, "light"), (1920, "dark")):
        page.resize(width, 900, mobile=width < 500)
        page.prefer(scheme)
        for number in states(page):
            page.screenshot(f"{width}-{scheme}-{number}", "body")


@check
def nothing_is_fetched(page):
    for entry in page.driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            url = message["params"]["request"]["url"]
            require(url.startswith(("file:", "data:", "about:", "blob:")), "fetches", url)


@check
def console_is_silent(page):
    require(not page.console(), "\n".join(page.console()))
