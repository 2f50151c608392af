"""Runs the checks that the modules of a test have registered."""

import sys
import traceback

import browser
import checks


def main(path=None, driver=None):
    """Of the page that the first argument names, and the checks that follow the second;
    `path` and `driver`: of another page, by a driver of its own."""
    folder = sys.argv[2]
    driver = driver or browser.start()
    ran = failed = 0
    try:
        page = browser.Page(driver, path or sys.argv[1], folder)
        page.prefer("light")
        page.open()
        chosen = sys.argv[3:]
        for function in checks.CHECKS:
            if chosen and function.__name__ not in chosen:
                continue
            ran += 1
            try:
                function(page)
                print("ok    ", function.__name__)
            except Exception as error:  # one failed check must not hide the others
                failed += 1
                print("FAILED", function.__name__)
                print("       ", str(error).strip().replace("\n", "\n        "))
                if not isinstance(error, AssertionError):
                    traceback.print_exc()
        for message in page.console() if failed else []:
            print("console:", message)
    finally:
        driver.quit()
    print(f"{ran} checks, {failed} failed; screenshots: {folder}")
    sys.exit(1 if failed or ran == 0 else 0)
