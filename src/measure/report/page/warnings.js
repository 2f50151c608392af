"use strict";
// What to beware of: one entry for each kind, with the strategies that it is about, so
// that nothing is said twice and nothing contradicts the verdict.

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
      "Rare bright samples carry most of the error: intervals may not hold; compare the " +
        "trimmed error, and do not read their tests of bias.",
    ),
    about(
      at((s, level) => level.reference_limited),
      "Reference too noisy",
      "More than half of what was measured at the largest count is the reference's own " +
        "error: the error is not well known.",
    ),
    about(
      tiles,
      "Parts of the image differ",
      "Some tiles differ both from the reference and from the other strategies by more " +
        "than noise explains; the maps show where.",
    ),
    about(
      invalid,
      "Invalid samples",
      `${fmtCount(total)} ${plural(total, "sample was", "samples were")} not finite or ` +
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
        `${bias.failed} of ${bias.tests} strategies differ in the mean from the reference ` +
        `and from the others (Holm, level ${fmtShort(bias.level)}).`,
      strategies: listed(bias.strategies),
    },
    about(
      listed(bias.alike),
      "The reference, rather than a strategy",
      "The means differ from that of the reference by more than noise, but not from each " +
        "other.",
    ),
    suspect > 0 && {
      title: "The reference, in places",
      text:
        `In ${suspect} ${plural(suspect, "tile", "tiles")} the strategies agree with each ` +
        "other and not with the reference: it is less sure there than it says.",
      strategies: [],
    },
  ];
}

function calibrationWarning(scene) {
  const calibration = scene.calibration;
  if (!calibration || !calibration.share || !known(calibration.share.high)) return null;
  if (calibration.share.high >= calibration.stated - 0.05) return null;
  return {
    title: "Self-estimates",
    text:
      `Intervals that renders stated held in ${fmtPercent(calibration.share.value, 2)} of ` +
      `them only; ${fmtPercent(calibration.stated, 2)} were promised.`,
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
    (scene.cautions || []).length > 0 && plain("Ranking:", scene.cautions.join(" ")),
    ...missingWarnings(view),
    ...biasWarnings(view),
    ...strategyWarnings(view),
    calibrationWarning(scene),
    scene.interrupted &&
      plain("Interrupted", "Renders are missing; --resume does them."),
    scene.reference && scene.reference.note && plain("Reference", scene.reference.note),
    scene.report_scale > 1 &&
      plain(
        "Images",
        `are shown here at 1/${scene.report_scale} of their size; the EXR files are whole.`,
      ),
  ].filter(Boolean);
}

function warningItem({ title, text, strategies }) {
  return el("li", el("b", title), ` ${text}`, strategies.length > 0 && [
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
      "Nothing to beware of: every strategy ran, no test " +
        "failed, and the reference is good enough.",
    );
  }
  const title = items.length === 1 ? "One thing to know" : `${items.length} things to know`;
  return warningBox(title, items.map(warningItem));
}
