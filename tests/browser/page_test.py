#!/usr/bin/env python3
"""Looks at a page in Chromium: page_test.py KIND PAGE.html FOLDER [CHECK...]

Checks that everything draws and works, writes screenshots into FOLDER if the environment
has LANELIGHT_SCREENSHOTS (`./run test --full`), and ends with 1 if a check failed, with 77
where Chromium or Selenium is missing.
"""

import sys

import browser
import run_checks

MODULES = {
    "report": "plot_checks hero_checks export_checks image_checks page_checks",
    "compare": "compare_checks",
    "sweep": "sweep_checks sweep_page_checks",
    "parameters": "parameters_checks",
    "bench": "bench_checks",
    "profile": "profile_checks",
    "stress": "stress_checks stress_page_checks",
    "paper": "paper_checks",
}

kind, path, folder, *chosen = sys.argv[1:]
modules = [*MODULES[kind].split(), "common_checks"]
run_checks.main(browser.Page(browser.start(), path, folder), modules, chosen)
