#!/usr/bin/env python3
"""Takes docs/study-page.png: study.py LANELIGHT

Screenshot of the page of a study of the Cornell box. Needs chromium and selenium, as the checks of
tests/browser do. Times differ between runs.
"""

import pathlib
import subprocess
import sys
import tempfile

DOCS = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(DOCS.parent / "tests/browser"))

import browser  # noqa: E402

SCENE = DOCS.parent / "scenes/cornell-box.pbrt"


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], "study", SCENE, "--out", f"{folder}/box", "--quiet",
                        "--resolution", "128x128"], check=True)
        driver = browser.start()
        try:
            page = browser.Page(driver, f"{folder}/box/report.html", folder)
            page.resize(1200, 690)
            page.open()
            page.scroll_through()
            page.screenshot("study-page")
        finally:
            driver.quit()
        (DOCS / "study-page.png").write_bytes(pathlib.Path(folder, "study-page.png").read_bytes())


if __name__ == "__main__":
    main()
