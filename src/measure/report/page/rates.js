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
