"use strict";
// Canvases that show pixels: whole pictures, crops, and legends of colour ramps.

function sourceCanvas(pixels) {
  const canvas = document.createElement("canvas");
  canvas.width = pixels.width;
  canvas.height = pixels.height;
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  return canvas;
}

// A picture that fills its place's width. size: {width, height}; makePixels() returns
// ImageData; crop: {x, y, width, height} in pixels; frame: the same, outlined; overlay(context,
// ratio) draws over it.
function picture(view, label, size, makePixels, { crop, frame, overlay, redrawOn } = {}) {
  const { x, y, width, height } = crop || { x: 0, y: 0, ...size };
  const canvas = el("canvas.picture", {
    role: "img", "aria-label": label, width, height,
    style: { "aspect-ratio": `${width} / ${height}` },
  });
  if (crop) canvas.classList.add("crop");
  const draw = () => {
    const source = sourceCanvas(makePixels());
    const box = canvas.getBoundingClientRect();
    const ratio = Math.max(1, (box.width * devicePixelRatio) / width);
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.imageSmoothingEnabled = false;
    context.drawImage(source, x, y, width, height, 0, 0, canvas.width, canvas.height);
    if (frame) strokeFrame(context, frame, ratio);
    if (overlay) overlay(context, canvas.width / width);
  };
  whenVisible(view, canvas, () => {
    draw();
    if (redrawOn) redrawOn.listen(debounced(draw));
  });
  return canvas;
}

// Of an image as the reader wants to see it.
function tonedPicture(view, image, label, options) {
  const pixels = () => tonedPixels(image, view.tone.value);
  return picture(view, label, image, pixels, { redrawOn: view.tone, ...options });
}

// White within black, so that it shows on anything.
function strokeFrame(context, { x, y, width, height }, ratio) {
  const unit = Math.min(devicePixelRatio, (width * ratio) / 14);
  for (const [color, line] of [["#000", 4 * unit], ["#fff", 2 * unit]]) {
    context.strokeStyle = color;
    context.lineWidth = line;
    context.strokeRect(x * ratio, y * ratio, width * ratio, height * ratio);
  }
}

// Runs at most once for each frame of the screen.
function debounced(run) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      run();
    });
  };
}

function missingPicture(text) {
  return el("div.missing", { role: "img", "aria-label": text }, text);
}

// A colour ramp with texts below its two ends and its middle.
function rampLegend(table, [low, middle, high]) {
  const canvas = el("canvas.ramp", { width: 256, height: 1, "aria-hidden": "true" });
  const pixels = new ImageData(256, 1);
  for (let i = 0; i < 256; ++i) putRamp(pixels.data, 4 * i, table, i / 255);
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  return el("div.ramp-legend",
    canvas,
    el("div.ramp-texts", [low, middle, high].map((t) => el("span", t))),
  );
}
