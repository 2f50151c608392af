"""Checks of the page of `lanelight live` as a whole: files, sizes, its end."""

import pathlib
import tempfile
import time

import browser
import live_program
from checks import check, pictures, require
from live_checks import choose, fresh, until

WIDTHS = (390, 1440, 1920)


def saved(page, selector, suffix):
    """The bytes of the file that the button saves."""
    with tempfile.TemporaryDirectory() as folder:
        page.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {
            "behavior": "allow", "downloadPath": folder})
        page.click(selector)
        for _ in range(600):
            files = list(pathlib.Path(folder).glob(f"*{suffix}"))
            if files:
                time.sleep(0.2)
                return files[0].read_bytes()
            time.sleep(0.05)
    raise AssertionError(f"no {suffix} has been saved")


@check
def files_are_saved(page):
    fresh(page)
    require(saved(page, "#save-exr-a", ".exr")[:4] == b"\x76\x2f\x31\x01", "no EXR")
    require(saved(page, "#save-png", ".png")[:4] == b"\x89PNG", "no PNG")


@check
def the_command_line_and_the_camera_are_told(page):
    page.click("#copy-command")
    text = until(page, "return document.querySelector('#copied').textContent", "nothing")
    require(text.startswith("lanelight render ") and "--strategy directions=" in text and
            "--resolution 160x120" in text, text)
    page.click("#copy-camera")
    until(page, "return document.querySelector('#copied').textContent.includes("
          "'Camera \"perspective\"')", "no camera")


@check
def two_pages_have_their_own_cameras(page):
    first = page.driver.current_window_handle
    page.driver.switch_to.new_window("tab")
    try:
        page.driver.get(page.url)
        until(page, "return page.state?.slots[0].spp >= 2", "no second page")
        page.js("page.onEye({...page.eye, fov: 70})")
        until(page, "return page.state.moved", "it does not move")
    finally:
        page.driver.close()
        page.driver.switch_to.window(first)
    time.sleep(0.5)
    require(not page.js("return page.state.moved"), "the first page has moved too")
    before = page.js("return page.state.slots[0].spp")
    until(page, f"return page.state.slots[0].spp > {before}", "the first page stands")


@check
def every_width_holds_the_page(page):
    page.click("#pause")  # drawing the picture takes long where it is wide
    until(page, "return page.state.paused", "it goes on")
    for width in WIDTHS:
        for scheme in ("light", "dark"):
            page.resize(width, 900, mobile=width < 500)
            page.prefer(scheme)
            page.settle()
            over = page.js("return document.documentElement.scrollWidth - innerWidth")
            require(over <= 0, f"at {width} it is {over} wider than the window")
            outside = page.js("""
                return [...document.querySelectorAll('main *')]
                  .filter((e) => e.getBoundingClientRect().right > innerWidth + 1)
                  .map((e) => e.tagName + '.' + e.className).slice(0, 5)""")
            require(not outside, f"at {width} cut off:", outside)
    page.click("#pause")


@check
def everything_is_reached_by_keys(page):
    named = page.js("""
        return [...document.querySelectorAll('main button, main select, main input')]
          .filter((e) => !(e.getAttribute('aria-label') || e.innerText || e.title ||
                           e.closest('label')))
          .map((e) => e.outerHTML.slice(0, 80))""")
    require(not named, "without a name:", named)
    require(page.js("document.querySelector('#picture').focus();"
                    "return document.activeElement.id") == "picture", "no focus")


@pictures
def as_it_looks(page):
    fresh(page)
    page.click('[data-preset="paper-importance default"]')
    until(page, "return page.state.slots[1].looks?.length > 6", "no errors")
    for width in WIDTHS:
        for scheme in ("light", "dark"):
            page.resize(width, 900, mobile=width < 500)
            page.prefer(scheme)
            page.settle(20)
            page.screenshot(f"live-{width}-{scheme}")
    page.prefer("light")


@check
def without_webgl_2_it_says_so(page):
    script = page.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {
        "source": "HTMLCanvasElement.prototype.getContext = () => null"})
    page.open()
    until(page, "return document.querySelector('main .wait')?.innerText.includes('WebGL 2')",
          "nothing")
    page.driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument",
                                {"identifier": script["identifier"]})


@check
def minutes_of_use_leave_no_memory(page):
    fresh(page)
    page.resize(400, 300)  # a small picture is drawn fast
    program = live_program.THE_ONE[0]

    def use():
        for name in ("paper-plain", "default", "points=halton", "points=stratified"):
            page.js("page.cards[0].choose(arguments[0])", name)
            for i in range(5):
                page.js("page.onEye({...page.eye, fov: 40 + arguments[0]})", i)
                time.sleep(0.05)
        choose(page, "#layer", "error")
        choose(page, "#layer", "colour")
    use()
    before = program.memory()
    rounds = 6 if browser.PICTURES else 2
    for _ in range(rounds):
        use()
    grown = program.memory() - before
    require(grown < rounds * (5 << 20), f"{grown >> 20} MiB more after use")


@check
def it_says_goodbye(page):
    fresh(page)
    page.js("globalThis.before = page.state.slots[0].spp")
    errors = [message for message in page.console() if "ReadPixels" not in message]
    require(not errors, errors)
    out, err, code = live_program.THE_ONE[0].interrupt()
    require(code == 0 and "has stopped" in out and "stopping" in err, out, err, code)
    text = until(page, "return document.querySelector('#closed')?.innerText", "no word")
    require("lanelight has exited" in text, text)
