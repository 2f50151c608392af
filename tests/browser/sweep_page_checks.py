"""Checks of the page of a sweep as a whole."""

from checks import NAMES, STATES, check, require
from sweep_checks import choose

NAMES += ["<i>odd"]
STATES += [lambda page, along=along: choose(page, "along", along)
           for along in ("spp", "scene", "threads", "strategy")]


def column(page, key):
    return page.js("""
      const heads = [...document.querySelectorAll('#cells thead th')];
      const at = heads.findIndex((h) => h.querySelector(`[data-key="${arguments[0]}"]`));
      return [...document.querySelectorAll('#cells tbody tr')]
        .map((row) => row.cells[at].textContent)""", key)


@check
def the_summary_counts(page):
    cells = page.js("return study.cells")
    done = sum(cell["status"] == "done" for cell in cells)
    text = page.find("#summary").text
    require(f"{done} of {len(cells)} done" in text, text)
    require("1 cell has failed" in text and "1 cell is missing" in text, text)
    require("2 machines" in text, text)
    require("<b>Small</b>, 2 cores, memory unknown, load 2.00; Big, 64" in text, text)


@check
def the_table_sorts(page):
    page.show("#cells")
    require(len(column(page, "spp")) == len(page.js("return study.cells")), "not all cells")
    for sign in (1, -1):
        page.click('#cells [data-key="spp"]')
        numbers = [sign * int(text) for text in column(page, "spp")]
        require(numbers == sorted(numbers), numbers)
    page.click('#cells [data-key="cpu_seconds"]')
    last = page.find("#cells tbody tr:last-child").text
    require("failed" in last or "missing" in last, "what is not known is not last:", last)
    require("out of <i>memory</i>" in page.find("#cells").text, "no message")


@check
def the_pixels_to_blame_are_named(page):
    page.show("#convergence")
    text = page.find("#convergence").text
    require("stops falling as 1/N at 16 spp" in text, text)
    require("(7, 4) 45 %" in text and "heavy-tails" in text, text)
