"use strict";
// The comparator's controls, its scale and its read-out.

function imageSelect(comparison, slot, onChange) {
  const select = el("select", { "data-slot": slot });
  const groups = new Map();
  for (const { group, label, name, there } of comparison.choices) {
    const option = el("option", { value: name, disabled: !there },
      there ? label : `${label} (missing)`,
    );
    if (group === "") {
      select.append(option);
      continue;
    }
    if (!groups.has(group)) {
      groups.set(group, el("optgroup", { label: group }));
      select.append(groups.get(group));
    }
    groups.get(group).append(option);
  }
  select.value = comparison.names[slot];
  select.addEventListener("change", () => {
    comparison.names[slot] = select.value;
    onChange();
  });
  return select;
}

function comparatorControls(comparison, rebuild) {
  const retitle = () => {
    comparison.panes.forEach((pane) => pane.retitle());
    comparison.repaint();
    comparison.changed.set("images");
  };
  const a = imageSelect(comparison, "a", retitle),
    b = imageSelect(comparison, "b", retitle);
  const swap = () => {
    [a.value, b.value] = [b.value, a.value];
    comparison.names = { a: a.value, b: b.value };
    retitle();
  };
  comparison.view.compare.listen((names) => {
    comparison.names = { a: names.a, b: names.b };
    [a.value, b.value] = [names.a, names.b];
    if (names.place) comparison.place = names.place;
    retitle();
  });
  const modes = [
    ["side", "Side by side"],
    ["slider", "Slider"],
    ["flip", "Flip"],
    ["difference", "Difference"],
  ];
  return el("div.controls",
    el("div.control-row",
      labelled("A", a),
      el("button.button",
        { onclick: swap, title: "Swap A and B", "aria-label": "Swap A and B" },
        "⇄",
      ),
      labelled("B", b),
    ),
    el("div.control-row",
      choiceButtons("Mode", modes, comparison.mode, (mode) => {
        comparison.mode = mode;
        rebuild();
        comparison.changed.set("mode");
      }),
      flipButton(comparison),
      differenceMenu(comparison, retitle),
      zoomButtons(comparison),
    ),
    appendAll(toneControls(comparison.view), [comparatorScale(comparison)]),
  );
}

// Which kind of difference is shown, where there are several.
function differenceMenu(comparison, retitle) {
  if (comparison.kinds.length < 2) return null;
  const choose = (key) => {
    comparison.kind = comparison.kinds.find((kind) => kind.key === key);
    retitle();
    comparison.changed.set("kind");
  };
  const options = comparison.kinds.map((kind) => [kind.key, kind.label]);
  const box = menu("Difference", { "data-control": "difference" }, options, comparison.kind.key, choose);
  box.hidden = true;
  comparison.changed.listen(() => {
    box.hidden = comparison.mode !== "difference";
  });
  return box;
}

function flipButton(comparison) {
  const button = el("button.button",
    { "data-flip": "", hidden: true, onclick: () => comparison.panes[0].flip() },
    "Show the other image",
  );
  comparison.changed.listen(() => {
    button.hidden = comparison.mode !== "flip";
  });
  return button;
}

function zoomButtons(comparison) {
  const move = (change) => {
    const pane = boxOf(comparison.panes[0].canvas);
    comparison.place = clampPlace(pane, comparison.size, {
      ...comparison.place,
      ...change(pane, comparison.place),
    });
    comparison.repaint();
  };
  const button = (text, label, change) =>
    el("button.button",
      { "aria-label": label, title: label, onclick: () => move(change) },
      text,
    );
  comparison.zoomText = el("output.zoom", { "aria-label": "Magnification" });
  return el("div.choices.zooms", { role: "group", "aria-label": "Zoom" },
    button("−", "Zoom out", (_, p) => ({ zoom: p.zoom / 1.5 })),
    button("+", "Zoom in", (_, p) => ({ zoom: p.zoom * 1.5 })),
    button("Fit", "Show the whole image", () => ({ zoom: 1 })),
    button("1:1", "One image pixel per screen pixel", (pane) => ({
      zoom: 1 / fitScale(pane, comparison.size),
    })),
    comparison.zoomText,
  );
}

function showZoom(comparison) {
  const pane = boxOf(comparison.panes[0].canvas);
  const percent = 100 * paneScale(pane, comparison.size, comparison.place);
  comparison.zoomText.textContent = `${Math.round(percent)} %`;
}

function toneControls({ tone }) {
  const set = (change) => tone.set({ ...tone.value, ...change });
  const exposure = slider("Exposure", {
    min: -8, max: 8, step: 0.1, value: 0, "data-control": "exposure", text: fmtExposure,
    onInput: (x) => set({ exposure: x }),
  });
  const reset = () => {
    exposure.set(0);
    set({ exposure: 0 });
  };
  return el("div.control-row",
    exposure.node,
    el("button.button", { onclick: reset }, "Reset"),
    menu("Tone", { "data-control": "tone" }, TONE_OPTIONS, tone.value.curve,
      (curve) => set({ curve })),
  );
}

function fmtExposure(stops) {
  return `${stops > 0 ? "+" : ""}${typographic(stops.toFixed(1))}`;
}
