"use strict";
// All numbers of the study, one collapsed table for each strategy.

const LEVEL_COLUMNS = [
  ["Samples", (l) => fmtCount(l.spp)],
  ["Repetitions", (l) => fmtCount(l.repetitions)],
  ["Relative MSE", (l) => twoLines(intervalTexts(l.relmse))],
  ["Trimmed", (l) => twoLines(intervalTexts(l.relmse_trimmed))],
  ["Rel. MSE, 2 × 2 filter", (l) => twoLines(intervalTexts(l.relmse_2))],
  ["4 × 4 filter", (l) => twoLines(intervalTexts(l.relmse_4))],
  ["8 × 8 filter", (l) => twoLines(intervalTexts(l.relmse_8))],
  ["RMSE", (l) => twoLines(intervalTexts(l.rmse))],
  ["MAPE", (l) => twoLines(percentTexts(l.mape))],
  ["Processor time", (l) => twoLines(secondsTexts(l.cpu_seconds))],
  ["Wall time", (l) => twoLines(secondsTexts(l.wall_seconds))],
  ["Bias", (l) => twoLines(percentTexts(l.bias, true))],
  ["p", (l) => fmtP(l.bias_p)],
  ["Variance", (l) => twoLines(intervalTexts(l.variance))],
  ["Bias²", (l) => twoLines(intervalTexts(l.bias2))],
  ["Mean R G B", (l) => (l.mean || []).map((x) => fmt(x, 4)).join("  ") || UNKNOWN],
  ["Error share of worst 0.1 %", (l) => fmtPercent(l.worst_share)],
  ["Estimated relative MSE", (l) => (l.self ? twoLines(intervalTexts(l.self.relmse)) : UNKNOWN)],
  ["Coverage", (l) => (l.self && known(l.self.total) ? joined(heldTexts(l.self)) : UNKNOWN)],
  ["Rays / sample", (l) => fmt(l.rays_per_sample)],
  ["Path length", (l) => fmt(l.path_length)],
  ["Reference noise share", (l) => fmtPercent(l.reference_share)],
  ["Invalid", (l) => fmtCount(l.invalid)],
];

function heldTexts({ inside, total, refused }) {
  return {
    value: `${inside} of ${total}`,
    bounds: refused > 0 ? `(${refused} without)` : "",
  };
}

function levelsDetails(strategy) {
  const levels = strategy.levels || [];
  return el("details.levels",
    el("summary",
      strategyLabel(strategy),
      el("span.bounds",
        levels.length === 0
          ? whyMissing(strategy)
          : `${levels.length} sample ${levels.length === 1 ? "count" : "counts"}`,
      ),
    ),
    strategy.text && el("p.full-text", strategy.text),
    strategy.message && el("p", strategy.message),
    levels.length > 0 &&
      plainTable(`All numbers of ${strategy.name}`, LEVEL_COLUMNS.map(([title]) => title),
        levels.map((level) => LEVEL_COLUMNS.map(([, cell]) => cell(level))),
      ),
  );
}

function levelsSection(view) {
  return section("data", "All numbers",
    el("p.lead", "The numbers of study.json. study.csv contains each repetition."),
    leadingRows(view, view.strategies, levelsDetails),
  );
}
