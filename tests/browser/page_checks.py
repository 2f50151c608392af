"""Checks of the page as a whole."""

from checks import NAMES, STATES, check, require

NAMES += ["</script><b>\"bold\""]


STATES += [lambda page, index=index: page.click("#scenes a", index) for index in range(5)]


@check
def scenes_switch(page):
    names = [tab.text for tab in page.all("#scenes a")]
    require(len(names) == 5, "tabs:", names)
    for index, name in enumerate(names):
        page.click("#scenes a", index)
        require(page.find("#content").get_attribute("data-scene") == name, "not", name)
        require(page.find("h1").text == name, "wrong title for", name)
    for index in (1, 4):  # a name that has to be quoted in an address, and one that has not
        page.click("#scenes a", index)
        page.driver.refresh()
        page.settle()
        require(page.find("h1").text == names[index], names[index], "is not remembered")
    page.reset()


@check
def machines_are_named(page):
    text = page.find("#summary").text
    require("<b>Synthetic</b> 1000, 4 cores, 8.0 GiB, load 1.50; unknown" in text, text)
    page.click("#scenes a", 1)
    require("Synthetic 2000, 2 cores" in page.find("#summary").text, "not the writer's")
    page.reset()


@check
def nothing_jumps(page):
    page.open()
    page.scroll_through()
    shift = page.js("""const o = new PerformanceObserver(() => {});
      o.observe({type: 'layout-shift', buffered: true});
      return o.takeRecords().filter((e) => !e.hadRecentInput)
        .reduce((sum, e) => sum + e.value, 0);""")
    require(shift < 0.02, "layout shift", shift)
