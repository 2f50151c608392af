"use strict";
// Logarithmic axes for uPlot: ranges that fit the data and ticks at round values.

// [min, max] around positive values with some room, in a ratio of at least two.
function logRange(values, room = 1.25) {
  const positive = values.filter((x) => known(x) && x > 0);
  if (positive.length === 0) return [0.1, 10];
  let low = Math.min(...positive) / room,
    high = Math.max(...positive) * room;
  const middle = Math.sqrt(low * high);
  if (high / low < 2) [low, high] = [middle / Math.SQRT2, middle * Math.SQRT2];
  return [low, high];
}

// Ticks at 1, 2, 5 times powers of ten where there is room, else at fewer; evenly spaced
// ones within a short range.
function decadeTicks(min, max, most) {
  if (max / min < 5) {
    return whiskerTicks(
      { from: min, to: max, log: false },
      Math.max(3, Math.min(6, most)),
    );
  }
  return whiskerTicks({ from: min, to: max, log: true }, Math.max(2, most));
}

// Ticks at powers of two: sample counts.
function binaryTicks(min, max, most) {
  const low = Math.ceil(Math.log2(min) - 1e-9),
    high = Math.floor(Math.log2(max) + 1e-9);
  const step = Math.max(1, Math.ceil((high - low + 1) / Math.max(2, most)));
  const ticks = [];
  for (let e = low; e <= high; e += step) ticks.push(2 ** e);
  return ticks.length >= 2 ? ticks : decadeTicks(min, max, most);
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

const AXIS_FONT =
  '12px system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

// One axis of uPlot. space: pixels that a label takes along the axis.
function logAxis({ label, ticks, format, space, size }) {
  return {
    label,
    size,
    labelSize: 24,
    labelGap: 2,
    gap: 5,
    font: AXIS_FONT,
    labelFont: AXIS_FONT,
    stroke: () => theme.color("--muted"),
    grid: { stroke: () => theme.color("--grid"), width: 1 },
    ticks: { stroke: () => theme.color("--grid"), width: 1, size: 5 },
    splits: (u, axis, min, max) => {
      const length = axis === 0 ? u.bbox.width : u.bbox.height;
      return ticks(min, max, Math.floor(length / devicePixelRatio / space));
    },
    filter: (u, splits) => splits,
    values: (u, splits) => splits.map(format),
  };
}
