#!/usr/bin/env python3
"""Looks at the page of a synthetic sweep in Chromium: sweep_test.py REPORT.html FOLDER

As report_test.py.
"""

import run_checks
import sweep_checks  # noqa: F401, these two register their checks
import sweep_page_checks  # noqa: F401

run_checks.main()
