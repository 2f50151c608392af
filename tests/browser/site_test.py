#!/usr/bin/env python3
"""Makes the site of the documentation and looks at it in Chromium, from the disk:
site_test.py MAKE LANELIGHT FOLDER

MAKE is docs/site/make; pictures of the gallery are left out. Skipped without mkdocs.
"""

import pathlib
import shutil
import subprocess
import sys

import browser
from checks import require

WIDTHS = {390: 844, 1440: 900, 1920: 1080}


def make(maker, lanelight, folder):
    if not shutil.which("mkdocs"):
        browser.skip("mkdocs is not installed")
    subprocess.run([maker, lanelight, folder, "--without-pictures"], check=True)
    return folder / "site"


def silent(page, where):
    require(not page.console(), where, "\n".join(page.console()))


def check_widths(page):
    """Checks that the page fits every screen: what is wider scrolls by itself."""
    for width, height in WIDTHS.items():
        page.resize(width, height, mobile=width < 500)
        wide = page.js("return document.documentElement.scrollWidth")
        require(wide <= width, page.driver.current_url, "is", wide, "pixels wide")


def check_menu(page):
    require(page.js("return document.querySelector('.wy-nav-side')"
                    ".getBoundingClientRect().right") <= 0, "the menu is open")
    page.click("#menu")
    page.settle(25)
    left = page.js("return document.querySelector('.wy-nav-side').getBoundingClientRect().x")
    require(left >= 0, "the menu does not open:", left)
    page.click("#menu")


def check_tables(page):
    """A wide table scrolls within the page, which does not."""
    scrolls = page.js(
        "return [...document.querySelectorAll('.rst-content table')].map((t) => {"
        "t.scrollLeft = 50; return [t.scrollWidth > t.clientWidth + 1, t.scrollLeft > 0] })")
    require(any(wide for wide, _ in scrolls), "no table is wide")
    require(all(moved for wide, moved in scrolls if wide), "a wide table does not scroll")


def check_search(page):
    page.js("document.getElementById('search').focus()")
    field = page.find("#search")
    field.send_keys("confidence sequence")
    page.settle(40)
    titles = page.js("return [...document.querySelectorAll('#found a')].map((a) => a.href)")
    require(any("live.html" in href for href in titles), "not found:", titles)
    page.driver.get(titles[0])
    page.settle()
    silent(page, "a page that was found")


def check_colours(page):
    brightness = ("const [r, g, b] = getComputedStyle(document.querySelector("
                  "'.wy-nav-content')).backgroundColor.match(/\\d+/g).map(Number);"
                  "return (r + g + b) / 3")
    page.prefer("light")
    require(page.js(brightness) > 200, "light colours")
    page.prefer("dark")
    require(page.js(brightness) < 60, "the system's dark colours")
    page.click("#colours")
    require(page.js(brightness) > 200, "the button does not lighten")
    page.click("#colours")
    require(page.js(brightness) < 60, "the button does not darken")
    page.prefer("light")
    page.click("#colours")


def main():
    maker, lanelight, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    site = make(maker, lanelight, folder)
    driver = browser.start(logs=("browser",))
    try:
        page = browser.Page(driver, str(site / "index.html"), folder / "screenshots")
        pages = sorted(site.rglob("*.html"))
        require(len(pages) > 20, "pages:", len(pages))
        for path in pages:
            page.driver.get(path.resolve().as_uri())
            check_widths(page)
            silent(page, path)
        for width, height in WIDTHS.items():
            page.resize(width, height, mobile=width < 500)
            page.url = (site / "index.html").resolve().as_uri()
            page.open()
            page.screenshot(f"front-{width}")
            page.url = (site / "docs/study.html").resolve().as_uri()
            page.open()
            if width < 500:
                check_menu(page)
                check_tables(page)
                page.click("#menu")
                page.settle(25)
                page.screenshot(f"menu-{width}")
                page.click("#menu")
            page.screenshot(f"study-{width}")
        check_search(page)
        page.open()
        check_colours(page)
        page.prefer("dark")
        page.js("document.documentElement.dataset.colours = 'dark'")
        page.screenshot("dark-1920")
        silent(page, "at the end")
    finally:
        driver.quit()
    print(f"{len(pages)} pages at {len(WIDTHS)} widths; screenshots: {page.folder}")


main()
