"use strict";
// Axes of the stability maps: logarithmic ones with a place for zero, and linear ones.

// Positions in [0, 1]. values: what must be inside; room: share that stays free.
function makeScale(values, logarithmic, room = 0.04) {
  const finite = values.filter(known);
  const usable = logarithmic ? finite.filter((x) => x > 0) : finite;
  const f = logarithmic ? Math.log10 : (x) => x;
  let low = usable.length > 0 ? Math.min(...usable.map(f)) : 0;
  let high = usable.length > 0 ? Math.max(...usable.map(f)) : 1;
  if (high - low < 1e-9) [low, high] = [low - 0.5, high + 0.5];
  // Zero and what is below has a place of its own, left of all others.
  if (logarithmic && finite.some((x) => x <= 0)) low -= 0.12 * (high - low);
  const pad = room * (high - low);
  [low, high] = [low - pad, high + pad];
  const g = logarithmic ? (x) => 10 ** x : (x) => x;
  return {
    log: logarithmic,
    from: g(low),
    to: g(high),
    at(x) {
      if (logarithmic && x <= 0) return pad / (high - low);
      return Math.max(-0.02, Math.min(1.02, (f(x) - low) / (high - low)));
    },
  };
}

function scaleTicks(scale, most) {
  if (scale.log && scale.to / scale.from < 5) {
    return whiskerTicks({ ...scale, log: false }, most);
  }
  return whiskerTicks(scale, most);
}

function parameterScale(aCase) {
  const { axis } = aCase;
  return makeScale(
    aCase.points.map((p) => p.parameter),
    axis.logarithmic,
  );
}

// The promised range as a share of the axis: [left, right].
function promisedShare(aCase, scale) {
  const { promised_low: low, promised_high: high } = aCase.axis;
  const at = (x, otherwise) =>
    known(x) ? Math.max(0, Math.min(1, scale.at(x))) : otherwise;
  return [at(low, 0), at(high, 1)];
}
