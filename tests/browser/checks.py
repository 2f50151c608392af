"""What all checks of the report share."""

CHECKS = []  # in the order in which they run


def check(function):
    CHECKS.append(function)
    return function


def require(condition, *what):
    if not condition:
        raise AssertionError(" ".join(str(part) for part in what))


def plot(page, name):
    return page.find(f'[data-plot="{name}"] canvas')


def theme(page):
    return page.js("return document.documentElement.dataset.theme")
