"use strict";
// Strategies at extreme parameters: strategies against the parameters of all maps that
// compare them, coloured by efficiency, with a mark where they are wrong.

const compared = study.cases
  .filter((c) => c.strategies && maps.includes(c))
  .map((c) => [new Set(c.points.map((p) => p.series)).size, c])
  .sort((a, b) => b[0] - a[0]) // those that say most first
  .map(([, c]) => c);

// A factor of ten is full colour.
function efficiencyColor(ratio) {
  const size = Math.min(1, Math.abs(Math.log10(ratio)));
  const color = ratio >= 1 ? "var(--c0)" : "var(--c1)";
  return `color-mix(in srgb, ${color} ${Math.round(size * 65)}%, var(--panel))`;
}

// Few characters: "0.85", "2.1", "35", "13k", "10⁻⁴"; where one of the two has no noise
// but that of rounding, "≫".
function ratioText(ratio) {
  if (!(ratio > 0)) return UNKNOWN;
  if (ratio < 1e-6) return "≪";
  if (ratio >= 1e6) return "≫";
  if (ratio < 0.001) return powerOfTen(Math.round(Math.log10(ratio)));
  if (ratio < 0.0995) return String(Number(ratio.toPrecision(1)));
  if (ratio < 9.95) return ratio.toFixed(ratio < 0.995 ? 2 : 1);
  return ratio < 1e3 ? String(Math.round(ratio)) : `${Math.round(ratio / 1e3)}k`;
}

function heatText(point) {
  if (point.not_measured) return "·";
  if (point.refused) return "refused";
  if (point.crash) return "crashed";
  return ratioText(valueOf(point.efficiency));
}

function heatCell(aCase, line, point, first) {
  const edge = first ? " first" : "";
  if (!point) return el("td", { class: `heat${edge}` }, "");
  const ratio = hasNumber(point) ? valueOf(point.efficiency) : null;
  const bad = !point.verdict.good;
  const cell = el("td",
    {
      class: `heat${bad ? " bad" : ""}${edge}`, tabindex: 0,
      style: ratio > 0 ? { background: efficiencyColor(ratio) } : {},
    },
    heatText(point),
  );
  return withTip(cell, () => [
    describePoint(aCase)(line, { point }),
    ratio !== null &&
      el("div", `relative efficiency ${joined(intervalTexts(point.efficiency))}`),
  ]);
}

// {aCase, values, lines: Map from strategy to its points} of a map on a target.
function heatColumns(aCase, target) {
  const lines = seriesOf(aCase, target);
  const values = lines.flatMap((line) => line.points.map((p) => p.parameter));
  return {
    aCase,
    values: [...new Set(values)].sort((a, b) => a - b),
    lines: new Map(lines.map((line) => [line.name, line])),
  };
}

function isPromised({ axis }, x) {
  const { promised_low: low, promised_high: high } = axis;
  return !(known(low) && x < low) && !(known(high) && x > high);
}

function heatHead(blocks) {
  const names = blocks.map(({ aCase, values }) =>
    withTip(
      el("th.first.map-title", { scope: "colgroup", colspan: values.length },
        aCase.name.replace(/^strateg(y|ies)-/, ""),
      ),
      () => noteOf(aCase.name, aCase.extreme),
    ),
  );
  const parameters = blocks.flatMap(({ aCase, values }) =>
    values.map((x, i) =>
      el("th",
        { scope: "col", class: [i === 0 && "first", isPromised(aCase, x) && "inside"]
            .filter(Boolean)
            .join(" ") },
        parameterTick(x),
      ),
    ),
  );
  return el("thead",
    el("tr", el("th.text", { scope: "col" }, "Strategy"), names),
    el("tr", el("th.text", { scope: "col" }, ""), parameters),
  );
}

function heatRow(name, blocks) {
  return el("tr", { "data-strategy": name },
    el("th.text", { scope: "row" }, name),
    blocks.flatMap(({ aCase, values, lines }) =>
      values.map((x, i) => {
        const line = lines.get(name);
        const point = line && line.points.find((p) => p.parameter === x);
        return heatCell(aCase, line, point, i === 0);
      }),
    ),
  );
}

function heatMap(target) {
  const blocks = compared.map((aCase) => heatColumns(aCase, target));
  const names = [...new Set(blocks.flatMap(({ lines }) => [...lines.keys()]))];
  return scrollingTable(
    "Efficiency of each strategy by parameter value",
    heatHead(blocks),
    el("tbody", names.map((name) => heatRow(name, blocks))),
    "data heat-map",
  );
}

// Strategies that are wrong somewhere inside a promise: [name, names of maps].
function wrongStrategies(target) {
  const wrong = new Map();
  for (const aCase of compared) {
    for (const line of seriesOf(aCase, target)) {
      if (line.points.some((p) => p.promised && !p.verdict.good)) {
        wrong.set(line.name, [...(wrong.get(line.name) || []), aCase.name]);
      }
    }
  }
  return [...wrong];
}

function survivalText(target) {
  const wrong = wrongStrategies(target);
  if (wrong.length === 0) {
    return "Every strategy is correct in the supported range of every map. ";
  }
  const most = 4;
  const texts = wrong
    .slice(0, most)
    .map(([name, names]) => `${name} (${names.join(", ")})`);
  const more = wrong.length > most ? ` and ${wrong.length - most} more` : "";
  return `Wrong results in a supported range: ${texts.join("; ")}${more}. `;
}

function strategiesSection(target) {
  if (compared.length === 0) return null;
  const baselines = [...new Set(compared.map((c) => c.baseline))];
  return section("strategies", "Strategies at extreme parameters",
    el("p.lead",
      survivalText(target),
      "Numbers are efficiencies, 1 / (variance × processor time), relative to ",
      el("b", baselines.join(", ")),
      ". Blue is more efficient, orange is less efficient; full colour is a factor of 10. Red " +
        "frame: wrong or refused. Dot: not measured. Point at a cell for details.",
    ),
    heatMap(target),
  );
}
