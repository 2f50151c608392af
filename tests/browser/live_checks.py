"""Checks of the page of `lanelight live`: what it shows, and what its controls do."""

import time

import browser
from checks import check, pick, require


def until(page, script, *what, seconds=60):
    """Waits until the script returns something that is true."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if result := page.js(script):
            return result
        time.sleep(0.05)
    raise AssertionError(" ".join(str(part) for part in what) or script)


def actions(page):
    from selenium.webdriver.common.action_chains import ActionChains
    return ActionChains(page.driver, duration=20)


def picture(page):
    return page.find("#picture")


def drag(page, dx, dy, steps=4):
    chain = actions(page).move_to_element(picture(page)).click_and_hold()
    for _ in range(steps):
        chain.move_by_offset(dx // steps, dy // steps)
    chain.release().perform()


def choose(page, selector, value):
    from selenium.webdriver.support.ui import Select
    Select(page.find(selector)).select_by_value(value)
    page.settle()


def spp(page, slot=0):
    return page.js("return page.state?.slots[arguments[0]].spp || 0", slot)


def ink(page):
    """What is seen of the picture: what is drawn is gone with the frame."""
    return page.js("page.viewer.draw();" + browser.PLOT_INK, picture(page))


def fresh(page):
    """As it is when it has just been opened."""
    page.open()
    until(page, "return page.state?.slots[0].spp >= 4", "no samples come")


@check
def the_picture_refines(page):
    fresh(page)
    first = ink(page)
    require(first["coloured"] > 500, "no colours:", first)
    before = spp(page)
    until(page, f"return page.state.slots[0].spp > {before}", "it does not go on")
    require(ink(page)["hash"] != first["hash"], "it looks the same with more samples")


@check
def errors_are_told_with_intervals(page):
    until(page, "return page.state.slots[0].looks.length > 2", "no errors")
    text = page.text('#card-0 [data-fact="relmse"]')
    require("[" in text and "]" in text and "%" in text, text)
    require(page.js("return document.querySelector('#error-plot .bars').getAttribute('d')"),
            "no whiskers")


@check
def exposure_and_curves_are_the_pages_own(page):
    page.click("#pause")
    until(page, "return page.state.paused", "it goes on")
    time.sleep(0.5)
    seen = {ink(page)["hash"]}
    samples = spp(page)
    pick(page, "#exposure", 2)
    seen.add(ink(page)["hash"])
    for curve in ("filmic", "reinhard", "false"):
        choose(page, "#curve", curve)
        seen.add(ink(page)["hash"])
    require(len(seen) == 5, "some look alike:", seen)
    require(spp(page) == samples, "it has rendered meanwhile")
    page.click("#pause")


@check
def numbers_of_a_pixel(page):
    actions(page).move_to_element(picture(page)).perform()
    text = until(page, "return document.querySelector('#readout .readout-row')?.innerText",
                 "no numbers")
    require("±" in text and "samples" in text, text)
    where = page.text("#readout .where")
    x, y = (int(word) for word in where.removeprefix("pixel ").split(", "))
    require(abs(x - 80) <= 1 and abs(y - 60) <= 1, where)


@check
def the_mouse_turns_the_camera(page):
    fresh(page)
    before = page.js("return page.state.eye")
    drag(page, 80, 20)
    until(page, "return page.state.moved", "the camera has not moved")
    after = page.js("return page.state.eye")
    require(after["target"] == before["target"], "the target has moved")
    require(after["position"] != before["position"], "the camera has not")

    def arm(eye):
        return sum((a - b) ** 2 for a, b in zip(eye["position"], eye["target"]))
    require(abs(arm(after) / arm(before) - 1) < 1e-9, "its distance has changed")
    # The scene follows the mouse, to the right and down: the camera goes left and up.
    right = page.js("const {right} = axesOf(arguments[0], page.hello.mirrored);"
                    "return right", before)
    moved = [a - b for a, b in zip(after["position"], before["position"])]
    require(sum(a * b for a, b in zip(moved, right)) < 0, "it does not go left", moved)
    require(sum(a * b for a, b in zip(moved, before["up"])) > 0, "nor up", moved)
    require(page.js("return page.sender.latency.length") > 0, "no picture has come")
    until(page, "return page.state.slots[0].spp >= 4", "it does not refine")


@check
def the_wheel_keys_and_sliders_move_it(page):
    fresh(page)
    arm = "const e = page.state.eye; return vec.length(vec.sub(e.position, e.target))"
    before = page.js(arm)
    from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
    actions(page).scroll_from_origin(
        ScrollOrigin.from_element(picture(page)), 0, -100).perform()
    until(page, f"{arm} < {before} * 0.95", "the wheel does not go nearer")
    picture(page).send_keys("0")
    until(page, "return !page.state.moved", "0 does not go back")
    picture(page).send_keys("\ue012")  # the left arrow
    until(page, "return page.state.moved", "keys do not move the camera")
    page.click("#home")
    until(page, "return !page.state.moved", "the button does not go back")
    pick(page, "#fov", 60)
    until(page, "return page.state.eye.fov === 60", "the field of view is not 60")
    page.click("#home")


@check
def the_picture_zooms_to_pixels(page):
    page.click('#tools [data-value="pan"]')
    picture(page).send_keys("+++++")
    page.settle()
    zoom = float(picture(page).get_attribute("data-zoom"))
    require(zoom > 2, zoom)
    place = page.js("return page.look.place.x")
    drag(page, 60, 0)
    require(page.js("return page.look.place.x") < place, "it does not pan")
    require(not page.js("return page.state.moved"), "the camera has moved")
    picture(page).send_keys("0")
    page.settle()
    require(float(picture(page).get_attribute("data-zoom")) == 1, "0 does not go back")
    page.click('#tools [data-value="camera"]')


@check
def figures_of_the_paper_compare(page):
    fresh(page)
    require(len(page.all("[data-preset]")) == 8, "not all figures")
    page.click('[data-preset="paper-importance default"]')
    until(page, "return page.state.slots[1].looks?.length > 3 &&"
          " page.state.ratio?.value > 0", "no ratio")
    text = page.text("#score")
    require("[" in text and "Efficiency of B over A" in text, text)
    require(len(page.all("#error-plot .curve")) == 2, "not two curves")
    until(page, "const [a, b] = page.state.slots.map((s) => s.seconds);"
          "return Math.max(a, b) < 2 * Math.min(a, b) + 0.5", "not at equal time")
    hashes = set()
    for view in ("a", "b", "slider", "side"):
        page.click(f'#views [data-value="{view}"]')
        hashes.add(ink(page)["hash"])
    require(len(hashes) == 4, "some views look alike")
    page.click('#pace [data-value="samples"]')
    until(page, "return page.state.pace === 'samples'", "the pace is not that")


@check
def overlays_have_legends(page):
    seen = set()
    for layer in ("error", "relative", "samples", "rays", "depth"):
        choose(page, "#layer", layer)
        until(page, "const r = page.range(); return r && r[1] > r[0]", "no range of", layer)
        page.settle()
        require(not page.js("return document.querySelector('#legend').hidden"),
                "no legend of", layer)
        seen.add(page.js("return document.querySelector('#legend .note').innerText"))
        ends = page.js("return [...document.querySelectorAll('#legend > span')]"
                       ".map((e) => e.innerText)")
        require(ends[0].startswith("≤") and ends[2].startswith("≥") or layer == "samples", ends)
        require(("%" in ends[0] and "%" in ends[2]) == (layer == "relative"), layer, ends)
    require(len(seen) == 5, seen)
    choose(page, "#layer", "colour")
    require(not page.find("#legend").is_displayed(), "a legend of the picture itself")


@check
def overlay_colours_span_percentiles(page):
    # 1 to 100, outliers and pixels without a value; then one outlier loses its value.
    found = page.js("""
        const half = (x) => {
          const e = Math.floor(Math.log2(x));
          return ((e + 15) << 10) | Math.round((x / 2 ** e - 1) * 1024);
        };
        const layer = new LayerValues({width: 13, height: 8});
        const values = Array.from({length: 104}, (_, i) => i < 100 ? half(i + 1) : 0);
        values[100] = half(60000), values[101] = half(2 ** -14);
        values[102] = 0x7e00, values[103] = half(0.5);
        layer.put(0, 0, 13, 8, values);
        const before = layerRange([layer]);
        layer.put(12, 7, 1, 1, [0x7c00]);
        const after = layerRange([layer, new LayerValues({width: 1, height: 1})]);
        layer.clear();
        return [before, after, layerRange([layer])]""")
    require(found == [[4, 96], [5, 96], None], found)


@check
def the_error_plot_has_a_title_and_named_axes(page):
    for pace, title, unit in (("samples", "samples per pixel", ""),
                              ("time", "processor time", "(s)")):
        page.click(f'#pace [data-value="{pace}"]')
        until(page, "return document.querySelector('#error-plot figcaption')?.innerText"
              f".includes('{title}')", "no title with", title)
        names = page.js("return [...document.querySelectorAll('#error-plot .axis-name')]"
                        ".map((e) => e.textContent)")
        require(len(names) == 2 and "(%)" in names[1], names)
        require(names[0].startswith(title) and unit in names[0], names)


@check
def stages_stand_below_the_image(page):
    until(page, "return document.querySelector('.live-stage')", "no stages")
    image, stages, side = (page.box(s) for s in ("#viewer", "#stages", ".live-side"))
    require(stages[1] >= image[3] and stages[2] <= side[0], image, stages, side)


@check
def strategies_are_chosen_by_axes(page):
    page.js("document.querySelector('#card-1 details').open = true")
    choose(page, '#card-1 [data-axis="points"]', "halton")
    until(page, "return page.state.slots[1].strategy?.includes('points=halton')",
          "it is not rendered")
    choose(page, '#card-1 [data-axis="roulette"]', "adjoint")
    choose(page, '#card-1 [data-axis="reuse"]', "block")
    text = until(page, "return document.querySelector('#card-1 .refused')?.innerText",
                 "it is not refused")
    require("reuse=block" in text, text)
    page.click("#off")
    until(page, "return page.state.slots[1].name === ''", "B is not given up")


@check
def stages_have_their_times(page):
    until(page, "return page.state.slots[0].stages?.length > 3", "no stages")
    text = page.text("#stages")
    require("Mray/s" in text and "of lanes" in text and "[object" not in text, text)
    require(len(page.all(".omitted div")) > 5, "nothing is left out")


@check
def overlays_wait_for_what_they_show(page):
    """Where nothing is known of a layer yet, one sees where the camera is: in grey."""
    fresh(page)
    page.js("page.socket.send({do: 'pause', on: true})")
    until(page, "return page.state.paused", "it goes on")
    # As after a move: a whole picture of one sample for many pixels.
    picture_in_grey = """
        const {screen} = page, slot = screen.slots[0], side = 16;
        const squares = [[0, 0, side, side]], count = side * side;
        const bytes = new ArrayBuffer(10 * count), pixels = new Uint16Array(bytes);
        for (let i = 0; i < count; ++i) {
          pixels.set([0x3c00, 0x2e66 + 8 * i, 0, 0x3c00], 4 * i);  // from orange to yellow
          pixels[4 * count + i] = 0x7e00;  // not known
        }
        screen.take({kind: 'picture', slot: 0, view: slot.view + 1, factor: 10, spp: 1,
                     layer: arguments[0], width: side, height: side, squares}, bytes, 0);
        page.drawLegend()"""
    for layer in ("error", "relative", "samples", "rays", "depth"):
        choose(page, "#layer", layer)
        time.sleep(0.3)
        page.js(picture_in_grey, "colour" if layer == "samples" else layer)
        seen = ink(page)
        require(seen["coloured"] == 0, layer, "has colours of nothing known:", seen)
        require(seen["shades"] > 20, layer, "hides the picture:", seen)
        if layer != "samples":
            require("no data yet" in page.text("#legend"), page.text("#legend"))
            require("1.0" not in page.text("#legend"), page.text("#legend"))
