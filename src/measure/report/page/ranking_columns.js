"use strict";
// The columns of the ranking.

// A column of an interval of the level that the ranking is of. common: the values' common
// scale, which then stands in the header; null for each its own.
function levelColumn(
  view,
  key,
  title,
  unit,
  hint,
  { scaled = commonScale, texts = intervalTexts } = {},
) {
  const intervalOf = (s) => s.level && s.level[key];
  const common = scaled && scaled(view.ranked.map((s) => valueOf(intervalOf(s))));
  const cell = (s) =>
    common ? intervalTexts(intervalOf(s), common.scale) : texts(intervalOf(s));
  return {
    key,
    title,
    hint,
    unit: [unit, common && common.unit].filter(Boolean).join(", "),
    cell: (s) => twoLines(cell(s)),
    sort: (s) => valueOf(intervalOf(s)),
  };
}

function levelNumber(key, title, hint, format) {
  return {
    key,
    title,
    hint,
    cell: (s) => format(s.level ? s.level[key] : null),
    sort: (s) => (s.level && known(s.level[key]) ? s.level[key] : null),
  };
}

function targetColumn(view, key, title, texts) {
  const target = view.scene.target_relmse;
  return {
    key: `target-${key}`,
    title,
    unit: known(target) ? `to ${fmtShort(target)}` : null,
    hint: "To reach the target's relative MSE; * extrapolated: no render got there",
    cell: (s) => {
      if (!s.to_target) return UNKNOWN;
      const { value, bounds } = texts(s.to_target[key]);
      return twoLines({ value: s.to_target.extrapolated ? `${value} *` : value, bounds });
    },
    sort: (s) => (s.to_target ? valueOf(s.to_target[key]) : null),
  };
}

function efficiencyColumns(view, scale) {
  return [
    {
      key: "efficiency",
      title: "Efficiency",
      unit: "relative",
      descendingFirst: true,
      cell: (s) =>
        twoLines(intervalTexts(s.efficiency), s === view.baseline ? "baseline" : null),
      sort: (s) => valueOf(s.efficiency),
    },
    {
      key: "whisker",
      title: "",
      text: true,
      axis: scale && whiskerAxis(scale, { width: 160 }),
      cell: (s) =>
        whisker(s.efficiency, scale, {
          style: s.style,
          marks: [1],
          width: 160,
          label: `Efficiency of ${s.name}`,
        }),
    },
    {
      key: "efficiency-trimmed",
      title: "Trimmed",
      unit: "efficiency",
      hint: "Efficiency without the worst 1 % of the pixels of each render",
      descendingFirst: true,
      cell: (s) => twoLines(intervalTexts(s.efficiency_trimmed)),
      sort: (s) => valueOf(s.efficiency_trimmed),
    },
  ];
}

function coverageTexts(self) {
  if (!self || !known(self.total)) return { value: UNKNOWN, bounds: "" };
  const refused = self.refused > 0 ? `${self.refused} without` : "";
  if (self.total === 0) return { value: UNKNOWN, bounds: refused };
  return {
    value: fmtPercent(self.inside / self.total, 2),
    bounds: [`${self.inside} of ${self.total}`, refused].filter(Boolean).join(", "),
  };
}

// With places to break a line after the commas.
function breakable(text) {
  return text
    .split(",")
    .flatMap((part, i, all) => [part + (i + 1 < all.length ? "," : ""), el("wbr")]);
}

// What answers the question; the rest is for those who doubt it.
const MAIN_COLUMNS = new Set([
  "rank",
  "name",
  "efficiency",
  "whisker",
  "efficiency-trimmed",
  "relmse",
  "cpu_seconds",
  "order",
  "target-seconds",
]);

// The full text on demand: it may be five lines long.
function nameCell(s) {
  if (!s.text || s.text === s.name) return strategyLabel(s);
  return el("details.name",
    el("summary", strategyLabel(s)),
    el("span.full-text", breakable(s.text)),
  );
}

function rankingColumns(view, scale) {
  const spp = new Set(view.ran.map((s) => s.at_spp).filter(known));
  const at = spp.size === 1 ? `at ${fmtCount([...spp][0])} spp` : "at the most spp";
  const wholeTexts = (interval) => {
    const x = valueOf(interval);
    return x !== null && x >= 100 && x < 1e9
      ? {
          value: fmtCount(x),
          bounds: hasBounds(interval)
            ? `[${fmtCount(interval.low)}, ${fmtCount(interval.high)}]`
            : "",
        }
      : intervalTexts(interval);
  };
  return [
    {
      key: "rank",
      title: "Rank",
      text: true,
      cell: (s) => rankCell(view, s),
      sort: (s) => view.ranked.indexOf(s),
    },
    {
      key: "name",
      title: "Strategy",
      text: true,
      rowHead: true,
      cell: nameCell,
      sort: (s) => s.name,
    },
    ...efficiencyColumns(view, scale),
    levelColumn(
      view,
      "relmse",
      "Relative MSE",
      at,
      "Squared error over squared reference + 0.01",
    ),
    levelColumn(
      view,
      "relmse_trimmed",
      "Trimmed",
      "relative MSE",
      "Relative MSE without the worst 1 % of the pixels",
    ),
    levelColumn(view, "cpu_seconds", "Time", "processor", "Median of one render", {
      scaled: commonTime,
      texts: secondsTexts,
    }),
    {
      key: "order",
      title: "Order",
      unit: "of convergence",
      hint: "Slope of log RMSE over log samples; −0.5 for independent samples",
      cell: (s) => twoLines(intervalTexts(s.order)),
      sort: (s) => valueOf(s.order),
    },
    targetColumn(view, "spp", "Samples", wholeTexts),
    targetColumn(view, "seconds", "Time", secondsTexts),
    levelColumn(
      view,
      "bias",
      "Bias",
      "of the mean",
      "Mean of the image against the reference",
      { scaled: null, texts: (interval) => percentTexts(interval, true) },
    ),
    levelNumber("bias_p", "p", "Welch's test that the means are equal", fmtP),
    levelColumn(view, "variance", "Variance", null, "Part of the relative MSE"),
    levelColumn(
      view,
      "bias2",
      "Bias²",
      null,
      "Part of the relative MSE; can be negative by chance",
    ),
    {
      key: "self",
      title: "Coverage",
      unit: "self-estimate",
      hint: "How often the interval that a render states of itself held its true error",
      cell: (s) => twoLines(coverageTexts(s.level && s.level.self)),
      sort: (s) =>
        s.level && s.level.self && s.level.self.total
          ? s.level.self.inside / s.level.self.total
          : null,
    },
    levelNumber("rays_per_sample", "Rays", "of all kinds, per sample", fmt),
    levelNumber("path_length", "Path", "Scattering rays per sample", fmt),
  ];
}
