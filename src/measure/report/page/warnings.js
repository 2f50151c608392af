"use strict";
// Warnings: one entry for each kind, with its strategies, so that no warning appears twice.

function plural(count, one, many) {
  return count === 1 ? one : many;
}

// [title, text, strategies] of what holds for some strategies; null if for none.
function about(strategies, title, text) {
  return strategies.length > 0 ? { title, text, strategies } : null;
}

function strategyWarnings(view) {
  const at = (test) => view.ran.filter((s) => s.level && test(s, s.level));
  const tiles = at((s) => s.tiles && (s.tiles.failed || []).length > 0);
  const invalid = at((s, level) => level.invalid > 0);
  const total = invalid.reduce((sum, s) => sum + s.level.invalid, 0);
  return [
    about(
      at((s) => s.heavy_tailed),
      "Heavy tails",
      "Rare bright samples cause most of the error. Intervals are unreliable: compare the " +
        "trimmed error and ignore the bias test.",
    ),
    about(
      at((s, level) => level.reference_limited),
      "Reference too noisy",
      "More than half of the error at the largest sample count is the noise of the " +
        "reference. Use a reference with more samples.",
    ),
    about(
      tiles,
      "Local bias",
      "Some tiles differ significantly from the reference and from the other strategies; " +
        "see the error maps.",
    ),
    about(
      invalid,
      "Invalid samples",
      `${fmtCount(total)} ${plural(total, "sample was", "samples were")} NaN, infinite or ` +
        "negative.",
    ),
  ];
}

function biasWarnings(view) {
  const bias = view.scene.bias || {};
  const listed = (indices) => (indices || []).map((i) => view.strategies[i]).filter(Boolean);
  const suspect = (bias.suspect_tiles || []).length;
  return [
    bias.failed > 0 && {
      title: "Bias",
      text:
        `The mean image of ${bias.failed} of ${bias.tests} strategies differs significantly from ` +
        `the reference and from the other strategies (Holm's test, level ${fmtShort(bias.level)}).`,
      strategies: listed(bias.strategies),
    },
    about(
      listed(bias.alike),
      "Reference may be wrong",
      "The mean images of these strategies differ significantly from the reference but agree " +
        "with each other.",
    ),
    suspect > 0 && {
      title: "Reference may be wrong locally",
      text:
        `In ${suspect} ${plural(suspect, "tile", "tiles")} the strategies agree with each ` +
        "other but not with the reference, so its estimated variance is probably too small there.",
      strategies: [],
    },
  ];
}

function calibrationWarning(scene) {
  const calibration = scene.calibration;
  if (!calibration || !calibration.share || !known(calibration.share.high)) return null;
  if (calibration.share.high >= calibration.stated - 0.05) return null;
  return {
    title: "Unreliable error estimates",
    text:
      `Only ${fmtPercent(calibration.share.value, 2)} of the renders have their true error inside ` +
      `their own ${fmtPercent(calibration.stated, 2)} confidence interval.`,
    strategies: [],
  };
}

// Several may be missing for one reason.
function missingWarnings(view) {
  const reasons = new Map();
  for (const s of view.strategies.filter((other) => statusWord(other))) {
    const reason = whyMissing(s);
    reasons.set(reason, [...(reasons.get(reason) || []), s]);
  }
  return [...reasons].map(([text, who]) => ({ title: someNames(who), text, strategies: [] }));
}

function warningTexts(view) {
  const { scene } = view;
  const plain = (title, text) => ({ title, text, strategies: [] });
  return [
    (scene.cautions || []).length > 0 && plain("Ranking", scene.cautions.join(" ")),
    ...missingWarnings(view),
    ...biasWarnings(view),
    ...strategyWarnings(view),
    calibrationWarning(scene),
    scene.interrupted &&
      plain("Interrupted", "Some renders are missing; use --resume to finish them."),
    scene.reference && scene.reference.note && plain("Reference", scene.reference.note),
    scene.report_scale > 1 &&
      plain(
        "Images",
        `They are scaled to 1/${scene.report_scale} in this report; the EXR files have full size.`,
      ),
  ].filter(Boolean);
}

function warningItem({ title, text, strategies }) {
  return el("li", el("b", `${title}:`), ` ${text}`, strategies.length > 0 && [
    " ",
    el("span.who", { title: strategies.map((s) => s.name).join(", ") },
      `(${strategies.length > 1 ? `${strategies.length} strategies: ` : ""}` +
        `${someNames(strategies)})`,
    ),
  ]);
}

function warningsList(view) {
  const items = warningTexts(view);
  if (items.length === 0) {
    return el("p.all-well",
      "No warnings: all strategies finished, no bias test failed, and the reference is " +
        "accurate enough.",
    );
  }
  const title = items.length === 1 ? "1 warning" : `${items.length} warnings`;
  return warningBox(title, items.map(warningItem));
}
