"use strict";
// The columns of the ranking.

// A column of an interval of the level that the ranking is of. common: the values' common
// scale, which then stands in the header; null for each its own.
function levelColumn(view, key, title, unit, hint, scaled = commonScale, texts) {
  const of = (s) => s.level && s.level[key];
  const common = scaled && scaled(view.ranked.map((s) => valueOf(of(s))));
  return intervalColumn(key, title, of,
    common ? (interval) => intervalTexts(interval, common.scale) : texts,
    { hint, unit: [unit, common && common.unit].filter(Boolean).join(", ") },
  );
}

function levelNumber(key, title, hint, format) {
  return numberColumn(key, title, (s) => (s.level ? s.level[key] : null), format, { hint });
}

function targetColumn(view, key, title, texts) {
  const target = view.scene.target_relmse;
  const of = (s) => s.to_target && s.to_target[key];
  return intervalColumn(`target-${key}`, title, of, texts, {
    unit: "to the target",
    hint: `Needed to reach the target relative MSE${known(target) ? ` of ${fmtShort(target)}` : ""}; ` +
      "*: extrapolated beyond the measured sample counts",
    cell: (s) => {
      if (!s.to_target) return UNKNOWN;
      const { value, bounds } = texts(of(s));
      return twoLines({ value: s.to_target.extrapolated ? `${value} *` : value, bounds });
    },
  });
}

function efficiencyColumns(view, scale) {
  const drawn = { marks: [1], width: 160 };
  return [
    intervalColumn("efficiency", "Efficiency", (s) => s.efficiency, intervalTexts, {
      unit: "relative",
      descendingFirst: true,
      cell: (s) =>
        twoLines(intervalTexts(s.efficiency), s === view.baseline ? "baseline" : null),
    }),
    {
      key: "whisker",
      title: "",
      text: true,
      axis: scale && whiskerAxis(scale, { width: 160 }),
      cell: ({ efficiency, style, name }) =>
        whisker(efficiency, scale, { ...drawn, style, label: `Efficiency of ${name}` }),
    },
    intervalColumn("efficiency-trimmed", "Trimmed", (s) => s.efficiency_trimmed,
      intervalTexts,
      {
        unit: "efficiency",
        hint: "Efficiency without the worst 1 % of the pixels of each render",
        descendingFirst: true,
      },
    ),
  ];
}

function coverageTexts(self) {
  if (!self || !known(self.total)) return { value: UNKNOWN, bounds: "" };
  const refused = self.refused > 0 ? `${self.refused} unknown` : "";
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
const MAIN_COLUMNS = new Set(["rank", "name", "efficiency", "whisker", "efficiency-trimmed",
                              "relmse", "cpu_seconds", "order", "target-seconds"]);

// The full text on demand: it may be five lines long.
function nameCell(s) {
  if (!s.text || s.text === s.name) return strategyLabel(s);
  return el("details.name",
    el("summary", strategyLabel(s)),
    el("span.full-text", breakable(s.text)),
  );
}

// Counts of samples as whole numbers.
function wholeTexts(interval) {
  const x = valueOf(interval);
  if (x === null || x < 100 || x >= 1e9) return intervalTexts(interval);
  const ends = [interval.low, interval.high].map(fmtCount);
  return { value: fmtCount(x), bounds: hasBounds(interval) ? `[${ends.join(", ")}]` : "" };
}

function coverageColumn() {
  const self = (s) => s.level && s.level.self;
  return {
    key: "self",
    title: "Coverage",
    unit: "self-estimate",
    hint: "Percentage of renders whose own confidence interval contains the true error; unknown: no interval",
    cell: (s) => twoLines(coverageTexts(self(s))),
    sort: (s) => (self(s) && self(s).total ? self(s).inside / self(s).total : null),
  };
}

function rankingColumns(view, scale) {
  const spp = new Set(view.ran.map((s) => s.at_spp).filter(known));
  const at = spp.size === 1 ? `at ${fmtCount([...spp][0])} spp` : "at the largest spp";
  const signed = (interval) => percentTexts(interval, true);
  const level = (...column) => levelColumn(view, ...column);
  return [
    textColumn("rank", "Rank", (s) => rankCell(view, s), {
      sort: (s) => view.ranked.indexOf(s),
    }),
    textColumn("name", "Strategy", nameCell, { rowHead: true, sort: (s) => s.name }),
    ...efficiencyColumns(view, scale),
    level("relmse", "Relative MSE", at, "Mean of squared error / (squared reference + 0.01)"),
    level("relmse_trimmed", "Trimmed", "relative MSE",
      "Relative MSE without the worst 1 % of the pixels"),
    level("cpu_seconds", "Time", "processor", "Median processor time of one render", commonTime,
      secondsTexts),
    intervalColumn("order", "Order", (s) => s.order, intervalTexts, {
      unit: "of convergence",
      hint: "Slope of log RMSE over log samples; −0.5 for independent samples",
    }),
    targetColumn(view, "spp", "Samples", wholeTexts),
    targetColumn(view, "seconds", "Time", secondsTexts),
    level("bias", "Bias", "of the mean", "Mean of the image relative to the reference", null,
      signed),
    levelNumber("bias_p", "p", "Welch's test that the means are equal", fmtP),
    level("variance", "Variance", null, "Variance part of the relative MSE"),
    level("bias2", "Bias²", null, "Bias² part of the relative MSE; an estimate, can be negative by chance"),
    coverageColumn(),
    levelNumber("rays_per_sample", "Rays", "per sample", fmt),
    levelNumber("path_length", "Path", "Scattering rays per sample", fmt),
  ];
}
