#!/usr/bin/env python3
"""Turns the report's pages into one C++ file: embed_page.py PAGE_DIR OUTPUT.cc

Reads PAGE_DIR/index.html (of a study), sweep.html and stress.html, replaces every
<link rel="stylesheet"> and <script src> by the file that it names, puts the hashes of what is inlined into the content security policy, and
cuts each result at the line <!-- data -->. Standard library only.
"""

import base64
import hashlib
import pathlib
import re
import sys

STYLE = re.compile(r'<link rel="stylesheet" href="([^"]+)">')
SCRIPT = re.compile(r'<script src="([^"]+)"></script>')
DATA = "<!-- data -->"
STYLE_HASHES, SCRIPT_HASHES = "STYLE_HASHES", "SCRIPT_HASHES"
LICENSE = "<!-- licence -->"
PAGES = (("index.html", "Page"), ("sweep.html", "SweepPage"),
         ("stress.html", "StressPage"))
PIECE = 12000  # characters of one literal; compilers must take 65535

HEADER = """// Written by src/report/embed_page.py from src/report/page/; not to be edited.
#include "src/report/page_text.h"

namespace lanelight {
"""


def digest(text):
    hashed = hashlib.sha256(text.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(hashed).decode()}'"


def inline(page_dir, tag, hashes, match):
    text = "\n" + (page_dir / match[1]).read_text(encoding="utf-8").strip() + "\n"
    if f"</{tag}" in text.lower() or "<!--" in text:
        raise SystemExit(f"embed_page: {match[1]} contains </{tag} or <!--")
    hashes.append(digest(text))
    return f"<{tag}>{text}</{tag}>"


def assemble(page_dir, name):
    html = (page_dir / name).read_text(encoding="utf-8")
    # The licence of uPlot goes where uPlot goes.
    licences = 1 if "vendor/" in html else 0
    for marker, count in ((DATA, 1), (STYLE_HASHES, 1), (SCRIPT_HASHES, 1),
                          (LICENSE, licences)):
        if html.count(marker) != count:
            raise SystemExit(f"embed_page: {name} must contain {marker} {count} times")
    licence = (page_dir / "vendor/LICENSE").read_text(encoding="utf-8").strip()
    html = html.replace(LICENSE, f"<!--\nuPlot 1.6.32\n{licence}\n-->")
    styles, scripts = [], []
    html = STYLE.sub(lambda m: inline(page_dir, "style", styles, m), html)
    html = SCRIPT.sub(lambda m: inline(page_dir, "script", scripts, m), html)
    html = html.replace(STYLE_HASHES, " ".join(styles))
    return html.replace(SCRIPT_HASHES, " ".join(scripts))


def literal(name, text):
    pieces = [text[i : i + PIECE] for i in range(0, len(text), PIECE)]
    if ")LL\"" in text:
        raise SystemExit('embed_page: the page contains )LL"')
    # Short literals appended at run time: one long one would exceed what the standard
    # asks of compilers.
    lines = [f"std::string {name}() {{", "  std::string text;"]
    lines += [f'  text += R"LL({piece})LL";' for piece in pieces]
    return "\n".join(lines + ["  return text;", "}", ""])


def main():
    page_dir, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    body = HEADER
    for name, prefix in PAGES:
        head, tail = assemble(page_dir, name).split(DATA)
        body += "\n" + literal(f"{prefix}Head", head)
        body += "\n" + literal(f"{prefix}Tail", tail)
    output.write_text(body + "\n}  // namespace lanelight\n", encoding="utf-8")


main()
