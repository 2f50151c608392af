"use strict";
// What stands around the plots of a map: what it is about, its curves, the way to others.

// Lets one curve stand out, in all plots; null: none.
function focusCurve(index) {
  for (const plot of document.querySelectorAll(".map-plot")) {
    plot.classList.toggle("focused", index !== null);
    for (const node of plot.querySelectorAll("g[data-series]")) {
      node.classList.toggle("focus", Number(node.dataset.series) === index);
    }
  }
}

function legendItem(line, shown, onChange) {
  const button = el("button.button.legend-item",
    { "aria-pressed": String(shown.has(line.index)), onclick: () => {
        if (!shown.delete(line.index)) shown.add(line.index);
        button.setAttribute("aria-pressed", String(shown.has(line.index)));
        onChange();
      }, onpointerenter: () => focusCurve(line.index), onpointerleave: () => focusCurve(null), onfocus: () => focusCurve(line.index), onblur: () => focusCurve(null) },
    strategyLabel(line),
  );
  return button;
}

// Shows all curves, or none, where there are many.
function legendAll(text, lines, shown, onChange) {
  return el("button.link",
    { onclick: (event) => {
        shown.clear();
        if (text === "All") lines.forEach((line) => shown.add(line.index));
        const items = event.target.parentNode.querySelectorAll(".legend-item");
        for (const item of items) item.setAttribute("aria-pressed", text === "All");
        onChange();
      } },
    text,
  );
}

function seriesLegend(lines, shown, onChange) {
  if (lines.length < 2) return null;
  return el("div.legend", { role: "group", "aria-label": "Curves shown" },
    lines.length > MOST_BANDS && [
      legendAll("All", lines, shown, onChange),
      legendAll("None", lines, shown, onChange),
    ],
    lines.map((line) => legendItem(line, shown, onChange)),
  );
}

function factList(aCase, target) {
  const breaks = nearestBreaks(aCase, target);
  const rows = [
    ["Extreme", aCase.extreme],
    ["Must be true", `${aCase.must} (${aCase.truth})`],
    ["Promised", promiseText(aCase)],
    [
      "First breaks",
      breaks.length > 0
        ? breaks.map((b) => breakText(aCase, b)).join("; ")
        : "nowhere that was measured",
    ],
    [
      "Finds errors from",
      known(aCase.detectable) ? fmtFound(aCase.detectable) : "some points find none",
    ],
    aCase.not_measured > 0 && [
      "Not measured",
      `${aCase.not_measured} of ${aCase.points.length} points: ` +
        aCase.points.find((p) => p.not_measured).not_measured,
    ],
    aCase.source && ["Source", aCase.source],
  ].filter(Boolean);
  return el("dl.about",
    rows.map(([name, text]) => el("div", el("dt", name), el("dd", text))),
  );
}

function mapMenu(aCase, onChoose) {
  const at = maps.indexOf(aCase);
  const step = (by, label, text) =>
    el("button.button",
      {
        "aria-label": label,
        onclick: () => onChoose(maps[(at + by + maps.length) % maps.length].name),
      },
      text,
    );
  const select = el("select",
    { "data-menu": "map", "aria-label": "Map", onchange: () => onChoose(select.value) },
    maps.map((m) => el("option", { value: m.name, selected: m === aCase }, m.name)),
  );
  return el("div.map-menu",
    step(-1, "Previous map", "←"),
    select,
    step(1, "Next map", "→"),
  );
}
