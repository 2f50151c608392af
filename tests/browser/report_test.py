#!/usr/bin/env python3
"""Looks at the synthetic report in Chromium: report_test.py REPORT.html SCREENSHOT_FOLDER

Checks that everything draws and works, writes screenshots, and ends with 1 if a check
failed, with 77 where Chromium or Selenium is missing.
"""

import json
import re
import sys
import traceback

import browser

CHECKS = []


def check(function):
    CHECKS.append(function)
    return function


def require(condition, *what):
    if not condition:
        raise AssertionError(" ".join(str(part) for part in what))


def visible_text(page):
    return page.js("return document.body.innerText")


def plot(page, name):
    return page.find(f'[data-plot="{name}"] canvas')


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
def other_canvases_are_drawn(page):
    page.scroll_through()
    canvases = page.all("canvas.picture, canvas.pane, canvas.ramp")
    require(len(canvases) > 20, "only", len(canvases), "pictures")
    for canvas in canvases:
        ink = page.ink(canvas)
        label = canvas.get_attribute("aria-label")
        require(ink["ink"] > 0.9 * ink["pixels"], label, "is blank:", ink)


@check
def legend_toggles_curves(page):
    page.show("#curves")
    before = [page.ink(plot(page, name)) for name in ("seconds", "spp")]
    page.click(".legend-item")
    require(page.find(".legend-item").get_attribute("aria-pressed") == "false", "not released")
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
    page.js("""
      const host = document.querySelector('[data-plot="spp"]'), u = host.plot;
      const at = u.data[0].length - 1, box = u.over.getBoundingClientRect();
      const init = {bubbles: true, clientX: box.left + u.valToPos(u.data[0][at], 'x'),
                    clientY: box.top + u.valToPos(u.data[1][at], 'y')};
      u.over.dispatchEvent(new MouseEvent('mouseenter', init));
      u.over.dispatchEvent(new MouseEvent('mousemove', init));
      u.over.dispatchEvent(new MouseEvent('mousemove', init));""")
    page.settle()
    text = page.find("#tip").text
    require("64 spp" in text and "Relative MSE" in text, "the tip says:", repr(text))
    page.js("document.getElementById('tip').hidden = true")


@check
def dragging_zooms_a_plot(page):
    from selenium.webdriver.common.action_chains import ActionChains
    page.show("#curves")
    over = page.find('[data-plot="spp"] .u-over')
    scale = "const s = document.querySelector('[data-plot=\"spp\"]').plot.scales.x;" \
            "return s.max / s.min"
    before = page.js(scale)
    ActionChains(page.driver).move_to_element_with_offset(over, -60, -60).click_and_hold() \
        .move_by_offset(110, 110).release().perform()
    page.settle()
    require(page.js(scale) < 0.5 * before, "no zoom:", page.js(scale), before)
    ActionChains(page.driver).double_click(over).perform()
    page.settle()
    require(abs(page.js(scale) / before - 1) < 1e-9, "double-click did not show all")


@check
def table_sorts(page):
    def column():
        return page.js("return [...document.querySelectorAll('#ranking tbody tr')]"
                       ".map((row) => row.cells[4]).filter((c) => !c || c.colSpan === 1)"
                       ".filter(Boolean).map((c) => c.querySelector('.value').textContent)")

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
        require(page.find(f'#ranking th[aria-sort="{order}"]'), "no aria-sort", order)
    last = page.js("return document.querySelector('#ranking tbody tr:last-child').innerText")
    require("Failed" in last, "failed strategies are not last:", last)
    page.click('#ranking [data-key="rank"]')


def choose_images(page, a, b):
    page.js("""for (const [slot, value] of [['a', arguments[0]], ['b', arguments[1]]]) {
      const select = document.querySelector(`[data-slot="${slot}"]`);
      select.value = value;
      select.dispatchEvent(new Event('change'));
    }""", a, b)
    page.settle()


@check
def comparator_modes_draw(page):
    page.show("#compare")
    choose_images(page, "cornell-0-one", "cornell-reference")
    seen = set()
    for mode, panes in (("side", 2), ("slider", 1), ("flip", 1), ("difference", 1)):
        page.click(f'#compare [data-value="{mode}"]')
        canvases = page.all("#compare canvas.pane")
        require(len(canvases) == panes, mode, "has", len(canvases), "panes")
        for canvas in canvases:
            ink = page.ink(canvas)
            require(ink["ink"] > 0.9 * ink["pixels"], mode, "is blank:", ink)
            require(ink["hash"] not in seen, mode, "looks like another one")
            seen.add(ink["hash"])
        page.screenshot(f"comparator-{mode}", "#compare")
    page.click('#compare [data-value="side"]')


@check
def zoom_is_in_sync(page):
    page.click('#compare [data-value="side"]')
    choose_images(page, "cornell-0-one", "cornell-0-one")

    def panes():
        return [page.ink(canvas)["hash"] for canvas in page.all("#compare canvas.pane")]

    start = panes()
    require(start[0] == start[1], "equal images look different")
    page.settle(30)  # a wheel just after scrolling would scroll on
    page.js("""const c = document.querySelector('canvas.pane'),
               b = c.getBoundingClientRect(), x = b.left + b.width * 0.3,
               y = b.top + b.height * 0.4;
      performance.now = () => 1e9;
      c.dispatchEvent(new WheelEvent('wheel', {deltaY: -500, clientX: x, clientY: y,
                                               bubbles: true, cancelable: true}));
      delete performance.now;""")
    page.settle()
    zoomed = panes()
    require(zoomed[0] != start[0], "the wheel did not zoom")
    require(zoomed[0] == zoomed[1], "the panes show different parts")
    from selenium.webdriver.common.action_chains import ActionChains
    ActionChains(page.driver).drag_and_drop_by_offset(
        page.all("#compare canvas.pane")[1], 40, 25).perform()
    page.settle()
    dragged = panes()
    require(dragged[0] != zoomed[0], "dragging did not move")
    require(dragged[0] == dragged[1], "the panes moved apart")
    page.all("#compare canvas.pane")[0].send_keys("0")
    page.settle()
    require(panes() == start, "0 does not show all")
    page.find('#compare [aria-label="Zoom in"]').click()
    page.settle()
    require(panes()[0] != start[0], "the button does not zoom")
    page.all("#compare canvas.pane")[0].send_keys("0")
    page.settle()


@check
def exposure_and_tone_change_pixels(page):
    page.show("#compare")
    seen = [page.ink(page.find("#compare canvas.pane"))["hash"]]
    page.js("""const e = document.querySelector('[data-control="exposure"]');
      e.value = 1.5; e.dispatchEvent(new Event('input'));""")
    page.settle()
    seen.append(page.ink(page.find("#compare canvas.pane"))["hash"])
    for tone in ("reinhard", "filmic", "false"):
        page.js("""const t = document.querySelector('[data-control="tone"]');
          t.value = arguments[0]; t.dispatchEvent(new Event('change'));""", tone)
        page.settle()
        seen.append(page.ink(page.find("#compare canvas.pane"))["hash"])
    require(len(set(seen)) == 5, "some looks are equal:", seen)
    page.screenshot("comparator-false-colour", "#compare")
    page.open()


@check
def pixel_values_under_the_pointer(page):
    from selenium.webdriver.common.action_chains import ActionChains
    page.show("#compare")
    ActionChains(page.driver).move_to_element(page.find("#compare canvas.pane")).perform()
    page.settle()
    text = page.find("#compare .readout").text
    require(re.search(r"Pixel \d+, \d+", text), "the read-out says:", repr(text))
    require(len(re.findall(r"\d\.\d+", text)) >= 7, "too few values:", repr(text))


@check
def scenes_switch(page):
    names = [tab.text for tab in page.all("#scenes a")]
    require(len(names) == 4, "tabs:", names)
    for index, name in enumerate(names):
        page.js("document.querySelectorAll('#scenes a')[arguments[0]].click()", index)
        page.settle()
        require(page.find("#content").get_attribute("data-scene") == name, "not", name)
        require(page.find("h1").text == name, "wrong title for", name)
        page.scroll_through()
        page.driver.refresh()
        page.settle()
        require(page.find("h1").text == name, name, "is not remembered")
    page.open()


@check
def hostile_names_are_text(page):
    require(page.js("return document.querySelectorAll('main b b, main script').length") == 0,
            "markup from a name")
    require("</script><b>\"bold\"" in visible_text(page), "the name is not shown as it is")


@check
def nothing_unknown_is_spelled_out(page):
    for index in range(4):
        page.js("document.querySelectorAll('#scenes a')[arguments[0]].click()", index)
        page.settle()
        page.scroll_through()
        page.js("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
        text = visible_text(page) + " ".join(page.js(
            "return [...document.querySelectorAll('[aria-label], [title]')].map((e) =>"
            "(e.getAttribute('aria-label') || '') + ' ' + (e.title || ''))"))
        found = re.search(r".{0,40}\b(NaN|undefined|null|Infinity)\b.{0,40}|\[object", text)
        require(not found, "scene", index, "says", found and found[0])
    page.open()


@check
def dark_changes_everything(page):
    page.show("#curves")
    before = page.ink(plot(page, "spp"))["hash"]
    light = page.js("return getComputedStyle(document.body).backgroundColor")
    page.click("#theme")
    require(page.js("return document.documentElement.dataset.theme") == "dark", "not dark")
    dark = page.js("return getComputedStyle(document.body).backgroundColor")
    require(light != dark, "the background stayed", light)
    require(page.ink(plot(page, "spp"))["hash"] != before, "the plot stayed light")
    page.driver.refresh()
    page.settle()
    require(page.js("return document.documentElement.dataset.theme") == "dark", "forgotten")
    page.click("#theme")
    page.js("localStorage.clear()")
    page.prefer("dark")
    page.open()
    require(page.js("return document.documentElement.dataset.theme") == "dark",
            "the system's wish is ignored")
    page.prefer("light")
    page.open()


@check
def a_phone_scrolls_down_only(page):
    page.resize(360, 740, mobile=True)
    for index in range(4):
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
      return o.takeRecords().reduce((s, e) => s + (e.hadRecentInput ? 0 : e.value), 0);""")
    require(shift < 0.02, "layout shift", shift)


@check
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


def main():
    path, folder = sys.argv[1:3]
    driver = browser.start()
    failed = 0
    try:
        page = browser.Page(driver, path, folder)
        page.prefer("light")
        page.open()
        chosen = sys.argv[3:]
        for function in CHECKS:
            if chosen and function.__name__ not in chosen:
                continue
            try:
                function(page)
                print("ok    ", function.__name__)
            except Exception as error:  # one failed check must not hide the others
                failed += 1
                print("FAILED", function.__name__)
                print("       ", str(error).strip().replace("\n", "\n        "))
                if not isinstance(error, AssertionError):
                    traceback.print_exc()
        for message in page.console() if failed else []:
            print("console:", message)
    finally:
        driver.quit()
    print(f"{failed} failed; screenshots: {folder}")
    sys.exit(1 if failed else 0)


main()
