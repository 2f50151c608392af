"use strict";
// Which strategy survives stiffness: strategies against the parameter, coloured by their
// efficiency relative to the default's, with a mark where they are wrong.

const compared = study.cases.filter((c) => c.strategies && maps.includes(c));

// Opacity of the colour, and which one: a factor of ten is full.
function efficiencyColor(ratio) {
  const size = Math.min(1, Math.abs(Math.log10(ratio)));
  const color = ratio >= 1 ? "var(--c0)" : "var(--c1)";
  return `color-mix(in srgb, ${color} ${Math.round(size * 70)}%, var(--panel))`;
}

function heatText(point) {
  if (point.refused) return "refused";
  if (point.crash) return "crashed";
  const ratio = valueOf(point.efficiency);
  return ratio === null ? UNKNOWN : `×${fmt(ratio, 2)}`;
}

function heatCell(aCase, line, point) {
  if (!point) return el("td", {}, "");
  const ratio = hasNumber(point) ? valueOf(point.efficiency) : null;
  const bad = !point.verdict.good;
  const cell = el(
    "td",
    {
      class: bad ? "heat bad" : "heat",
      tabindex: 0,
      style: ratio > 0 ? { background: efficiencyColor(ratio) } : {},
    },
    heatText(point),
    bad && hasNumber(point) && el("span", { class: "biased" }, point.verdict.why),
  );
  return withTip(cell, () => [
    describePoint(aCase)(line, point),
    ratio !== null &&
      el("div", {}, `efficiency ${joined(intervalTexts(point.efficiency))}`),
  ]);
}

function heatMap(aCase, target) {
  const lines = seriesOf(aCase, target);
  const values = [
    ...new Set(lines.flatMap((line) => line.points.map((p) => p.parameter))),
  ].sort((a, b) => a - b);
  const promised = (x) => {
    const { promised_low: low, promised_high: high } = aCase.axis;
    return !(known(low) && x < low) && !(known(high) && x > high);
  };
  return el(
    "div",
    { class: "heat-block", "data-heat": aCase.name },
    el("h3", {}, aCase.name, " ", el("span", { class: "note" }, aCase.extreme)),
    el(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": aCase.name },
      el(
        "table",
        { class: "data heat-map" },
        el(
          "thead",
          {},
          el(
            "tr",
            {},
            el("th", { class: "text", scope: "col" }, aCase.axis.name),
            values.map((x) =>
              el(
                "th",
                { scope: "col", class: promised(x) ? "inside" : null },
                fmtParameter(aCase, x),
              ),
            ),
          ),
        ),
        el(
          "tbody",
          {},
          lines.map((line) =>
            el(
              "tr",
              {},
              el("th", { scope: "row", class: "text" }, strategyLabel(line)),
              values.map((x) =>
                heatCell(
                  aCase,
                  line,
                  line.points.find((p) => p.parameter === x),
                ),
              ),
            ),
          ),
        ),
      ),
    ),
  );
}

// "points=cmj: in 3 of 4 maps", for the sentence above the tables.
function survivors(target) {
  const counts = new Map();
  for (const aCase of compared) {
    for (const line of seriesOf(aCase, target)) {
      const count = counts.get(line.name) || { maps: 0, good: 0 };
      const mine = line.points.filter((p) => p.promised);
      count.maps += 1;
      count.good += mine.length > 0 && mine.every((p) => p.verdict.good);
      counts.set(line.name, count);
    }
  }
  return counts;
}

function survivalText(target) {
  const counts = [...survivors(target)];
  const wrong = counts.filter(([, { maps: all, good }]) => good < all);
  const text =
    wrong.length === 0
      ? `All ${counts.length} strategies stay unbiased over the promised range of every map.`
      : `Wrong inside a promised range: ${wrong
          .map(([name, { maps: all, good }]) => `${name} (${all - good} of ${all} maps)`)
          .join(", ")}.`;
  return `${text} Numbers are efficiencies, 1 / (variance × processor time), relative to `;
}

function strategiesSection(target) {
  if (compared.length === 0) return null;
  const baselines = [...new Set(compared.map((c) => c.baseline))];
  return section(
    "strategies",
    "Which strategy survives stiffness",
    el("p", { class: "lead" }, survivalText(target), el("b", {}, baselines.join(", ")),
      ": blue is better, orange is worse, full colour a factor of ten."),
    compared.map((aCase) => heatMap(aCase, target)),
  );
}
