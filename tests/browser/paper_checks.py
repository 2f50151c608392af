"""Checks of the founding paper on one page."""

import re

from checks import check, pictures, plot, require


def part(page, number):
    return page.find(f"#part-{number}").text


@check
def every_figure_has_picture_number_and_sentences(page):
    page.scroll_through()
    for number in range(1, 9):
        text = part(page, number)
        require(f"Figure {number}." in text, number, "has no caption:", text)
        sentences = page.js("return [...document.querySelectorAll(arguments[0])]"
                            ".map((p) => p.textContent)", f"#part-{number} p")
        require(len(sentences) == 3, number, "says", sentences)
        require("Nothing was found" not in sentences[2], number, sentences[2])
        require(re.search(r"\d", sentences[2]), "no number in", sentences[2])
        canvas = page.find(f"#part-{number} :is(canvas, .curves)")
        ink = page.ink(canvas)
        require(ink["ink"] > 0.01 * ink["pixels"], number, "is blank", ink)
        if number > 1:
            require(page.find(f"#part-{number} .hero-number .number"), number, "no number")
    require(not re.search(r"\b(NaN|undefined|null|Infinity)\b|\[object", page.text()),
            "unknown values are spelled out")


@check
def the_slider_changes_the_figures(page):
    def seen():
        return page.ink(page.find("#part-2 canvas"))["hash"], part(page, 2)

    page.show("#part-2")
    first = seen()
    page.js("const s = document.querySelector('[data-control=\"figure-spp\"]');"
            "s.value = s.value === '0' ? 1 : 0; s.dispatchEvent(new Event('input'));")
    page.show("#part-2")
    page.settle(20)
    other = seen()
    require(first[0] != other[0] and first[1] != other[1], "the picture is the same")


@check
def figure_8_has_curves_and_slopes(page):
    page.show("#part-8")
    require(page.ink(plot(page, "convergence"))["coloured"] > 800, "no curves")
    require(len(page.all("#part-8 .orders .whisker")) == 7, "not seven slopes")


@check
def it_scrolls_down_only(page):
    for width in (390, 1440, 1920):
        page.resize(width, 900, mobile=width < 500)
        page.open()
        page.scroll_through()
        require(page.js("return document.documentElement.scrollWidth") <= width,
                "scrolls sideways at", width)
    page.resize(1280, 900)
    page.open()


@check
def console_is_silent(page):
    require(not page.console(), "\n".join(page.console()))


@pictures
def screenshots(page):
    for width, scheme in ((390, "light"), (1440, "light"), (1920, "dark")):
        page.resize(width, 900, mobile=width < 500)
        page.prefer(scheme)
        page.open()
        page.scroll_through()
        page.screenshot(f"{width}-{scheme}", "body")
    page.prefer("light")
