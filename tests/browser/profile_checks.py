"""Checks of the page of a small profile, compared with an earlier one."""

from checks import check, data, markers, plot, require, wait_for


def bars(page, section, column=0):
    """Name, length as a fraction, and text of each bar."""
    return page.js("""
        const bars = document.querySelectorAll(`#${arguments[0]} .value-bars`)[arguments[1]];
        return [...bars.children].map((row) => {
          const part = row.querySelector('.bar-part');
          return [row.querySelector('.value-name').innerText,
                  part.offsetWidth / part.parentNode.offsetWidth,
                  row.querySelector('.value-text').innerText];
        })""", section, column)


def require_lengths(found, wanted, what):
    require(len(found) == len(wanted), what, found)
    for (_, length, _), value in zip(found, wanted):
        require(abs(length - value) < 0.02, what, length, value)


@check
def the_answer_comes_first(page):
    require(page.find("#summary .verdict").text == data(page)["page"]["answer"])


@check
def bars_are_the_shares(page):
    for column, rows in ((0, data(page)["groups"]), (1, data(page)["rows"][:15])):
        rows = [row for row in rows if row["share"] > 0]
        found = bars(page, "costs", column)
        require([name for name, _, _ in found] == [row["name"] for row in rows], found)
        require_lengths(found, [row["share"] / rows[0]["share"] for row in rows], "shares")
        require(all("[" in text for _, _, text in found), "an interval for each", found)


@check
def bounces_have_their_cost_and_lanes(page):
    bounces = data(page)["bounces"]
    most = max(b["seconds"] for b in bounces)
    require_lengths(bars(page, "bounces"), [b["seconds"] / most for b in bounces], "cost")
    require_lengths(bars(page, "bounces", 1), [b["occupancy"] for b in bounces], "lanes")


@check
def differences_are_those_of_the_comparison(page):
    changes = data(page)["page"]["changes"]
    found = page.js("return [...document.querySelectorAll('#against .rate-row')].slice(1)"
                    ".map((r) => [r.querySelector('.rate-name').innerText,"
                    "r.querySelector('.whisker path').getBoundingClientRect().x])")
    require(len(found) == min(15, len(changes)), found)
    for (name, x), change in zip(found, changes):
        require(name.startswith(change["name"]), name, change)
        require(("slower" in name) == change["slower"], name, change)
        require(x <= max(x for _, x in found[:2]), "the largest difference is not first", found)


@check
def stages_are_at_their_bytes_and_speed(page):
    page.scroll_through()
    wanted = {(row["bytes_read_per_item"] + row["bytes_written_per_item"],
               round(row["items"] / row["seconds"])) for row in data(page)["rows"]
              if row["kind"] == "stage" and row["seconds"] > 0}
    found = {(x, round(y)) for line in markers(page, "roofline") for x, y in line}
    require(found == {(x, y) for x, y in wanted if x > 0}, found, wanted)
    names = page.js("return [...document.querySelectorAll('[data-plot=roofline] .guide-name')]"
                    ".map((t) => t.textContent)")
    levels = [level["name"] for level in data(page)["peaks"]["levels"]]
    require([name.split()[0] for name in names] == levels, names)


@check
def queues_and_image_are_drawn(page):
    def is_drawn():
        page.scroll_through()
        # A map of few tiles has few shades, and fewer if a tile was interrupted.
        return (page.ink(plot(page, "queues"))["coloured"] > 100 and
                all(page.ink(canvas)["shades"] > 2
                    for canvas in page.all("#map canvas.picture")))
    wait_for(is_drawn, "a blank plot or image")


@check
def columns_without_data_are_not_shown(page):
    head = page.find("#rows thead").text
    require(("L1 misses" in head) == data(page)["counters"]["available"], head)
    require(len(page.all("#rows tbody tr")) == len(data(page)["rows"]), "rows")
