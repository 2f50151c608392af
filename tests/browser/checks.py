"""What all checks of the report share."""

import os

CHECKS = []  # in the order in which they run


def check(function):
    CHECKS.append(function)
    return function


def pictures(function):
    """Only writes pictures to look at: a quarter of the time, for those who want them."""
    return check(function) if os.environ.get("LANELIGHT_SCREENSHOTS") else function


def require(condition, *what):
    if not condition:
        raise AssertionError(" ".join(str(part) for part in what))


def plot(page, name):
    return page.find(f'[data-plot="{name}"] canvas')


def theme(page):
    return page.js("return document.documentElement.dataset.theme")
