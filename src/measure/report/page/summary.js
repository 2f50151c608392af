"use strict";
// First screen: the result, warnings, and facts on the measurement.

function summarySection(view) {
  const { scene } = view;
  return firstSection(scene.name,
    hero(view),
    warningsList(view),
    factsList(view),
    notesList(scene),
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
  const versions = versionsText(machine.versions);
  const threads = known(machine.threads) ? `${fmtCount(machine.threads)} threads` : null;
  return el("dl.facts",
    fact("Image", size, cropNote(scene)),
    fact("Repetitions", repetitions, "per strategy and sample count, interleaved, with different seeds"),
    fact("Confidence", confidenceText(), "of all intervals, unless stated otherwise"),
    fact("Samples", countsText(scene.counts), "per pixel"),
    fact("Reference", referenceText(scene.reference), referenceNote(scene.reference)),
    fact("Study took", known(study.seconds) ? fmtSeconds(study.seconds) : null,
      study.scenes.length > 1 ? "for all scenes" : null,
    ),
    fact("Machine", machinesText(scene.machines) || machine.text,
      [machine.target, threads, versions].filter(Boolean).join(", "),
      { class: "wide" },
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
  if (known(reference.relmse)) parts.push(`its relative MSE: ${fmt(reference.relmse)}`);
  parts.push(
    reference.independent
      ? "its noise is subtracted from all errors"
      : "its own error is unknown",
  );
  const text = parts.join("; ");
  if (!reference.strategy) return text;
  return el("details.reference-strategy",
    el("summary", text),
    el("span.full-text", breakable(reference.strategy)),
  );
}

function notesList(scene) {
  if (!scene.notes || scene.notes.length === 0) return null;
  return el("details.notes",
    el("summary", `Notes on the scene file (${scene.notes.length})`),
    el("ul", scene.notes.map((note) => el("li", note))),
  );
}
