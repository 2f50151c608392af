"use strict";
// Two images under one zoom: side by side, behind a slider, in turn, or their difference.

function imageChoices(view) {
  const choices = [];
  const add = (group, label, name) => {
    if (name) choices.push({ group, label, name, there: hasImage(name) });
  };
  add("", "Reference", view.scene.reference && view.scene.reference.image);
  for (const s of view.ranked) {
    const images = s.images || {};
    add(s.name, `${s.name}: one repetition`, images.one);
    add(s.name, `${s.name}: mean of all repetitions`, images.mean);
  }
  return choices;
}

// The state of a comparator, with everything derived from it.
function makeComparison(view, choices) {
  const there = choices.filter((choice) => choice.there);
  const reference = there[0];
  const first = there.find((choice) => choice !== reference && choice.group !== "") || reference;
  const sized = findImage(first.name);
  return {
    view, choices,
    names: { a: first.name, b: reference.name },
    mode: "side",
    split: 0.5,
    flipped: false,
    size: { width: sized.width, height: sized.height },
    place: { zoom: 1, x: sized.width / 2, y: sized.height / 2 },
    sources: new Map(),  // toned canvases, by image and role
    panes: [],
    changed: makeSignal(null),  // the part that changed
  };
}

function labelOf(comparison, slot) {
  const found = comparison.choices.find((c) => c.name === comparison.names[slot]);
  return found ? found.label : UNKNOWN;
}

// The toned image of slot "a" or "b", or "difference"; null where it cannot be had.
function comparisonSource(comparison, slot) {
  const a = findImage(comparison.names.a), b = findImage(comparison.names.b);
  const tone = comparison.view.tone.value;
  const key = slot === "difference" ? `${comparison.names.a}\n${comparison.names.b}`
                                    : comparison.names[slot];
  if (!comparison.sources.has(key)) {
    let pixels = null;
    if (slot === "difference") {
      if (a && b && a.width === b.width && a.height === b.height) {
        const range = 2 ** -tone.exposure;
        pixels = rampPixels(a.width, a.height, DIVERGING_TABLE,
                            (i) => 0.5 + 0.5 * relativeDifference(a, b, i) / range);
      }
    } else {
      const image = slot === "a" ? a : b;
      if (image) pixels = tonedPixels(image, tone);
    }
    comparison.sources.set(key, pixels && sourceCanvas(pixels));
  }
  return comparison.sources.get(key);
}

// Draws the visible part of source; clip: [from, to] as shares of the pane's width.
function paintPane(comparison, canvas, source, [from, to] = [0, 1]) {
  const context = canvas.getContext("2d");
  const scale = paneScale(canvas, comparison.size, comparison.place) * devicePixelRatio;
  context.save();
  context.beginPath();
  context.rect(from * canvas.width, 0, (to - from) * canvas.width, canvas.height);
  context.clip();
  if (source) {
    context.imageSmoothingEnabled = scale < 1;
    context.imageSmoothingQuality = "high";
    context.drawImage(source, canvas.width / 2 - comparison.place.x * scale,
                      canvas.height / 2 - comparison.place.y * scale,
                      source.width * scale, source.height * scale);
  } else {
    context.fillStyle = theme.color("--muted");
    context.font = `${14 * devicePixelRatio}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.fillText("This image is not in the report.", canvas.width / 2, canvas.height / 2);
  }
  context.restore();
}

function fitBacking(canvas) {
  const width = Math.round(canvas.clientWidth * devicePixelRatio);
  const height = Math.round(canvas.clientHeight * devicePixelRatio);
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  canvas.getContext("2d").clearRect(0, 0, width, height);
}

function paintAll(comparison) {
  comparison.panes.forEach(({ canvas, show }) => {
    if (canvas.clientWidth === 0) return;
    comparison.place = clampPlace(canvas, comparison.size, comparison.place);
    fitBacking(canvas);
    if (show === "split") {
      paintPane(comparison, canvas, comparisonSource(comparison, "a"), [0, comparison.split]);
      paintPane(comparison, canvas, comparisonSource(comparison, "b"), [comparison.split, 1]);
    } else {
      const slot = show === "flip" ? (comparison.flipped ? "b" : "a") : show;
      paintPane(comparison, canvas, comparisonSource(comparison, slot));
    }
  });
  if (comparison.box) comparison.box.dataset.zoom = comparison.place.zoom.toFixed(4);
}

const PANES = { side: ["a", "b"], slider: ["split"], flip: ["flip"],
                difference: ["difference"] };

function paneTitle(comparison, show) {
  const a = `A  ${labelOf(comparison, "a")}`, b = `B  ${labelOf(comparison, "b")}`;
  return { a, b, split: `${a}  |  ${b}`, flip: comparison.flipped ? b : a,
           difference: "(A − B) / √(B² + 0.01)" }[show];
}

// A pane: the canvas below a line that says what it shows.
function makePane(comparison, show, repaint, hover) {
  const { width, height } = comparison.size;
  const canvas = el("canvas", { class: "pane", tabindex: 0, "data-pane": show, role: "img",
                                style: { "aspect-ratio": `${width} / ${height}` } });
  const title = el("div", { class: "pane-title" });
  const retitle = () => {
    title.textContent = paneTitle(comparison, show);
    canvas.setAttribute("aria-label", `${title.textContent}. Arrow keys move, plus and ` +
                                      "minus zoom, 0 shows all.");
  };
  const flip = () => {
    comparison.flipped = !comparison.flipped;
    retitle();
    repaint();
  };
  bindPane(comparison.view, canvas, {
    size: () => comparison.size,
    place: () => comparison.place,
    move: (place) => {
      comparison.place = clampPlace(canvas, comparison.size, place);
      repaint();
    },
    hover,
    key: (name) => {
      if (show !== "flip" || (name !== " " && name !== "Enter")) return false;
      flip();
      return true;
    },
  });
  if (show === "flip") canvas.addEventListener("dblclick", flip);
  retitle();
  const frame = el("div", { class: "pane-frame" }, canvas,
                   show === "split" && splitHandle(comparison, canvas, repaint));
  // No higher than most of the window.
  const box = el("div", { class: "pane-box",
                          style: { "max-width": `calc(78vh * ${width / height})` } },
                 title, frame);
  return { canvas, show, retitle, flip, node: box };
}

// The divider, for pointer and keyboard.
function splitHandle(comparison, canvas, repaint) {
  const handle = el("div", { class: "split", role: "slider", tabindex: 0,
                             "aria-label": "Share of image A", "aria-valuemin": 0,
                             "aria-valuemax": 100 });
  const set = (share) => {
    comparison.split = Math.max(0, Math.min(1, share));
    handle.style.left = `${comparison.split * 100}%`;
    handle.setAttribute("aria-valuenow", Math.round(comparison.split * 100));
    repaint();
  };
  handle.addEventListener("pointerdown", (event) => handle.setPointerCapture(event.pointerId));
  handle.addEventListener("pointermove", (event) => {
    if (!handle.hasPointerCapture(event.pointerId)) return;
    const box = canvas.getBoundingClientRect();
    set((event.clientX - box.left) / box.width);
  });
  handle.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -0.02, ArrowRight: 0.02 }[event.key];
    if (!step) return;
    event.preventDefault();
    set(comparison.split + step);
  });
  set(comparison.split);
  return handle;
}

function comparatorSection(view) {
  const choices = imageChoices(view);
  const title = "Compare images";
  if (!choices.some((choice) => choice.there)) {
    return section("compare", title, missingPicture("This report holds no images of the scene."));
  }
  const comparison = makeComparison(view, choices);
  const stage = el("div", { class: "stage", "data-mode": comparison.mode });
  const readout = el("div", { class: "readout", "aria-live": "off" });
  const repaint = debounced(() => {
    paintAll(comparison);
    showZoom(comparison);
  });
  comparison.repaint = repaint;
  const hover = (point) => showPixel(comparison, readout, point);
  const rebuild = () => {
    comparison.panes = PANES[comparison.mode].map((show) =>
      makePane(comparison, show, repaint, hover));
    stage.dataset.mode = comparison.mode;
    stage.replaceChildren(...comparison.panes.map((pane) => pane.node));
    repaint();
  };
  comparison.box = el("div", { class: "comparator" },
    comparatorControls(comparison, rebuild), stage, readout);
  hover(null);
  rebuild();
  keepPainted(comparison, stage, repaint);
  return section("compare", title, comparison.box,
    el("p", { class: "hint" }, "Scroll or pinch to zoom, drag to move; with the keyboard, " +
       "arrows, + and −, 0 for all of it. Both images always show the same part."));
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
