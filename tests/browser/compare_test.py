#!/usr/bin/env python3
"""Looks at the page of a synthetic comparison: compare_test.py REPORT.html FOLDER

As report_test.py.
"""

import compare_checks  # noqa: F401, registers its checks
import run_checks

run_checks.main()
