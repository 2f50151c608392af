"use strict";
// Scales of the stability maps: logarithmic ones with a place for zero, and linear ones.

// values: what must be inside; room: share that stays free.
function makeScale(values, log, room = 0.04) {
  const finite = values.filter(known);
  const usable = log ? finite.filter((x) => x > 0) : finite;
  const f = log ? Math.log10 : (x) => x,
    back = log ? (x) => 10 ** x : (x) => x;
  let low = usable.length > 0 ? Math.min(...usable.map(f)) : 0;
  let high = usable.length > 0 ? Math.max(...usable.map(f)) : 1;
  if (high - low < 1e-9) [low, high] = [low - 0.5, high + 0.5];
  // Zero and what is below has a place of its own, left of all others.
  if (log && finite.some((x) => x <= 0)) low -= 0.12 * (high - low);
  const pad = room * (high - low);
  return { log, from: back(low - pad), to: back(high + pad), zero: room / (1 + 2 * room) };
}

function parameterScale({ axis, points }) {
  return makeScale(points.map((p) => p.parameter), axis.logarithmic);
}

// The promised range as a share of the axis: [left, right].
function promisedShare({ axis }, scale) {
  const at = (x, otherwise) =>
    known(x) ? Math.max(0, Math.min(1, shareOn(scale, x))) : otherwise;
  return [at(axis.promised_low, 0), at(axis.promised_high, 1)];
}
