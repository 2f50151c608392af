"use strict";
// Samples and rays per second as people read them.

const RATE_PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"]];

function rateTick(x) {
  if (!known(x)) return UNKNOWN;
  const [factor, prefix] = RATE_PREFIXES.find(([size]) => x >= size * 0.9999) || [1, ""];
  return `${Number((x / factor).toPrecision(3))}${prefix && ` ${prefix}`}`;
}

function rateTexts(interval) {
  const bounds = hasBounds(interval)
    ? `[${rateTick(interval.low)}, ${rateTick(interval.high)}]`
    : "";
  return { value: rateTick(interval.value), bounds };
}

// A row with an interval on an axis; and the axis above such rows, with its name and unit.
function rateRow(style, name, interval, texts, scale, marks = []) {
  return el("div.rate-row",
    el("span.rate-name", swatch(style), name),
    whisker(interval, scale, { style, width: 180, marks }),
    el("span.rate-value", twoLines(texts(interval))),
  );
}

function rateAxis(scale, text, format) {
  const options = { width: 180, format, most: 4, ticks: decadeTicks };
  const axis = scale && whiskerAxis(scale, options);
  return el("div.rate-row.rate-axis", el("span.rate-name", text), axis);
}
