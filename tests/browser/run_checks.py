"""Runs the checks of modules on a page."""

import importlib
import sys
import time
import traceback

import checks


def run(page, function):
    """Returns whether the check failed."""
    start = time.monotonic()
    try:
        page.resize(*page.window)
        page.prefer("light")
        function(page)
    except Exception as error:  # one failed check must not hide the others
        print("FAILED", function.__name__)
        print("       ", str(error).strip().replace("\n", "\n        "))
        if not isinstance(error, AssertionError):
            traceback.print_exc()
        return True
    print(f"ok     {time.monotonic() - start:5.1f} s  {function.__name__}")
    return False


def main(page, modules, chosen=()):
    """Of all checks of these modules, or those that are chosen by name. Ends the process."""
    for module in modules:
        importlib.import_module(module)
    wanted = [function for function in checks.CHECKS if function.__module__ in modules
              and (not chosen or function.__name__ in chosen)]
    try:
        page.open()
        failed = sum(run(page, function) for function in wanted)
        for message in page.console() if failed else []:
            print("console:", message)
    finally:
        page.driver.quit()
    print(f"{len(wanted)} checks, {failed} failed; screenshots: {page.folder}")
    sys.exit(1 if failed or not wanted else 0)
