"use strict";
// The magnified parts in the paper's figures.

// A window of the image in which the baseline (or whoever ran) errs most, not counting
// the brightest part of single pixels; the same in all figures of the scene.
function insetWindow(view) {
  const source = [view.baseline, ...view.ranked].find(
    (s) => s && s.images && hasImage(s.images.one),
  );
  const reference = findImage(view.scene.reference && view.scene.reference.image);
  if (!source) return null;
  const image = findImage(source.images.one);
  const side = Math.max(4, Math.round(Math.min(image.width, image.height) / 5));
  const same =
    reference && reference.width === image.width && reference.height === image.height;
  let best = { error: -1 };
  for (let y = side >> 1; y + side * 1.5 <= image.height; y += side >> 1) {
    for (let x = side >> 1; x + side * 1.5 <= image.width; x += side >> 1) {
      const error = same
        ? windowError(image, reference, x, y, side)
        : -Math.hypot(x + side / 2 - image.width / 2, y + side / 2 - image.height / 2);
      if (error > best.error || best.error === -1) best = { error, x, y };
    }
  }
  if (best.x === undefined) return null;
  return { x: best.x, y: best.y, width: side, height: side };
}

function windowError(image, reference, x0, y0, side) {
  let sum = 0;
  for (let y = y0; y < y0 + side; ++y) {
    for (let x = x0; x < x0 + side; ++x) {
      const error = relativeDifference(image, reference, y * image.width + x);
      if (Number.isFinite(error)) sum += Math.min(1, Math.abs(error));
    }
  }
  return sum;
}
