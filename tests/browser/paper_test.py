#!/usr/bin/env python3
"""Looks at the page of a small `lanelight study --paper`: paper_test.py PAGE.html FOLDER

As report_test.py otherwise.
"""

import run_checks
import paper_checks  # noqa: F401, it registers its checks

run_checks.main()
