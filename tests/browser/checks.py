"""What all checks of the report share."""

import functools
import json
import os
import time

CHECKS = []  # in the order in which they run
STATES = []  # functions of the page: the ways in which common_checks look at it
NAMES = []  # texts that could be taken for markup, which some state shows


@functools.cache
def data(page):
    """Returns the numbers that the page holds."""
    return json.loads(page.js("return document.getElementById('study').textContent"))


def pick(page, selector, value):
    """Chooses in a menu or types into a field."""
    page.js("""const field = document.querySelector(arguments[0]);
      field.value = arguments[1];
      field.dispatchEvent(new Event('input'));
      field.dispatchEvent(new Event('change'));""", selector, value)
    page.settle()


def check(function):
    CHECKS.append(function)
    return function


def pictures(function):
    """Only writes pictures to look at: a quarter of the time, for those who want them."""
    return check(function) if os.environ.get("LANELIGHT_SCREENSHOTS") else function


def require(condition, *what):
    if not condition:
        raise AssertionError(" ".join(str(part) for part in what))


def wait_for(condition, *what, seconds=20):
    """Waits until the condition holds: a busy machine draws late."""
    end = time.monotonic() + seconds
    while not condition():
        require(time.monotonic() < end, *what)
        time.sleep(0.05)


def plot(page, name):
    return page.find(f'[data-plot="{name}"] > .curves')


def markers(page, name):
    """Of every curve that a plot shows, in their order: [[(x, y), ...], ...]."""
    return [[tuple(pair) for pair in curve] for curve in page.js("""
        const host = document.querySelector(`[data-plot="${arguments[0]}"]`);
        return [...host.querySelectorAll('g[data-series]')].map((g) =>
          [...g.querySelectorAll('.marker')].map((m) => [+m.dataset.x, +m.dataset.y]))""",
                                                                 name)]


def note_of(page, selector):
    """What the floating note says when the pointer is on the middle of an element."""
    page.js("""const node = document.querySelector(arguments[0]);
      const box = node.getBoundingClientRect();
      node.dispatchEvent(new PointerEvent('pointermove', {
        bubbles: true, clientX: box.x + box.width / 2, clientY: box.y + box.height / 2}))""",
            selector)
    text = page.text("#tip")
    page.js("tip.hide()")
    return text


def theme(page):
    return page.js("return document.documentElement.dataset.theme")
