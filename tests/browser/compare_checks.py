"""Checks of the page of a comparison, against the numbers that it holds."""

import re

from checks import NAMES, check, data, pick, require


def press(page, mode):
    page.click(f'#compare [data-value="{mode}"]')


def hashes(page):
    return [page.ink(canvas)["hash"] for canvas in page.all("#compare canvas.pane")]


NAMES += ["</script><b>ref</b>.exr", 'noisy "&".exr']


@check
def verdicts_are_said(page):
    text = page.find("#summary").text
    for comparison in data(page)["comparisons"]:
        require(comparison["verdict"] in text, "missing:", comparison["verdict"])
    require("the difference is not significant" in text, "no agreement:", text)
    require("the difference is significant" in text, "no difference:", text)


@check
def every_canvas_draws(page):
    page.scroll_through()
    canvases = page.all("canvas.picture, canvas.pane, canvas.ramp")
    require(len(canvases) > 30, "only", len(canvases), "pictures")
    for canvas in canvases:
        ink = page.ink(canvas)
        require(ink["ink"] > 0.9 * ink["pixels"], canvas.get_attribute("aria-label"), ink)


@check
def modes_differ(page):
    seen = set()
    for mode, panes in (("side", 2), ("slider", 1), ("flip", 1), ("difference", 1)):
        press(page, mode)
        shown = hashes(page)
        require(len(shown) == panes, mode, "has", len(shown), "panes")
        require(not seen & set(shown), mode, "looks like another")
        seen.update(shown)
    press(page, "side")


@check
def flip_shows_the_other(page):
    press(page, "flip")
    first = hashes(page)
    page.click("#compare [data-flip]")
    require(hashes(page) != first, "nothing flipped")
    page.click("#compare [data-flip]")
    require(hashes(page) == first, "it did not flip back")


@check
def the_slider_slides(page):
    press(page, "slider")
    seen = [hashes(page)]
    handle = page.find("#compare .split")
    for _ in range(5):
        handle.send_keys("\ue014")  # the right arrow
    page.settle()
    require(handle.get_attribute("aria-valuenow") == "60", "not at 60 %")
    seen.append(hashes(page))
    require(seen[0] != seen[1], "nothing slid")


@check
def the_difference_has_a_scale_that_fits(page):
    press(page, "difference")
    comparison = data(page)["comparisons"][0]
    scale = page.find("#compare .ramp-texts").text
    end = float(re.search(r"\+([\d.]+) %", scale)[1]) / 100
    # All but one in fifty of the pixels are below: their root mean square is, too.
    require(0.3 * comparison["relmse"] ** 0.5 < end < 5 * comparison["relmse"] ** 0.5,
            "the scale ends at", end, "and the error is", comparison["relmse"] ** 0.5)
    spread = page.js("""const c = document.querySelector('#compare canvas.pane'),
        d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
      let red = 0, blue = 0;
      for (let i = 0; i < d.length; i += 4) {
        if (d[i] > d[i + 2] + 40) ++red; else if (d[i + 2] > d[i] + 40) ++blue;
      }
      return [4 * red / d.length, 4 * blue / d.length];""")
    require(min(spread) > 0.15, "red and blue parts:", spread)


@check
def kinds_of_difference_differ(page):
    press(page, "difference")
    options = page.js("return [...document.querySelector('[data-control=\"difference\"]')"
                      ".options].map((o) => o.value)")
    require(options == ["difference", "relative", "absolute", "flip-hdr", "flip-ldr"],
            options)
    seen = set()
    for option in options:
        pick(page, '[data-control="difference"]', option)
        seen.update(hashes(page))
    require(len(seen) == len(options), "some look alike:", seen)


@check
def values_under_the_pointer_are_the_maps(page):
    from selenium.webdriver.common.action_chains import ActionChains
    press(page, "difference")
    pick(page, '[data-control="difference"]', "flip-hdr")
    page.show("#compare")
    ActionChains(page.driver).move_to_element(page.find("#compare canvas.pane")).perform()
    page.settle()
    text = page.find("#compare .readout").text
    x, y = map(int, re.search(r"Pixel\s+(\d+), (\d+)", text).groups())
    value = page.js("const m = findImage(study.comparisons[0].maps['flip-hdr']);"
                    "return channelAt(m, arguments[1] * m.width + arguments[0], 0)", x, y)
    shown = float(text.split()[-1])
    require(abs(shown - value) <= 0.006 * max(value, 0.1), shown, "is not", value)
    pick(page, '[data-control="difference"]', "difference")


@check
def zoom_goes_to_a_tile(page):
    press(page, "side")
    before = hashes(page)
    page.click("#tiles .worst-tile button")
    page.settle()
    require(hashes(page) != before, "nothing moved")
    zoom = float(page.find("#compare .comparator").get_attribute("data-zoom"))
    require(zoom > 2, "zoom is", zoom)
    page.find("#compare canvas.pane").send_keys("0")
    page.settle()
    require(hashes(page) == before, "0 does not show all")


@check
def tiles_beyond_noise_are_said(page):
    for group, comparison in zip(page.all("#tiles .tiles-of"), data(page)["comparisons"]):
        failed = len(comparison["agreement"]["tiles"]["failed"])
        said = f"{failed} of" if failed else "no tile differs"
        require(said in group.text, "not said:", said)
    require(data(page)["comparisons"][1]["agreement"]["tiles"]["failed"], "none planted")


@check
def numbers_are_those_of_the_data(page):
    rows = page.js("return [...document.querySelectorAll('#numbers tbody tr')].map((r) =>"
                   "[...r.children].map((c) => c.textContent))")
    table = {row[0]: row[1:] for row in rows}
    for i, comparison in enumerate(data(page)["comparisons"]):
        require(table["Test result"][i] == comparison["agreement"]["verdict"], table)
        shown = float(table["FLIP at all exposures, mean"][i])
        require(abs(shown - comparison["flip"]["hdr"]["mean"]) < 0.001, table)


@check
def histograms_hold_all_pixels(page):
    page.scroll_through()
    paths = page.all("#histograms .curve")
    require(len(paths) == 5, len(paths), "lines")
    require(all(len(p.get_attribute("d")) > 200 for p in paths), "an empty line")
