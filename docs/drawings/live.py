#!/usr/bin/env python3
"""Takes docs/live.png and docs/live-steps.png: live.py LANELIGHT

Screenshots of the page of `lanelight live` on the Cornell box. Needs chromium and selenium, as
the checks of tests/browser do. Images differ between runs, since they refine with time.
"""

import base64
import pathlib
import sys
import tempfile

DOCS = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(DOCS.parent / "tests/browser"))

import browser  # noqa: E402
import live_program  # noqa: E402
from live_checks import actions, choose, drag, picture, until  # noqa: E402

SIZE = (1280, 722)


def wait_for_samples(page, count):
    until(page, f"return page.state?.slots[0].spp >= {count}", seconds=120)
    page.settle()


def steps(page):
    """Yields the name of each step once the page shows it."""
    wait_for_samples(page, 2)
    yield "start"
    drag(page, 120, 40)
    until(page, "return page.state.moved")
    wait_for_samples(page, 8)
    yield "orbit"
    page.click("#home")
    page.click('[data-preset="paper-importance default"]')
    until(page, "return page.state.slots[1].looks?.length > 5 && page.state.ratio?.ahead",
          seconds=120)
    actions(page).move_to_element(picture(page)).perform()
    until(page, "return document.querySelector('#readout .readout-row')")
    yield "compare"
    choose(page, "#layer", "relative")
    until(page, "const r = page.range(); return r && r[1] > r[0]")
    page.settle()
    yield "relative"
    choose(page, "#layer", "colour")
    page.click('#tools [data-value="pan"]')
    picture(page).send_keys("++++++")
    page.settle()
    yield "pixels"
    page.show("#stages")
    yield "stages"


def sheet(page, names):
    """Takes the picture of all steps, in two columns."""
    images = "".join(
        '<img width=500 src="data:image/png;base64,{}">'.format(
            base64.b64encode((page.folder / f"{name}.png").read_bytes()).decode())
        for name in names)
    at = page.folder / "sheet.html"
    at.write_text("<style>body{margin:0;display:grid;grid-template-columns:500px 500px;gap:8px;"
                  f"width:1008px}}</style><body>{images}")
    page.resize(1008, 900)
    page.driver.get(at.as_uri())
    page.settle()
    rows = (len(names) + 1) // 2
    page.resize(1008, rows * (round(500 * SIZE[1] / SIZE[0]) + 8) - 8)
    page.settle()
    page.screenshot("live-steps")


def main():
    driver = browser.start(browser.WEBGL_FLAGS, ("browser",))
    try:
        with live_program.running(sys.argv[1]) as program, \
                tempfile.TemporaryDirectory() as folder:
            page = browser.Page(driver, program.address, folder)
            page.resize(*SIZE)
            page.open()
            names = []
            for name in steps(page):
                page.screenshot(name)
                names.append(name)
            sheet(page, names)
            for source, name in (("compare", "live"), ("live-steps", "live-steps")):
                (DOCS / f"{name}.png").write_bytes((page.folder / f"{source}.png").read_bytes())
    finally:
        driver.quit()


if __name__ == "__main__":
    main()
