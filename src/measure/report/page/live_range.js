"use strict";
// The range of an overlay's colours: percentiles of the pixels' values.

// Outliers beyond these percentiles have the colours of the ends.
const LOW_PERCENTILE = 5,
  HIGH_PERCENTILE = 95;
// Positive finite half floats have smaller bits than infinity, in the order of their values.
const INFINITE_HALF = 0x7c00;

function isCounted(bits) {
  return bits > 0 && bits < INFINITE_HALF;
}

// The values of a layer, and how many pixels have each. A picture updates some pixels only,
// so the values before are kept.
class LayerValues {
  constructor({ width, height }) {
    this.width = width;
    this.bits = new Uint16Array(width * height);
    this.counts = new Uint32Array(INFINITE_HALF);
  }

  clear() {
    this.bits.fill(0);
    this.counts.fill(0);
  }

  // values: half floats of the pixels of a rectangle, row by row.
  put(x, y, width, height, values) {
    const { bits, counts } = this;
    for (let row = 0, i = 0; row < height; ++row) {
      const first = (y + row) * this.width + x;
      for (let at = first; at < first + width; ++at, ++i) {
        if (isCounted(bits[at])) --counts[bits[at]];
        if (isCounted(values[i])) ++counts[values[i]];
        bits[at] = values[i];
      }
    }
  }
}

// Returns the percentiles [low, high] of all positive values of these LayerValues together;
// null where there are none.
function layerRange(layers) {
  const countOf = (bits) => layers.reduce((sum, { counts }) => sum + counts[bits], 0);
  let total = 0;
  for (let bits = 1; bits < INFINITE_HALF; ++bits) total += countOf(bits);
  if (total === 0) return null;
  const found = [];
  const ranks = [LOW_PERCENTILE, HIGH_PERCENTILE].map((p) => (p / 100) * total);
  for (let bits = 1, sum = 0; bits < INFINITE_HALF && found.length < 2; ++bits) {
    sum += countOf(bits);
    while (found.length < 2 && sum > 0 && sum >= ranks[found.length]) found.push(halfNumber(bits));
  }
  return found;
}

function halfNumber(bits) {
  const exponent = (bits >> 10) & 31,
    fraction = bits & 1023;
  return exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15);
}
