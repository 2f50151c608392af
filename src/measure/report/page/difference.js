"use strict";
// What sets two images apart, as a number for each pixel, and the scale of its colours.

// Signed difference relative to b, softened at black as the relative MSE is.
function relativeDifference(a, b, i) {
  const base = channelMean(b, i);
  return (channelMean(a, i) - base) / Math.sqrt(base * base + 0.01);
}

// A round number that most of |values| stay below, for a colour scale: one in fifty of
// the pixels of each image is looked at.
function scaleTop(images, valueAt) {
  const values = [];
  for (const image of images) {
    const count = image.width * image.height;
    const step = Math.max(1, Math.floor(count / 4000));
    for (let i = 0; i < count; i += step) {
      const x = Math.abs(valueAt(image, i));
      if (Number.isFinite(x)) values.push(x);
    }
  }
  values.sort((a, b) => a - b);
  const top = values[Math.floor(values.length * 0.98)] || 0;
  return top > 0 ? niceStep(top) : 1;
}

function sizesEqual(a, b) {
  return Boolean(a && b) && a.width === b.width && a.height === b.height;
}

// A kind of difference: {key, label, title, signed, percent, most, values(a, b)}; the last
// returns {width, height, at(i)} of two images, or null where it is not known. `most`: the
// end of its range, if it has one.
const SIGNED_DIFFERENCE = {
  key: "difference",
  label: "Signed relative difference",
  title: "(A − B) / √(B² + 0.01)",
  signed: true,
  percent: true,
  values: (a, b) =>
    sizesEqual(a, b)
      ? { width: a.width, height: a.height, at: (i) => relativeDifference(a, b, i) }
      : null,
};

function differenceValues(comparison) {
  const { a, b } = comparison.names;
  return comparison.kind.values(findImage(a), findImage(b));
}

// The end of the colour scale: what fits the images, changed by the exposure.
function differenceRange(comparison) {
  const { kind, names, scales } = comparison;
  const key = `${kind.key}\n${names.a}\n${names.b}`;
  if (!scales.has(key)) {
    const values = differenceValues(comparison);
    const top = values ? scaleTop([values], (_, i) => values.at(i)) : 1;
    scales.set(key, Math.min(top, kind.most || Infinity));
  }
  return scales.get(key) * 2 ** -comparison.view.tone.value.exposure;
}

function differencePixels(comparison) {
  const values = differenceValues(comparison);
  if (!values) return null;
  const { width, height, at } = values;
  const range = differenceRange(comparison);
  return comparison.kind.signed
    ? rampPixels(width, height, DIVERGING_TABLE, (i) => 0.5 + (0.5 * at(i)) / range)
    : rampPixels(width, height, SEQUENTIAL_TABLE, (i) => at(i) / range);
}

function differenceLegend(comparison) {
  const { kind } = comparison;
  const range = Number(differenceRange(comparison).toPrecision(2));
  const text = kind.percent ? fmtShortPercent(range) : fmtShort(range);
  return kind.signed
    ? rampLegend(DIVERGING_TABLE, [
        `${MINUS}${text}: A darker`,
        "0",
        `A brighter: +${text}`,
      ])
    : rampLegend(SEQUENTIAL_TABLE, ["0", kind.label, text]);
}
