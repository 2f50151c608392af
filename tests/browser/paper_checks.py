"""Checks of the founding paper on one page."""

import re

from checks import check, pick, plot, require


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
        require("did not measure" not in sentences[2], number, sentences[2])
        require(re.search(r"\d", sentences[2]), "no number in", sentences[2])
        canvas = page.find(f"#part-{number} :is(canvas, .curves)")
        ink = page.ink(canvas)
        require(ink["ink"] > 0.01 * ink["pixels"], number, "is blank", ink)
        if number > 1:
            require(page.find(f"#part-{number} .hero-number .number"), number, "no number")


@check
def the_slider_changes_the_figures(page):
    def seen():
        return page.ink(page.find("#part-2 canvas"))["hash"], part(page, 2)

    page.show("#part-2")
    first = seen()
    at = page.find('[data-control="figure-spp"]').get_attribute("value")
    pick(page, '[data-control="figure-spp"]', 1 if at == "0" else 0)
    page.show("#part-2")
    page.settle(20)
    other = seen()
    require(first[0] != other[0] and first[1] != other[1], "the picture is the same")


@check
def figure_8_has_curves_and_slopes(page):
    page.show("#part-8")
    require(page.ink(plot(page, "convergence"))["coloured"] > 800, "no curves")
    require(len(page.all("#part-8 .orders .whisker")) == 7, "not seven slopes")
