"use strict";
// Scales {from, to, log}: where values lie on them, ticks at round values, and their texts.

// The share of a scale that lies before x. What a logarithmic one cannot have is at its
// `zero`, if it has one.
function shareOn(scale, x) {
  if (scale.log && x <= 0) return scale.zero ?? -1;
  const f = scale.log ? Math.log : (v) => v;
  const share = (f(x) - f(scale.from)) / (f(scale.to) - f(scale.from));
  return Math.max(-1, Math.min(2, share));
}

function valueAt({ from, to, log }, share) {
  return log ? from * (to / from) ** share : from + share * (to - from);
}

// Around positive values with some room, in a ratio of at least two.
function logScale(values, room = 1.25) {
  const positive = values.filter((x) => known(x) && x > 0);
  if (positive.length === 0) return { from: 0.1, to: 10, log: true };
  const from = Math.min(...positive) / room,
    to = Math.max(...positive) * room;
  const middle = Math.sqrt(from * to);
  if (to / from >= 2) return { from, to, log: true };
  return { from: middle / Math.SQRT2, to: middle * Math.SQRT2, log: true };
}

// What drawPlot() takes for logarithmic axes. square: one range for both; include: values
// that y must hold. Bounds count only as far as a factor 8 below the value.
function logScales({ square, include = [] }) {
  return (lines) => {
    const points = lines.flatMap((line) => line.points);
    const bounds = (p) => [p.y, p.high, p.low && Math.max(p.low, p.y / 8)];
    const xs = points.map((p) => p.x),
      ys = [...points.flatMap(bounds), ...include];
    if (!square) return { x: logScale(xs, 1.35), y: logScale(ys) };
    const both = logScale([...xs, ...ys], 1.35);
    return { x: both, y: both };
  };
}

// Round values inside a scale: 1, 2, 5 times powers of ten, at most `most`.
function roundTicks(scale, most = 5) {
  const inside = (x) => x >= scale.from && x <= scale.to;
  if (!scale.log) {
    const step = niceStep((scale.to - scale.from) / most);
    const first = Math.ceil(scale.from / step);
    const count = Math.floor(scale.to / step) - first + 1;
    return Array.from({ length: Math.max(0, count) }, (_, i) => (first + i) * step);
  }
  for (const factors of [[1, 2, 5], [1, 3], [1]]) {
    const ticks = [];
    for (let e = exponentOf(scale.from); e <= exponentOf(scale.to); ++e) {
      ticks.push(...factors.map((f) => f * 10 ** e).filter(inside));
    }
    if (ticks.length <= most) return ticks;
  }
  const low = Math.ceil(Math.log10(scale.from)),
    high = Math.floor(Math.log10(scale.to));
  const step = Math.ceil((high - low + 1) / most);
  const length = Math.floor((high - low) / step) + 1;
  return Array.from({ length }, (_, i) => 10 ** (low + i * step));
}

// The same, evenly spaced within a short range, for an axis with room for `most` labels.
function decadeTicks(scale, most) {
  const short = scale.to / scale.from < 5;
  if (scale.log && !short) return roundTicks(scale, Math.max(2, most));
  return roundTicks({ ...scale, log: false }, Math.max(3, Math.min(6, most)));
}

// Ticks at powers of two: sample counts.
function binaryTicks(scale, most) {
  const low = Math.ceil(Math.log2(scale.from) - 1e-9),
    high = Math.floor(Math.log2(scale.to) + 1e-9);
  const step = Math.max(1, Math.ceil((high - low + 1) / Math.max(2, most)));
  const ticks = [];
  for (let e = low; e <= high; e += step) ticks.push(2 ** e);
  return ticks.length >= 2 ? ticks : decadeTicks(scale, most);
}

function errorTick(x) {
  const exponent = exponentOf(x);
  if (x >= 0.00099 && x < 1000) return String(Number(x.toPrecision(2)));
  const factor = Number((x / 10 ** exponent).toPrecision(2));
  return factor === 1 ? powerOfTen(exponent) : `${factor}×${powerOfTen(exponent)}`;
}

function secondsTick(x) {
  const [factor, name] = timeUnit(x * 1.0000001);
  return `${Number((x / factor).toPrecision(2))} ${name}`;
}
