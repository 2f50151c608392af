"use strict";
// Rows of a profile as bars, and their differences from an earlier profile.

const { page } = study;
const groupNames = study.groups.map((group) => group.name);

// In the colour of its group; there are more groups than colours.
function groupColor(name) {
  const index = groupNames.indexOf(name);
  return index < COLOR_COUNT ? `var(--s${index})` : "var(--s-rest)";
}

// rows: {name, value, color, texts: {value, bounds}}; bars are as long as their values in
// relation to `most`.
function valueBars(rows, most = Math.max(...rows.map((row) => row.value))) {
  const bar = ({ value, color }) =>
    el("div.bar",
      el("div.bar-part", {
        style: { width: `${(100 * value) / most}%`, "background-color": color || "var(--s0)" },
      }),
    );
  return el("div.value-bars", { role: "list" },
    rows.map((row) =>
      el("div.value-bar", { role: "listitem" },
        el("span.value-name", row.name),
        bar(row),
        el("span.value-text", twoLines(row.texts)),
      ),
    ),
  );
}

function nanoseconds(interval, signed = false) {
  return intervalTexts(interval, 1, " ns", signed);
}

// Of groups, stages or materials: processor time per sample.
function costBars(rows, name = (row) => row.name) {
  return valueBars(rows.map((row) => ({
    name: name(row),
    value: row.share,
    color: groupColor(row.group),
    texts: {
      value: `${fmtPercent(row.share)}, ${nanoseconds(row.ns_per_sample).value}`,
      bounds: nanoseconds(row.ns_per_sample).bounds,
    },
  })));
}

const MOST_STAGES = 15;

function costsSection() {
  const rows = study.rows.filter((row) => row.share > 0);
  const rest = rows.slice(MOST_STAGES);
  const share = rest.reduce((sum, row) => sum + row.share, 0);
  const meanings = study.groups.filter((group) => group.meaning);
  return section("costs", "Processor time per sample",
    el("div.plots.bar-columns",
      el("div", el("h3", "By group"), costBars(study.groups)),
      el("div", el("h3", "By stage, in the colour of its group"),
        costBars(rows.slice(0, MOST_STAGES)),
        rest.length > 0 &&
          el("p.hint", `${rest.length} more rows take ${fmtPercent(share)}; the table has all.`)),
    ),
    meanings.map(({ name, meaning }) => el("p.hint", el("b", name), `: ${meaning}.`)),
  );
}

function materialsSection() {
  const rows = study.rows.filter((row) => row.material && row.share > 0);
  return rows.length > 0 &&
    section("materials", "Shading cost by material", costBars(rows, (row) => row.material));
}

function bouncesSection() {
  const { bounces, seconds } = study;
  if (bounces.length === 0) return null;
  const last = bounces.length === 16 ? 15 : -1; // it holds all later ones
  const name = ({ depth }) => `Bounce ${depth}${depth === last ? " and later" : ""}`;
  const color = "var(--s2)";
  const rays = (b) => rateTick(Math.round(b.rays_closest + b.rays_shadow));
  const cost = (b) => ({
    name: name(b), value: b.seconds, color,
    texts: { value: `${fmtPercent(b.seconds / seconds.threads)}, ${rays(b)} rays`, bounds: "" },
  });
  const lanes = (b) => ({
    name: name(b), value: b.occupancy, color: "var(--s5)",
    texts: { value: fmtPercent(b.occupancy), bounds: "" },
  });
  return section("bounces", "Cost and filled lanes by bounce",
    el("p.lead",
      "Bounce 0 is the camera ray. A wave with paths of several depths counts for each " +
        "depth by its number of paths."),
    el("div.plots.bar-columns",
      el("div", el("h3", "Fraction of all processor time"), valueBars(bounces.map(cost))),
      el("div", el("h3", "Lanes filled"),
        valueBars(bounces.filter((b) => known(b.occupancy)).map(lanes), 1)),
    ),
  );
}

const MOST_CHANGES = 15;

function changesSection() {
  const { against, changes, verdict } = page;
  if (!against) return null;
  const scale = whiskerScale(changes.slice(0, MOST_CHANGES).map((c) => c.difference), false, [0]);
  const growth = ({ before, now }) =>
    before > 0 ? `${fmt(before)} to ${fmt(now)} ns, ${fmtSignedPercent(now / before - 1)}` : "new";
  const row = (change) => {
    const style = { ...strategyStyle(0), variable: change.slower ? "--c6" : "--c7" };
    const texts = (x) => ({ value: joined(nanoseconds(x, true)), bounds: growth(change) });
    const name = change.slower ? `${change.name}: slower` : change.name;
    return rateRow(style, name, change.difference, texts, scale, [0]);
  };
  const fewer = changes.length - MOST_CHANGES;
  return section("against", `Difference from ${against}`,
    verdict.split(/\. (?=Judged)/).map((text, i) =>
      el(i === 0 ? "p.verdict" : "p.lead", capitalised(text))),
    changes.length > 0 && el("div.plot-figure.differences",
      rateAxis(scale, "ns per sample, now − before", fmtShort),
      changes.slice(0, MOST_CHANGES).map(row)),
    fewer > 0 && el("p.hint", `${fewer} rows with smaller differences are not shown.`),
  );
}
