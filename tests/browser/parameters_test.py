#!/usr/bin/env python3
"""Looks at the page of a synthetic sweep over parameters: parameters_test.py PAGE FOLDER

As report_test.py.
"""

import checks
import run_checks
import sweep_checks  # noqa: F401

checks.CHECKS.clear()  # those of the other sweep
import parameters_checks  # noqa: E402, F401

run_checks.main()
