"use strict";
// The first screen: the verdict, what was measured and how, and what to beware of.

function summarySection(view) {
  const { scene } = view;
  return el(
    "section",
    { id: "summary", "aria-labelledby": "summary-title" },
    el("h1", { id: "summary-title" }, scene.name),
    scene.verdict
      ? el("p", { class: "verdict" }, scene.verdict)
      : el("p", { class: "verdict" }, "There is no verdict for this scene."),
    factsList(view),
    warningsList(view),
    notesList(scene),
  );
}

function fact(term, value, note) {
  if (!value) return null;
  return el(
    "div",
    {},
    el("dt", {}, term),
    el("dd", {}, value, note && el("span", { class: "note" }, note)),
  );
}

function factsList(view) {
  const { scene } = view;
  const settings = study.settings || {},
    machine = study.machine || {};
  const size = scene.resolution
    ? `${scene.resolution[0]} × ${scene.resolution[1]} pixels`
    : null;
  const repetitions = known(settings.repetitions) ? fmtCount(settings.repetitions) : null;
  const threads = known(machine.threads) ? `${fmtCount(machine.threads)} threads` : null;
  return el(
    "dl",
    { class: "facts" },
    fact("Image", size, cropNote(scene)),
    fact("Repetitions", repetitions, "of every cell, interleaved, with different seeds"),
    fact("Confidence", confidenceText(), "of all intervals, unless said otherwise"),
    fact("Samples", countsText(scene.counts), "per pixel"),
    fact(
      "Machine",
      [machine.target, threads].filter(Boolean).join(", "),
      versionsText(machine.versions),
    ),
    fact("Reference", referenceText(scene.reference), referenceNote(scene.reference)),
    fact(
      "Study took",
      known(study.seconds) ? fmtSeconds(study.seconds) : null,
      study.scenes.length > 1 ? "for all scenes" : null,
    ),
  );
}

function cropNote(scene) {
  const c = scene.crop,
    size = scene.resolution;
  if (!c || !size || (c[0] === 0 && c[1] === 0 && c[2] === size[0] && c[3] === size[1])) {
    return null;
  }
  return `rendered: columns ${c[0]} to ${c[2]}, rows ${c[1]} to ${c[3]}`;
}

function countsText(counts) {
  if (!counts || counts.length === 0) return null;
  if (counts.length <= 4) return counts.map(fmtCount).join(", ");
  return (
    `${counts.length} counts, ${fmtCount(counts[0])} to ` +
    fmtCount(counts[counts.length - 1])
  );
}

function versionsText(versions) {
  if (!versions || typeof versions !== "object") return null;
  return Object.entries(versions)
    .filter(([, v]) => typeof v === "string" || known(v))
    .map(([name, v]) => `${name} ${v}`)
    .join(", ");
}

function referenceText(reference) {
  if (!reference) return null;
  if (reference.source === "file") {
    const names = (reference.files || []).map((path) => path.split("/").pop());
    return names.join(", ") || "from a file";
  }
  const spp = known(reference.spp) ? `, ${fmtCount(reference.spp)} spp` : "";
  return `rendered${spp}`;
}

function referenceNote(reference) {
  if (!reference) return null;
  const parts = [];
  if (known(reference.relmse)) parts.push(`own relative MSE ${fmt(reference.relmse)}`);
  parts.push(
    reference.independent
      ? "subtracted from all errors"
      : "its own error could not be estimated",
  );
  if (reference.strategy) parts.push(reference.strategy);
  return parts.join("; ");
}

function warningTexts(view) {
  const { scene } = view;
  const out = [];
  for (const s of view.strategies) {
    if (statusWord(s)) out.push([s.name, whyMissing(s)]);
  }
  for (const s of view.ran) {
    if (s.heavy_tailed) {
      out.push([
        s.name,
        "Heavy tails: rare bright samples carry most of the error. Its " +
          "intervals may not hold; compare the trimmed error.",
      ]);
    }
    if (s.level && s.level.reference_limited) {
      out.push([
        s.name,
        "The reference's own error is more than half of the measured " +
          "difference at the largest count: the error is not well known.",
      ]);
    }
    if (s.tiles && s.tiles.failed && s.tiles.failed.length > 0) {
      out.push([
        s.name,
        `${s.tiles.failed.length} of ${s.tiles.columns * s.tiles.rows} ` +
          "tiles differ from the reference by more than noise explains.",
      ]);
    }
    if (s.level && s.level.invalid > 0) {
      out.push([
        s.name,
        `${fmtCount(s.level.invalid)} samples were not finite or negative.`,
      ]);
    }
  }
  if (scene.bias && scene.bias.failed > 0) {
    out.push([
      "Bias",
      `${scene.bias.failed} of ${scene.bias.tests} strategies differ from ` +
        `the reference in the mean (Holm, level ${fmtShort(scene.bias.level)}).`,
    ]);
  }
  const calibration = scene.calibration;
  if (calibration && known(calibration.share.high) &&
      calibration.share.high < calibration.stated - 0.05) {
    out.push([
      "Self-estimates",
      `held their true error in ${fmtPercent(calibration.share.value, 2)} of the renders ` +
        `only, ${fmtPercent(calibration.stated, 2)} were stated.`,
    ]);
  }
  if (scene.report_scale > 1) {
    out.push([
      "Images",
      `are shown here at 1/${scene.report_scale} of their size; the EXR files are whole.`,
    ]);
  }
  if (scene.reference && scene.reference.note)
    out.push(["Reference", scene.reference.note]);
  return out;
}

function warningsList(view) {
  const texts = warningTexts(view);
  if (texts.length === 0) {
    return el(
      "p",
      { class: "all-well" },
      "Nothing to beware of: every strategy ran, no test " +
        "failed, and the reference is good enough.",
    );
  }
  return el(
    "div",
    { class: "warnings", role: "note" },
    el(
      "h3",
      {},
      texts.length === 1 ? "One thing to know" : `${texts.length} things to know`,
    ),
    el(
      "ul",
      {},
      texts.map(([who, what]) => el("li", {}, el("b", {}, who), ` ${what}`)),
    ),
  );
}

function notesList(scene) {
  if (!scene.notes || scene.notes.length === 0) return null;
  return el(
    "details",
    { class: "notes" },
    el("summary", {}, `Notes on the scene file (${scene.notes.length})`),
    el(
      "ul",
      {},
      scene.notes.map((note) => el("li", {}, note)),
    ),
  );
}
