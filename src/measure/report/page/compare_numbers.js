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
  ["its root", (c) => fmtPercent(Math.sqrt(c.relmse))],
  ["without the worst 0.1 %", (c) => fmt(c.relmse_trimmed)],
  ["after filters of 2, 4, 8 pixels", (c) => c.relmse_filtered.map((x) => fmt(x)).join(", ")],
  ["MSE", (c) => fmt(c.mse)],
  ["RMSE", (c) => fmt(c.rmse)],
  ["Mean absolute error", (c) => fmt(c.mae)],
  ["Mean absolute percentage error", (c) => fmtPercent(c.mape)],
  ["PSNR", (c) => (known(c.psnr) ? `${fmt(c.psnr)} dB` : UNKNOWN)],
  ["Mean against the reference's", (c) => c.mean_ratio.map((x) => fmt(x, 5)).join(", ")],
  ["Invalid values", (c) => fmtCount(c.invalid_test)],
  ...flipRows("hdr", "FLIP at all exposures"),
  ...flipRows("ldr", "FLIP on screen"),
  [
    "Differ by more than 2 standard errors (noise alone: 4.55 %)",
    (c) => (c.z.available && c.z.count > 0 ? fmtPercent(c.z.beyond_2) : UNKNOWN),
  ],
  ["Agreement", (c) => c.agreement.verdict],
  ["p of the test", (c) => pText(c.agreement.p)],
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
      ["measure", ...comparisons.map((c) => c.test)],
      rows.map(([name, text]) => [name, ...comparisons.map(text)]),
    ),
    el("p.hint",
      "Relative MSE: mean of (a − b)² / (b² + 0.01). FLIP: 0 looks alike, 1 as different as " +
        "can be, to somebody who flips between the images; quartiles are weighted by the " +
        "error itself. All are of these very pixels and no estimates, so they have no " +
        "interval.",
    ),
  );
}
