"use strict";
// The comparator's controls, its scale and its read-out.

function imageSelect(comparison, slot, onChange) {
  const select = el("select", { "data-slot": slot });
  const groups = new Map();
  for (const { group, label, name, there } of comparison.choices) {
    const option = el("option", { value: name, disabled: !there },
                      there ? label : `${label} (missing)`);
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

function labelled(text, control, extra) {
  return el("label", { class: "labelled" }, el("span", {}, text), control, extra);
}

function comparatorControls(comparison, rebuild) {
  const retitle = () => {
    comparison.panes.forEach((pane) => pane.retitle());
    comparison.repaint();
  };
  const a = imageSelect(comparison, "a", retitle), b = imageSelect(comparison, "b", retitle);
  const swap = () => {
    [a.value, b.value] = [b.value, a.value];
    comparison.names = { a: a.value, b: b.value };
    retitle();
  };
  comparison.view.compare.listen((names) => {
    comparison.names = { ...names };
    [a.value, b.value] = [names.a, names.b];
    retitle();
  });
  const modes = [["side", "Side by side"], ["slider", "Slider"], ["flip", "Flip"],
                 ["difference", "Difference"]];
  return el("div", { class: "controls" },
    el("div", { class: "control-row" }, labelled("A", a),
       el("button", { type: "button", class: "button", onclick: swap, title: "Swap A and B",
                      "aria-label": "Swap A and B" }, "⇄"),
       labelled("B", b)),
    el("div", { class: "control-row" },
      choiceButtons("Mode", modes, comparison.mode, (mode) => {
        comparison.mode = mode;
        rebuild();
        comparison.changed.set("mode");
      }),
      flipButton(comparison), zoomButtons(comparison)),
    appendAll(toneControls(comparison.view), [comparatorScale(comparison)]));
}

function flipButton(comparison) {
  const button = el("button", { type: "button", class: "button", "data-flip": "", hidden: true,
                                onclick: () => comparison.panes[0].flip() }, "Show the other");
  comparison.changed.listen(() => { button.hidden = comparison.mode !== "flip"; });
  return button;
}

function zoomButtons(comparison) {
  const move = (change) => {
    const pane = comparison.panes[0].canvas;
    comparison.place = clampPlace(pane, comparison.size,
                                  { ...comparison.place, ...change(pane, comparison.place) });
    comparison.repaint();
  };
  const button = (text, label, change) =>
    el("button", { type: "button", class: "button", "aria-label": label, title: label,
                   onclick: () => move(change) }, text);
  comparison.zoomText = el("output", { class: "zoom", "aria-label": "Magnification" });
  return el("div", { class: "choices zooms", role: "group", "aria-label": "Zoom" },
    button("−", "Zoom out", (_, p) => ({ zoom: p.zoom / 1.5 })),
    button("+", "Zoom in", (_, p) => ({ zoom: p.zoom * 1.5 })),
    button("Fit", "Show all of it", () => ({ zoom: 1 })),
    button("1:1", "One pixel for a pixel",
           (pane) => ({ zoom: 1 / fitScale(pane, comparison.size) })),
    comparison.zoomText);
}

function showZoom(comparison) {
  const pane = comparison.panes[0].canvas;
  const percent = 100 * paneScale(pane, comparison.size, comparison.place);
  comparison.zoomText.textContent = `${Math.round(percent)} %`;
}

function toneControls(view) {
  const { tone } = view;
  const slider = el("input", { type: "range", min: -8, max: 8, step: 0.1, value: 0,
                               "data-control": "exposure" });
  const text = el("output", { class: "exposure" }, "0.0");
  const set = (change) => {
    tone.set({ ...tone.value, ...change });
    slider.value = tone.value.exposure;
    text.textContent = fmtExposure(tone.value.exposure);
  };
  slider.addEventListener("input", () => set({ exposure: Number(slider.value) }));
  const select = el("select", { "data-control": "tone" },
    Object.entries(TONE_CURVES).map(([key, { label }]) => el("option", { value: key }, label)));
  select.addEventListener("change", () => set({ curve: select.value }));
  return el("div", { class: "control-row" }, labelled("Exposure", slider, text),
    el("button", { type: "button", class: "button", onclick: () => set({ exposure: 0 }) }, "Reset"),
    labelled("Tone", select));
}

function fmtExposure(stops) {
  return `${stops > 0 ? "+" : ""}${typographic(stops.toFixed(1))}`;
}

// The legend of what the panes' colours mean, when they are not the scene's own.
function comparatorScale(comparison) {
  const box = el("div", { class: "scale-box" });
  const update = () => {
    const { curve, exposure } = comparison.view.tone.value;
    box.replaceChildren();
    if (comparison.mode === "difference") {
      const range = fmtShortPercent(Number((2 ** -exposure).toPrecision(2)));
      box.append(rampLegend(DIVERGING_TABLE, [`${MINUS}${range}: A darker`, "0",
                                              `A brighter: +${range}`]));
    } else if (curve === "false") {
      const at = (stops) => fmtShort(2 ** (stops - exposure), 2);
      box.append(rampLegend(SEQUENTIAL_TABLE, [at(-FALSE_STOPS), `${at(0)} luminance`,
                                               at(FALSE_STOPS)]));
    }
  };
  comparison.changed.listen(update);
  comparison.view.tone.listen(update);
  return box;
}

function pixelText(image, x, y) {
  if (!image || x >= image.width || y >= image.height) return UNKNOWN;
  const i = y * image.width + x;
  return [0, 1, 2].map((c) => {
    const value = channelAt(image, i, c);
    return Number.isNaN(value) ? "not a number" : fmt(value, 3);
  }).join("  ");
}

function showPixel(comparison, readout, point) {
  const { width, height } = comparison.size;
  const x = point ? Math.floor(point.x) : -1, y = point ? Math.floor(point.y) : -1;
  const cells = [["Pixel", UNKNOWN], ["A", UNKNOWN], ["B", UNKNOWN], ["(A − B) / B", UNKNOWN]];
  if (x >= 0 && y >= 0 && x < width && y < height) {
    const a = findImage(comparison.names.a), b = findImage(comparison.names.b);
    cells[0][1] = `${x}, ${y}`;
    cells[1][1] = pixelText(a, x, y);
    cells[2][1] = pixelText(b, x, y);
    if (a && b && a.width === b.width && a.height === b.height) {
      cells[3][1] = fmtSignedPercent(relativeDifference(a, b, y * width + x));
    }
  }
  readout.replaceChildren(...cells.map(([name, text]) =>
    el("span", {}, el("b", {}, name), ` ${text}`)));
}
