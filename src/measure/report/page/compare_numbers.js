"use strict";
// The numbers of all comparisons, a column each.

const FLIP_PARTS = [
  ["mean", "mean"],
  ["median", "weighted median"],
  ["first_quartile", "weighted first quartile"],
  ["third_quartile", "weighted third quartile"],
  ["max", "largest"],
];

function flipRows(key, title) {
  return FLIP_PARTS.map(([part, text]) => [
    `${title}, ${text}`,
    (c) => (c.flip && c.flip[key] ? fmt(c.flip[key][part]) : UNKNOWN),
  ]);
}

const COMPARISON_ROWS = [
  ["Relative MSE", (c) => fmt(c.relmse)],
  ["Square root of the relative MSE", (c) => fmtPercent(Math.sqrt(c.relmse))],
  ["Relative MSE without the worst 0.1 % of the pixels", (c) => fmt(c.relmse_trimmed)],
  ["Relative MSE after box filters of 2, 4, 8 pixels", (c) => c.relmse_filtered.map((x) => fmt(x)).join(", ")],
  ["MSE", (c) => fmt(c.mse)],
  ["RMSE", (c) => fmt(c.rmse)],
  ["Mean absolute error", (c) => fmt(c.mae)],
  ["Mean absolute percentage error", (c) => fmtPercent(c.mape)],
  ["PSNR", (c) => (known(c.psnr) ? `${fmt(c.psnr)} dB` : UNKNOWN)],
  ["Mean / mean of the reference (R, G, B)", (c) => c.mean_ratio.map((x) => fmt(x, 5)).join(", ")],
  ["Invalid values", (c) => fmtCount(c.invalid_test)],
  ...flipRows("hdr", "FLIP at all exposures"),
  ...flipRows("ldr", "FLIP of the displayed range"),
  [
    "Values (pixels × channels) that differ by more than 2 standard errors (noise alone: 4.55 %)",
    (c) => (c.z.available && c.z.count > 0 ? fmtPercent(c.z.beyond_2) : UNKNOWN),
  ],
  ["Test result", (c) => c.agreement.verdict],
  ["p-value of the test", (c) => pText(c.agreement.p)],
];

// Beyond that, distributions are not what they are taken for.
function pText(p) {
  return known(p) && p < 1e-12 ? "< 10⁻¹²" : fmt(p, 2);
}

function numbersSection() {
  const { comparisons } = study;
  const rows = COMPARISON_ROWS.filter(([, text]) =>
    comparisons.some((c) => text(c) !== UNKNOWN),
  );
  return section("numbers", "Numbers",
    plainTable("Numbers",
      ["Measure", ...comparisons.map((c) => c.test)],
      rows.map(([name, text]) => [name, ...comparisons.map(text)]),
    ),
    el("p.hint",
      "Relative MSE: mean of (a − b)² / (b² + 0.01). FLIP estimates the difference that a " +
        "viewer perceives when flipping between the images: 0 is identical, 1 is the " +
        "maximum. FLIP medians and quartiles are weighted by the error. These numbers " +
        "describe the given pixels and are not estimates, so they have no intervals.",
    ),
  );
}
