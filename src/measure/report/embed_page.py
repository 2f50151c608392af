#!/usr/bin/env python3
"""Turns the report's pages and plots into one C++ file:
embed_page.py PAGE_DIR OUTPUT.cc MODULE.py...

Makes each page of PAGE_DIR/page.html, with its styles and scripts in it, puts their hashes
into the content security policy, and cuts the result at the line <!-- data -->. Standard
library only.
"""

import base64
import hashlib
import pathlib
import re
import sys

# Scripts that several pages have, in their order.
COMMON = "dom page inputs format"
REPORT = f"{COMMON} data view strategies table"
PLOTS = "whisker scale plot_draw plot plot_save plot_legend"
CURVES = f"{REPORT} {PLOTS} guides"
IMAGES = "tone picture place pan pane difference comparator controls readout"


def also(files):
    """Returns the sentence for browsers without JavaScript."""
    return f"The numbers are also in {files}."


# Of the pages: what stands where page.html has these words; styles after base.css, table.css
# and plots.css, and before print.css; scripts.
PAGES = {
    "Study": ({"NAME": "study", "TABS": "Scenes",
               "FILES": also("study.json and study.csv in the same directory")},
             "images",
             f"""{CURVES} {IMAGES} curves hero warnings summary ranking ranking_columns calibration
             figures figures_level insets maps stages levels glossary main"""),
    "Paper": ({"NAME": "paper", "TABS": "Paper",
               "FILES": also("study.json and study.csv in the same directory")},
                  "images",
                  f"""{CURVES} tone picture difference curves hero summary ranking_columns figures
                  figures_level insets paper_text paper_main"""),
    "Comparison": ({"NAME": "compare", "TABS": "Images",
               "FILES": also("the output of compare --json")}, "images",
                    f"""{REPORT} {PLOTS} {IMAGES} maps histogram compare_tiles compare_numbers
                    compare_main"""),
    "Sweep": ({"NAME": "sweep", "TABS": "Sweep",
               "FILES": also("sweep.csv in the same directory")}, "images sweep",
                  f"""{CURVES} tone picture stages rates sweep_cells sweep_choice sweep_lines
                  sweep_plots sweep_images sweep_stages sweep_convergence sweep_table sweep_headline
                  sweep_summary sweep_main"""),
    "Bench": ({"NAME": "bench", "TABS": "Scenes",
               "FILES": also("the output of bench --json")},
                  "sweep", f"{CURVES} stages rates bench_rows bench_main"),
    "Profile": ({"NAME": "profile", "TABS": "Scene",
               "FILES": also("the output of profile --json")}, "images sweep profile",
                  f"{CURVES} tone picture rates profile_rows profile_plots profile_main"),
    "Stress": ({"NAME": "stress", "TABS": "Targets",
               "FILES": also("stress.json in the same directory")}, "stress",
                   f"""{REPORT} {PLOTS} stress_data stress_scale stress_plot stress_tiles
                   stress_about stress_detail stress_strategies stress_table stress_summary
                   stress_main"""),
    "Live": ({"NAME": "live", "TABS": "Scene",
              "FILES": "Without a browser, use lanelight render.",
              "CONNECT": "; connect-src 'self'"}, "live",
                 f"""{COMMON} strategies scale plot_draw tone place live_socket live_camera
                 live_shader live_range live_screen live_place live_viewer live_controls
                 live_readout live_strategy live_presets live_score live_plot live_stages
                 live_save live_main"""),
}
DATA, STYLES, SCRIPTS = "<!-- data -->", "<!-- styles -->", "<!-- scripts -->"
PIECE = 12000  # characters of one literal; compilers must take 65535

HEADER = """// Written by src/measure/report/embed_page.py; not to be edited.
#include "src/measure/report/page.h"

namespace lanelight {
"""


def digest(text):
    hashed = hashlib.sha256(text.encode("utf-8")).digest()
    return f"'sha256-{base64.b64encode(hashed).decode()}'"


def inline(page_dir, tag, files):
    """The files in elements of their own, and their hashes."""
    elements, hashes = [], []
    for file in files:
        text = "\n" + (page_dir / file).read_text(encoding="utf-8").strip() + "\n"
        if f"</{tag}" in text.lower() or "<!--" in text:
            raise SystemExit(f"embed_page: {file} contains </{tag} or <!--")
        elements.append(f"<{tag}>{text}</{tag}>")
        hashes.append(digest(text))
    return "\n".join(elements), " ".join(hashes)


def refuse_twins(page_dir, scripts):
    """A name that two scripts of a page declare stops the second one."""
    declared = {}
    for file in scripts:
        text = (page_dir / file).read_text(encoding="utf-8")
        for name in re.findall(r"(?m)^(?:const|let|class|(?:async )?function\*?) +(\w+)", text):
            if declared.setdefault(name, file) != file:
                raise SystemExit(f"embed_page: {name} is declared in {declared[name]} and {file}")


def assemble(page_dir, words, style, scripts):
    styles = ["base.css", "table.css", "plots.css", *(f"{name}.css" for name in style.split()),
              "print.css"]
    scripts = [f"{name}.js" for name in scripts.split()]
    refuse_twins(page_dir, scripts)
    style_text, style_hashes = inline(page_dir, "style", styles)
    script_text, script_hashes = inline(page_dir, "script", scripts)
    theme_text, theme_hash = inline(page_dir, "script", ["theme.js"])
    html = (page_dir / "page.html").read_text(encoding="utf-8")
    for marker, text in {"CONNECT": "", **words, STYLES: style_text, SCRIPTS: script_text,
                         "<!-- theme -->": theme_text, "STYLE_HASHES": style_hashes,
                         "SCRIPT_HASHES": f"{theme_hash} {script_hashes}"}.items():
        if marker not in html:
            raise SystemExit(f"embed_page: page.html has no {marker}")
        html = html.replace(marker, text)
    return html.split(DATA)


def literal(name, text):
    pieces = [text[i : i + PIECE] for i in range(0, len(text), PIECE)]
    if ")LL\"" in text:
        raise SystemExit('embed_page: the page contains )LL"')
    # Short literals appended at run time: one long one would exceed what the standard
    # asks of compilers.
    lines = [f"std::string {name}() {{", "  std::string text;"]
    lines += [f'  text += R"LL({piece})LL";' for piece in pieces]
    return "\n".join(lines + ["  return text;", "}", ""])


def plot_script(modules):
    """The modules of the Python package that draw plots, without imports of each other."""
    whole = "".join(module.read_text(encoding="utf-8") for module in modules)
    return re.sub(r"(?m)^from \.\w+ import (\([^)]*\)|.*)\n", "", whole)


def main():
    page_dir, output, *modules = map(pathlib.Path, sys.argv[1:])
    body = HEADER
    cases = ""
    for name, page in PAGES.items():
        head, tail = assemble(page_dir, *page)
        body += "\nstatic " + literal(f"{name}Head", head)
        body += "\nstatic " + literal(f"{name}Tail", tail)
        cases += f"    case PageKind::k{name}: return {{{name}Head(), {name}Tail()}};\n"
    body += f"\nPageText TextOf(PageKind kind) {{\n  switch (kind) {{\n{cases}  }}\n  return {{}};\n}}\n"
    body += "\n" + literal("PlotScript", plot_script(modules))
    output.write_text(body + "\n}  // namespace lanelight\n", encoding="utf-8")


main()
