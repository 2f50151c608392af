#!/usr/bin/env python3
"""Uses the page of a running `lanelight live`: live_test.py LANELIGHT FOLDER

With real clicks, drags and keys in a headless Chromium; as page_test.py for the rest.
"""

import sys

import browser
import live_program
import run_checks

# The log of what goes over the network would have all pictures in it. The window is small,
# since the processor draws it.
chromium = browser.start(browser.WEBGL_FLAGS, ("browser",))
with live_program.running(sys.argv[1], "--resolution", "160x120") as program:
    page = browser.Page(chromium, program.address, sys.argv[2], (1000, 640))
    run_checks.main(page, ["live_checks", "live_end_checks"], sys.argv[3:])
