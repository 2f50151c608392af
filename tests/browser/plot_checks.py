"""Checks of plots and the table."""

import re

from checks import check, note_of, plot, require


@check
def plots_are_drawn(page):
    page.scroll_through()
    for name in ("seconds", "spp", "calibration"):
        canvas = plot(page, name)
        require(canvas, name, "has no canvas")
        ink = page.ink(canvas)
        require(ink["ink"] > 0.01 * ink["pixels"], name, "is blank:", ink)
        require(ink["coloured"] > 1500, name, "has no curves:", ink)


@check
def legend_toggles_curves(page):
    page.show("#curves")
    before = [page.ink(plot(page, name)) for name in ("seconds", "spp")]
    page.click(".legend-item")
    pressed = page.find(".legend-item").get_attribute("aria-pressed")
    require(pressed == "false", "not released")
    without = [page.ink(plot(page, name)) for name in ("seconds", "spp")]
    for a, b in zip(before, without):
        require(a["hash"] != b["hash"], "the plot did not change")
    page.click('[data-show="none"]')
    none = page.ink(plot(page, "spp"))
    require(none["coloured"] < 0.2 * before[1]["coloured"], "curves left:", none)
    page.click('[data-show="all"]')
    require(page.ink(plot(page, "spp"))["hash"] == before[1]["hash"], "not as before")


@check
def legend_takes_keys(page):
    from selenium.webdriver.common.keys import Keys
    item = page.find(".legend-item")
    item.send_keys(Keys.SPACE)
    require(item.get_attribute("aria-pressed") == "false", "space did nothing")
    item.send_keys(Keys.SPACE)
    require(item.get_attribute("aria-pressed") == "true", "space did not bring it back")


@check
def measure_changes_curves(page):
    page.show("#curves")
    before = page.ink(plot(page, "spp"))["hash"]
    page.click('#curves [data-value="rmse"]')
    require(page.ink(plot(page, "spp"))["hash"] != before, "RMSE looks as relative MSE")
    page.click('#curves [data-value="relmse"]')


@check
def hovering_a_marker_tells_its_values(page):
    page.show("#curves")
    text = note_of(page, '[data-plot="spp"] g[data-series] .marker:last-child')
    require("64 spp" in text and "Relative MSE" in text, "the tip says:", repr(text))


@check
def dragging_zooms_a_plot(page):
    from selenium.webdriver.common.action_chains import ActionChains
    page.show("#curves")
    over = page.find('[data-plot="spp"]')
    scale = ("const s = document.querySelector('[data-plot=\"spp\"]').plot.frame.scales"
            ".x; return s.to / s.from")
    before = page.js(scale)
    drag = ActionChains(page.driver).move_to_element_with_offset(over, -60, -60)
    drag.click_and_hold().move_by_offset(110, 110).release().perform()
    page.settle()
    require(page.js(scale) < 0.5 * before, "no zoom:", page.js(scale), before)
    ActionChains(page.driver).double_click(over).perform()
    page.settle()
    require(abs(page.js(scale) / before - 1) < 1e-9, "double-click did not show all")


@check
def table_sorts(page):
    def column():
        return page.js("const heads = [...document.querySelectorAll('#ranking thead th')];"
                       "const at = heads.findIndex((h) =>"
                       "h.querySelector('[data-key=\"relmse\"]'));"
                       "return [...document.querySelectorAll('#ranking tbody tr')]"
                       ".map((row) => row.cells[at]).filter((c) => c && c.colSpan === 1)"
                       ".map((c) => c.querySelector('.value').textContent)")

    def number(text):
        match = re.fullmatch(r"([\d.]+)(?: × 10(⁻?)([⁰¹²³⁴⁵⁶⁷⁸⁹]+))?", text)
        require(match, "not a number:", repr(text))
        exponent = 0
        for digit in match[3] or "":
            exponent = 10 * exponent + "⁰¹²³⁴⁵⁶⁷⁸⁹".index(digit)
        return float(match[1]) * 10 ** (-exponent if match[2] else exponent)

    page.show("#ranking")
    for sign, order in ((1, "ascending"), (-1, "descending")):
        page.click('#ranking [data-key="relmse"]')
        values = [sign * number(text) for text in column()]
        require(len(values) == 6 and values == sorted(values), order, values)
        require(len(set(values)) > 4, "a column of equal values:", values)
        require(page.find(f'#ranking th[aria-sort="{order}"]'), "no aria-sort", order)
    last = page.find("#ranking tbody tr:last-child").text
    require("Failed" in last, "failed strategies are not last:", last)
    page.click('#ranking [data-key="rank"]')
