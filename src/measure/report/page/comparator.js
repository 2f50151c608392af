"use strict";
// Two images under one zoom: side by side, behind a slider, in turn, or their difference.

function imageChoices(view) {
  const choices = [];
  const add = (group, label, name) => {
    if (name) choices.push({ group, label, name, there: hasImage(name) });
  };
  add("", "Reference", view.scene.reference?.image);
  for (const s of view.ranked) {
    const images = s.images || {};
    add(s.name, `${s.name}: one repetition`, images.one);
    add(s.name, `${s.name}: mean of all repetitions`, images.mean);
  }
  return choices;
}

// The state of a comparator, with everything derived from it.
function makeComparison(view, choices, kinds) {
  const there = choices.filter((choice) => choice.there);
  const reference = there[0];
  const first =
    there.find((choice) => choice !== reference && choice.group !== "") || reference;
  const sized = findImage(first.name);
  return {
    view, choices,
    names: { a: first.name, b: reference.name },
    mode: "side",
    kinds, // of differences
    kind: kinds[0],
    scales: new Map(), // of differences, by kind and images
    split: 0.5,
    flipped: false,
    size: { width: sized.width, height: sized.height },
    place: { zoom: 1, x: sized.width / 2, y: sized.height / 2 },
    sources: new Map(), // toned canvases, by image and role
    panes: [],
    changed: makeSignal(null), // the part that changed
  };
}

function labelOf(comparison, slot) {
  const found = comparison.choices.find((c) => c.name === comparison.names[slot]);
  return found ? found.label : UNKNOWN;
}

// The toned image of slot "a" or "b", or "difference"; null where it cannot be had.
function comparisonSource(comparison, slot) {
  const tone = comparison.view.tone.value;
  const key =
    slot === "difference"
      ? `${comparison.kind.key}\n${comparison.names.a}\n${comparison.names.b}`
      : comparison.names[slot];
  if (!comparison.sources.has(key)) {
    const image = slot === "difference" ? null : findImage(comparison.names[slot]);
    const pixels =
      slot === "difference"
        ? differencePixels(comparison)
        : image && tonedPixels(image, tone);
    comparison.sources.set(key, pixels && sourceCanvas(pixels));
  }
  return comparison.sources.get(key);
}

// choices: [{group, label, name, there}]; kinds: of differences that it can show.
function comparatorSection(view, choices, kinds) {
  const title = "Compare images";
  if (!choices.some((choice) => choice.there)) {
    return section("compare", title,
      missingPicture("This report contains no images of the scene."),
    );
  }
  const comparison = makeComparison(view, choices, kinds);
  const stage = el("div.stage", { "data-mode": comparison.mode });
  const readout = el("div.readout", { "aria-live": "off" });
  const repaint = debounced(() => {
    paintAll(comparison);
    showZoom(comparison);
  });
  comparison.repaint = repaint;
  const hover = (point) => showPixel(comparison, readout, point);
  const rebuild = () => {
    comparison.panes = PANES[comparison.mode].map((show) =>
      makePane(comparison, show, repaint, hover),
    );
    stage.dataset.mode = comparison.mode;
    stage.replaceChildren(...comparison.panes.map((pane) => pane.node));
    repaint();
  };
  comparison.box = el("div.comparator",
    comparatorControls(comparison, rebuild),
    stage, readout,
  );
  hover(null);
  rebuild();
  keepPainted(comparison, stage, repaint);
  return section("compare", title,
    comparison.box,
    el("p.hint",
      "Scroll or pinch to zoom; drag to move. Keys: arrows move, " +
        "+ and − zoom, 0 shows the whole image. Both images show the same region.",
    ),
  );
}

function keepPainted(comparison, stage, repaint) {
  const { view } = comparison;
  const observer = new ResizeObserver(repaint);
  observer.observe(stage);
  view.signal.addEventListener("abort", () => observer.disconnect());
  view.tone.listen(() => {
    comparison.sources.clear();
    repaint();
  });
  document.addEventListener("themechange", repaint, { signal: view.signal });
}
