"use strict";
// Processor time: one bar for each strategy, divided into the stages of the wavefront.

const SMALL_STAGE = 0.015;

// Names of stages by total share; a stage has the same colour in every bar.
function stageNames(view) {
  const totals = new Map();
  for (const s of view.ranked) {
    for (const { name, share } of s.stages || []) {
      totals.set(name, (totals.get(name) || 0) + (known(share) ? share : 0));
    }
  }
  return [...totals].sort((a, b) => b[1] - a[1]).map(([name]) => name);
}

function stageColor(index) {
  return index < COLOR_COUNT ? `var(--s${index})` : "var(--s-rest)";
}

function stageTip(strategy, stage) {
  const line = (name, text) => text !== UNKNOWN && `${name} ${text}`;
  return noteOf(
    `${stage.name}: ${fmtPercent(stage.share)}`,
    strategy.name,
    line("time", fmtSeconds(stage.seconds)),
    line("time per item", known(stage.ns_per_item) ? `${fmt(stage.ns_per_item)} ns` : UNKNOWN),
    line("items", fmtCount(stage.items)),
    line("SIMD lanes used", fmtPercent(stage.occupancy)),
  );
}

// length: of the bar, in relation to the widest one.
function stageBar(strategy, names, length = 1) {
  const stages = (strategy.stages || []).filter(
    (stage) => known(stage.share) && stage.share > 0,
  );
  if (stages.length === 0)
    return el("div.bar.empty", "No stages recorded.");
  const rank = new Map(names.map((name, i) => [name, i]));
  stages.sort((a, b) => rank.get(a.name) - rank.get(b.name));
  const total = Math.max(1, stages.reduce((sum, stage) => sum + stage.share, 0));
  return el("div.bar", { role: "list" },
    stages.map((stage) => {
      const share = stage.share / total;
      const index = rank.get(stage.name);
      const text = `${stage.name} ${fmtPercent(stage.share)}`;
      return withTip(
        el("div.bar-part",
          {
            role: "listitem", tabindex: share >= SMALL_STAGE ? 0 : null, "aria-label": text,
            style: {
              width: `${share * 100}%`, "background-color": stageColor(index),
              color: index < COLOR_COUNT ? `var(--on-s${index})` : "inherit",
            },
          },
          share * length > 0.06 &&
            el("span",
              { "aria-hidden": "true", class: share * length < 0.12 ? "narrow" : null },
              fmtPercent(stage.share, 2),
            ),
        ),
        () => stageTip(strategy, stage),
      );
    }),
  );
}

function stageSeconds(strategy) {
  const stages = strategy.stages || [];
  return stages.reduce(
    (sum, stage) => sum + (known(stage.seconds) ? stage.seconds : 0),
    0,
  );
}

// Names the first of many stages only; each part of a bar has a tooltip.
function restText(names) {
  const shown = names.length > 4 ? names.slice(0, 3) : names;
  const more = names.length > shown.length ? `, and ${names.length - shown.length} more` : "";
  return `other (${shown.join(", ")}${more})`;
}

function stageLegend(names) {
  const rest = names.slice(COLOR_COUNT);
  const entry = (text, index) =>
    el("li",
      el("span.patch", { style: { "background-color": stageColor(index) } }),
      text,
    );
  return el("ul.stage-legend",
    names.slice(0, COLOR_COUNT).map((name, i) => entry(name, i)),
    rest.length > 1 && entry(restText(rest), COLOR_COUNT),
    rest.length === 1 && entry(rest[0], COLOR_COUNT),
  );
}

// A bar with its name, and a few words on the whole.
function stageRow(strategy, text, bar, attributes = {}) {
  return el("div.stage-row", { ...attributes },
    el("div.stage-name", strategyLabel(strategy), el("span.bounds", text)),
    bar,
  );
}

// Bars as long as their `total`, {line, name, text, stages, total}, and what hides some of
// them: the lines that the view does not show.
function costRows(view, bars, names) {
  const most = Math.max(...bars.map((bar) => bar.total));
  const rows = bars.map((bar) => {
    const length = bar.total / most;
    const whole = stageBar(bar, names, length);
    whole.style.width = `${length * 100}%`;
    return stageRow(bar.line, bar.text, whole, { "data-line": bar.line.index });
  });
  view.shown.listen((shown) =>
    rows.forEach((row) => {
      row.hidden = !shown.has(Number(row.dataset.line));
    }),
  );
  return [stageLegend(names), el("div.stage-rows", rows)];
}

function stagesSection(view) {
  const names = stageNames(view);
  if (names.length === 0) {
    return section("stages", "Processor time by stage",
      el("p", "No stage times were recorded."),
    );
  }
  const rows = leadingRows(view, view.ranked, (s) =>
    stageRow(s, fmtSeconds(stageSeconds(s)), stageBar(s, names)),
  );
  return section("stages", "Processor time by stage",
    el("p.lead",
      "Percentage of the processor time in each stage, at the largest " +
        "sample count, over all repetitions.",
    ),
    stageLegend(names),
    el("div.stage-rows", rows),
  );
}
