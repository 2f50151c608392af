"use strict";
// Shows the sweep; the plots are drawn anew whenever the reader chooses other axes.

let current = null; // the view of the plots

function plotArea(choice, onChange) {
  if (current) current.close();
  const panels = choicePanels(choice);
  const lines = allLines(panels);
  const view = (current = linesView(lines));
  return [
    section("plots", "Efficiency, error and throughput",
      varyingAxes.length > 0 && choiceMenus(choice, onChange),
      lines.length > 0
        ? plotsSection(view, choice, panels, lines)
        : el("p", "No finished cell has values to plot."),
    ),
    imagesSection(view, choice),
    costSection(view, choice, panels),
  ];
}

function start() {
  startPage({
    title: `${study.file} – Lanelight sweep`,
    footer:
      "Written by lanelight sweep. This page holds all its numbers and needs no network.",
    sections: doneCells.length > 0 && [
      ["plots", "Plots"],
      imageBlocks.size > 0 && ["images", "Images"],
      ["stages", "Stage costs"],
      curves.length > 0 && ["convergence", "Convergence"],
      ["cells", "Cells"],
    ],
  });
  const area = el("div#area");
  const show = (choice) => {
    const focused = document.activeElement && document.activeElement.dataset.menu;
    tip.hide();
    area.replaceChildren(...plotArea(choice, show).filter(Boolean));
    const again = focused && area.querySelector(`[data-menu="${focused}"]`);
    if (again) again.focus();
  };
  showContent(sweepSummary(), area, convergenceSection(), tableSection());
  if (doneCells.length > 0) show(firstChoice());
}

start();
