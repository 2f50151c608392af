"""Checks of the first screen, and of a study of many strategies."""

from checks import check, data, pick, plot, require

WIDTHS = ("const b = document.querySelector('#ranking .scroll');"
          "return [b.scrollWidth, b.clientWidth]")
CROWD = 4  # index of the scene of many strategies


def scene(page, index):
    return data(page)["scenes"][index]


def show_crowd(page):
    if page.js("return document.querySelector('#content').dataset.scene") != "crowd":
        page.click("#scenes a", CROWD)


@check
def the_first_screen_answers_with_a_picture(page):
    for width, height in ((1920, 1080), (1280, 800)):
        page.resize(width, height)
        page.open()
        data = scene(page, 0)
        winner = data["strategies"][data["ranking"][0]]
        sentence = page.find("#summary .verdict").text
        require(winner["name"] in sentence, "the winner is not named:", sentence)
        require(len(sentence) < 220, "too long:", sentence)
        numbers = [n.text for n in page.all("#summary .hero-number .number")]
        require(len(numbers) == 2, "numbers:", numbers)
        value = winner["efficiency"]["value"]
        require(abs(float(numbers[0].rstrip("×")) / value - 1) < 0.01, numbers, value)
        ink = page.ink(plot(page, "hero"))
        require(ink["coloured"] > 800, "no curves:", ink)
        require(page.box('[data-plot="hero"]')[3] < height, "below the first screen")
    page.reset()


@check
def warnings_are_said_once(page):
    show_crowd(page)
    items = [item.text for item in page.all("#summary .warnings li")]
    require(0 < len(items) <= 8, len(items), "warnings:", items)
    titles = [item.text for item in page.all("#summary .warnings li > b")]
    require(len(set(titles)) == len(titles), "said twice:", titles)
    text = " ".join(items)
    require("at 16 samples per pixel. Ranks change." in text, "no caution:", text)
    require("may be wrong" in text, "no word of it:", text)


@check
def refused_intervals_are_told(page):
    show_crowd(page)
    text = page.find("#calibration").text
    require("no interval" in text, "the text says:", text)


@check
def the_ranking_fits(page):
    for width in (1280, 1920):
        page.resize(width, 1000)
        show_crowd(page)
        page.show("#ranking")
        inner, outer = page.js(WIDTHS)
        require(inner <= outer, "main columns clipped at", width, inner, outer)
        tall = page.js("return Math.max(...[...document.querySelectorAll("
                       "'#ranking tbody tr:not(.not-run)')].map((r) => r.offsetHeight))")
        require(tall <= 60, "a row is", tall, "pixels high")
        few = len(page.all("#ranking thead th"))
        page.click('#ranking [data-value="all"]')
        require(len(page.all("#ranking thead th")) > few + 5, "not all columns")
        require(page.js("return document.documentElement.scrollWidth") <= width,
                "the page scrolls sideways at", width)
        inner, outer = page.js(WIDTHS)
        require(inner <= outer or width < 1900, "all columns clipped at", width, inner, outer)
        page.click('#ranking [data-value="main"]')


@check
def full_texts_are_there_on_demand(page):
    show_crowd(page)
    page.show("#ranking")
    full = "#ranking details.name .full-text"
    require(not page.find(full).is_displayed(), "the full text is there at once")
    page.click("#ranking details.name summary")
    require(page.find(full).is_displayed(), "the full text does not open")
    require("light-selection=power" in page.find(full).text, "not the full text")
    rows = [row.text for row in page.all("#ranking tr.not-run")]
    require(any("points=sobol, scene" in row for row in rows), "no twins:", rows)


@check
def many_strategies_do_not_make_it_endless(page):
    show_crowd(page)
    page.scroll_through()
    height = page.js("return document.documentElement.scrollHeight")
    require(height < 14000, "the page is", height, "pixels high")
    others = "#maps .others"
    few = len(page.all("#maps .map-row"))
    page.click(f"{others} summary")
    require(len(page.all("#maps .map-row")) > few, "the others do not come")


@check
def many_curves_fade_and_filter(page):
    show_crowd(page)
    page.show("#curves")

    def pressed():
        return page.js("return [...document.querySelectorAll('#curves .legend-item')]"
                       ".filter((b) => b.getAttribute('aria-pressed') === 'true')"
                       ".map((b) => b.dataset.strategy)")

    leading = pressed()
    require(4 <= len(leading) <= 8, "curves in colour:", leading)
    first = page.ink(plot(page, "spp"))
    pick(page, '[data-control="filter"]', "halton")
    found = [scene(page, CROWD)["strategies"][int(i)]["name"] for i in pressed()]
    require(len(found) == 6 and all("halton" in name for name in found), found)
    require(page.ink(plot(page, "spp"))["hash"] != first["hash"], "the plot is as before")
    pick(page, '[data-control="filter"]', "")
    require(pressed() == leading, "not as before", pressed())
    page.click('[data-show="all"]')
    every = page.ink(plot(page, "spp"))
    require(every["coloured"] > 1.5 * first["coloured"], "not all in colour", every)
    page.click('[data-show="none"]')
    none = page.ink(plot(page, "spp"))
    require(none["ink"] > 0.3 * first["ink"], "the others are gone, not grey:", none)
    page.reset()
