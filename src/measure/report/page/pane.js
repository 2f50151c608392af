"use strict";
// The comparator's panes: what they paint, and what they take from pointer and keys.

const MISSING_IMAGE = "This report does not contain the image.";

// Draws the visible part of source; clip: [from, to] as shares of the pane's width.
function paintPane(comparison, canvas, source, [from, to]) {
  const context = canvas.getContext("2d");
  const { size, place } = comparison;
  const scale = paneScale(boxOf(canvas), size, place) * devicePixelRatio;
  context.save();
  context.beginPath();
  context.rect(from * canvas.width, 0, (to - from) * canvas.width, canvas.height);
  context.clip();
  if (source) {
    context.imageSmoothingEnabled = scale < 1;
    context.imageSmoothingQuality = "high";
    const x = canvas.width / 2 - comparison.place.x * scale,
      y = canvas.height / 2 - comparison.place.y * scale;
    context.drawImage(source, x, y, source.width * scale, source.height * scale);
  } else {
    context.fillStyle = theme.color("--muted");
    context.font = `${14 * devicePixelRatio}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.fillText(MISSING_IMAGE, canvas.width / 2, canvas.height / 2);
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

// What is in a pane: [slot, from, to] as shares of its width.
function paneParts({ split, flipped }, show) {
  if (show === "split") return [["a", 0, split], ["b", split, 1]];
  return [[show === "flip" ? (flipped ? "b" : "a") : show, 0, 1]];
}

function paintAll(comparison) {
  for (const { canvas, show } of comparison.panes) {
    if (canvas.clientWidth === 0) continue;
    comparison.place = clampPlace(boxOf(canvas), comparison.size, comparison.place);
    fitBacking(canvas);
    for (const [slot, from, to] of paneParts(comparison, show)) {
      paintPane(comparison, canvas, comparisonSource(comparison, slot), [from, to]);
    }
  }
  if (comparison.box) comparison.box.dataset.zoom = comparison.place.zoom.toFixed(4);
}

const PANES = { side: ["a", "b"], slider: ["split"], flip: ["flip"], difference: ["difference"] };

function paneTitle(comparison, show) {
  const a = `A  ${labelOf(comparison, "a")}`,
    b = `B  ${labelOf(comparison, "b")}`;
  return {
    a, b,
    split: `${a}  |  ${b}`,
    flip: comparison.flipped ? b : a,
    difference: `${comparison.kind.title}, of ${a} and ${b}`,
  }[show];
}

// A pane: the canvas below a line that says what it shows.
function makePane(comparison, show, repaint, hover) {
  const { width, height } = comparison.size;
  const canvas = el("canvas.pane", {
    tabindex: 0, "data-pane": show, role: "img",
    style: { "aspect-ratio": `${width} / ${height}` },
  });
  const title = el("div.pane-title");
  const retitle = () => {
    title.textContent = paneTitle(comparison, show);
    const keys = "Arrow keys move, plus and minus zoom, 0 shows all.";
    canvas.setAttribute("aria-label", `${title.textContent}. ${keys}`);
  };
  const flip = () => {
    comparison.flipped = !comparison.flipped;
    retitle();
    repaint();
  };
  bindPane(canvas, {
    size: () => comparison.size,
    place: () => comparison.place,
    move: (place) => {
      comparison.place = clampPlace(boxOf(canvas), comparison.size, place);
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
  const frame = el("div.pane-frame",
    canvas,
    show === "split" && splitHandle(comparison, canvas, repaint),
  );
  // No higher than most of the window.
  const box = el("div.pane-box",
    { style: { "max-width": `calc(78vh * ${width / height})` } },
    title, frame,
  );
  return { canvas, show, retitle, flip, node: box };
}

// The divider, for pointer and keyboard.
function splitHandle(comparison, canvas, repaint) {
  const handle = el("div.split", {
    role: "slider", tabindex: 0, "aria-label": "Share of image A", "aria-valuemin": 0,
    "aria-valuemax": 100,
  });
  const set = (share) => {
    comparison.split = Math.max(0, Math.min(1, share));
    handle.style.left = `${comparison.split * 100}%`;
    handle.setAttribute("aria-valuenow", Math.round(comparison.split * 100));
    repaint();
  };
  const hold = (event) => handle.setPointerCapture(event.pointerId);
  handle.addEventListener("pointerdown", hold);
  handle.addEventListener("pointermove", (event) => {
    if (!handle.hasPointerCapture(event.pointerId)) return;
    const box = boxOf(canvas);
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
