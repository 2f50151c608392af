#!/usr/bin/env python3
"""Looks at the page of synthetic stress cases: stress_test.py REPORT.html FOLDER

As report_test.py.
"""

import run_checks
import stress_checks  # noqa: F401, these two register their checks
import stress_page_checks  # noqa: F401

run_checks.main()
