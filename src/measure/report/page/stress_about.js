"use strict";
// Facts of a map and the menu that chooses another one.

function factList(aCase, target) {
  const breaks = nearestBreaks(aCase, target);
  const rows = [
    ["Parameter", aCase.extreme],
    ["Expected result", `${aCase.must} (${aCase.truth})`],
    ["Supported range", promiseText(aCase)],
    [
      "First failures",
      breaks.length > 0
        ? breaks.map((b) => breakText(aCase, b)).join("; ")
        : "none of the measured values",
    ],
    [
      "Smallest detectable error",
      known(aCase.detectable) ? fmtFound(aCase.detectable) : "none at some points",
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
