"use strict";
// The magnified parts in the paper's figures.

// The window in which the errors of the images against the reference differ most, not
// counting the brightest part of single pixels; the same in all figures of the scene.
function insetWindow(images, reference) {
  const sized = images.filter((image) => sizesEqual(image, reference));
  if (sized.length === 0) return null;
  const { width, height } = reference;
  const side = Math.max(4, Math.round(Math.min(width, height) / 5));
  let best = { spread: -1 };
  for (let y = side >> 1; y + side * 1.5 <= height; y += side >> 1) {
    for (let x = side >> 1; x + side * 1.5 <= width; x += side >> 1) {
      const errors = sized.map((image) => windowError(image, reference, x, y, side));
      const spread = Math.max(...errors) - (errors.length > 1 ? Math.min(...errors) : 0);
      if (spread > best.spread) best = { spread, x, y };
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
