#!/usr/bin/env python3
"""Looks at the synthetic report in Chromium: report_test.py REPORT.html SCREENSHOT_FOLDER

Checks that everything draws and works, writes screenshots if the environment has
LANELIGHT_SCREENSHOTS (`./run test --full`), and ends with 1 if a check
failed, with 77 where Chromium or Selenium is missing.
"""

import run_checks
import plot_checks  # noqa: F401, these five register their checks
import hero_checks  # noqa: F401
import export_checks  # noqa: F401
import image_checks  # noqa: F401
import page_checks  # noqa: F401

run_checks.main()
