"use strict";
// Stage costs: a bar for each point of each line, as long as its processor time per sample.

const MOST_BARS = 60;

// {name, stages: [{name, seconds, share}], perSample} of the cells of a point.
function pointStages(panel, line, point) {
  const samples = intervalOf(point.group, "samples").value;
  const cells = cellsOf(point.group);
  const stages = study.stages
    .map((name, i) => {
      const seconds = cells.map((cell) => (cell.stages || [])[i]).filter(known);
      const sum = seconds.reduce((total, x) => total + x, 0);
      return { name, seconds: sum / cells.length };
    })
    .filter((stage) => stage.seconds > 0);
  const total = stages.reduce((sum, stage) => sum + stage.seconds, 0);
  for (const stage of stages) stage.share = stage.seconds / total;
  return {
    line,
    panel,
    name: [panel.name, line.name, point.name].filter(Boolean).join(", "),
    point,
    stages,
    perSample: total / samples,
  };
}

function costSection(view, choice, panels) {
  const all = panels.flatMap((panel) =>
    panel.lines.flatMap((line) =>
      line.points.map((point) => pointStages(panel, line, point)),
    ),
  );
  const bars = all.filter((bar) => bar.stages.length > 0).slice(0, MOST_BARS);
  if (bars.length === 0) {
    return section("stages", "Stage costs", el("p", "No stage times were recorded."));
  }
  const names = stageNames({ ranked: bars });
  const most = Math.max(...bars.map((bar) => bar.perSample));
  const rows = bars.map((bar) => {
    const length = bar.perSample / most;
    const whole = stageBar(bar, names, length);
    whole.style.width = `${length * 100}%`;
    const where = [bar.panel.name, choice.along && bar.point.name].filter(Boolean);
    const cost = `${fmtSeconds(bar.perSample)} per sample`;
    const text = [where.join(", "), cost].filter(Boolean).join(": ");
    return stageRow(bar.line, text, whole, { "data-line": bar.line.index });
  });
  const show = (shown) =>
    rows.forEach((row) => {
      row.hidden = !shown.has(Number(row.dataset.line));
    });
  view.shown.listen(show);
  return section("stages", "Stage costs",
    el("p.lead",
      "Processor time of each stage per sample; a bar's length is the sum." +
        (all.length > bars.length ? ` The first ${MOST_BARS} of ${all.length}.` : ""),
    ),
    stageLegend(names),
    el("div.stage-rows", rows),
  );
}
