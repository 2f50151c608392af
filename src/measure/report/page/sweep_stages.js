"use strict";
// Stage costs: a bar for each point of each line, as long as its processor time per sample.

const MOST_BARS = 60;

// A bar of the cells of a point.
function pointCosts(choice, panel, line, point) {
  const cells = cellsOf(point.group);
  const stages = study.stages
    .map((name, i) => {
      const seconds = cells.map((cell) => (cell.stages || [])[i]).filter(known);
      return { name, seconds: seconds.reduce((sum, x) => sum + x, 0) / cells.length };
    })
    .filter((stage) => stage.seconds > 0);
  const seconds = stages.reduce((sum, stage) => sum + stage.seconds, 0);
  for (const stage of stages) stage.share = stage.seconds / seconds;
  const total = seconds / intervalOf(point.group, "samples").value;
  const where = [panel.name, choice.along && point.name].filter(Boolean).join(", ");
  const name = [panel.name, line.name, point.name].filter(Boolean).join(", ");
  const text = [where, `${fmtSeconds(total)} per sample`].filter(Boolean).join(": ");
  return { line, name, text, stages, total };
}

function costSection(view, choice, panels) {
  const all = panels.flatMap((panel) =>
    panel.lines.flatMap((line) =>
      line.points.map((point) => pointCosts(choice, panel, line, point)),
    ),
  );
  const bars = all.filter((bar) => bar.stages.length > 0).slice(0, MOST_BARS);
  if (bars.length === 0) {
    return section("stages", "Processor time per sample, by stage", el("p", "No stage times were recorded."));
  }
  return section("stages", "Processor time per sample, by stage",
    el("p.lead",
      "Processor time of each stage per sample; the length of a bar is the total." +
        (all.length > bars.length ? ` Shows the first ${MOST_BARS} of ${all.length} lines.` : ""),
    ),
    costRows(view, bars, stageNames({ ranked: bars })),
  );
}
