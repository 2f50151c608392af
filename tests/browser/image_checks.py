"""Checks of pictures and the comparator."""

import re

from checks import check, pick, require


@check
def other_canvases_are_drawn(page):
    page.scroll_through()
    canvases = page.all("canvas.picture, canvas.pane, canvas.ramp")
    require(len(canvases) > 20, "only", len(canvases), "pictures")
    for canvas in canvases:
        ink = page.ink(canvas)
        label = canvas.get_attribute("aria-label")
        require(ink["ink"] > 0.9 * ink["pixels"], label, "is blank:", ink)


def choose_images(page, a, b):
    pick(page, '[data-slot="a"]', a)
    pick(page, '[data-slot="b"]', b)


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
    pick(page, '[data-control="exposure"]', 1.5)
    seen.append(page.ink(page.find("#compare canvas.pane"))["hash"])
    for tone in ("reinhard", "filmic", "false"):
        pick(page, '[data-control="tone"]', tone)
        seen.append(page.ink(page.find("#compare canvas.pane"))["hash"])
    require(len(set(seen)) == 5, "some looks are equal:", seen)
    page.screenshot("comparator-false-colour", "#compare")
    page.reset()


@check
def pixel_values_under_the_pointer(page):
    from selenium.webdriver.common.action_chains import ActionChains
    page.show("#compare")
    ActionChains(page.driver).move_to_element(page.find("#compare canvas.pane")).perform()
    page.settle()
    text = page.find("#compare .readout").text
    require(re.search(r"Pixel \d+, \d+", text), "the read-out says:", repr(text))
    require(len(re.findall(r"\d\.\d+", text)) >= 7, "too few values:", repr(text))
