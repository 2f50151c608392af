"""Checks of the page of a small benchmark."""

import math

from checks import check, data, markers, plot, require


@check
def every_row_has_its_rate(page):
    rates = [row["samples_per_second"] for row in data(page)["rows"]]
    rows = page.js("return [...document.querySelectorAll('#rates .rate-row')].slice(1).map("
                   "(r) => r.querySelector('.whisker path').getBoundingClientRect().x)")
    require(len(rows) == len(rates) == 2, rows)
    require((rows[0] < rows[1]) == (rates[0]["value"] < rates[1]["value"]) or
            abs(rows[0] - rows[1]) < 1, rows, rates)
    text = page.find("#rates").text
    require(text.count("[") == 2, "an interval for each:", text)


@check
def warnings_of_the_terminal_are_on_the_page(page):
    warnings = data(page)["warnings"]
    require(warnings, "the test's bench has medians that are not known well enough")
    for warning in warnings:
        require(warning in page.find("#summary .warnings").text, warning)


@check
def efficiency_is_drawn(page):
    page.scroll_through()
    rows = data(page)["rows"]
    (curve,) = markers(page, "efficiency")
    require([x for x, _ in curve] == [1, 2], "threads:", curve)
    for (_, y), row in zip(curve, rows):
        require(math.isclose(y, row["parallel_efficiency"]["value"]), y, row)
    require(page.ink(plot(page, "efficiency"))["coloured"] > 100, "a blank plot")


@check
def bars_are_the_groups(page):
    groups = data(page)["rows"][0]["groups"]
    total = sum(group["ns_per_sample"] for group in groups)
    parts = page.js("return [...document.querySelectorAll('#groups .bar-part')].map((p) =>"
                    "[p.ariaLabel, p.offsetWidth / p.parentNode.offsetWidth])")
    for label, share in parts:
        name = next(g["name"] for g in groups
                    if label.startswith(g["name"] + " "))
        own = next(g["ns_per_sample"] for g in groups if g["name"] == name)
        require(abs(share - own / total) < 0.02, label, share, own / total)
    require(len(parts) == sum(g["ns_per_sample"] > 0 for g in groups), "parts:", parts)
