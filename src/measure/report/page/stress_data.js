"use strict";
// The cases of a run: their curves, and what of a point is drawn.

const maps = study.cases.filter((c) => c.points.some((p) => known(p.parameter)));
const targets = study.settings.targets;

const WORDS = {
  good: "good",
  weak: "weak",
  failed: "failed",
  unfinished: "not finished",
};

function hasNumber(point) {
  const { refused, crash, not_measured: left } = point;
  return refused === "" && crash === "" && left === "" && known(point.measured);
}

// {value, noise, limit}: the error as it is plotted; a point fails above `limit`.
function errorOf(point) {
  const unit = point.scale > 0 ? point.scale : 1;
  const { allowance } = point.verdict;
  const noise = known(allowance) ? (allowance - point.tolerance) / unit : 0;
  const value = Math.abs(point.measured - point.expected) / unit;
  return { value, noise, limit: known(allowance) ? allowance / unit : null };
}

// Where the points of a target lie: [{index, name, style, points}], by parameter.
function seriesOf(aCase, target) {
  const mine = aCase.points.filter((p) => p.target === target && known(p.parameter));
  const names = [...new Set(aCase.points.map((p) => p.series))];
  const named = names.length > 1 ? names.filter((name) => name !== "") : names;
  return named.map((name, index) => ({
    index,
    name: name || "all",
    style: strategyStyle(index),
    // A refusal of all curves has no name.
    points: mine
      .filter((p) => p.series === name || p.series === "")
      .sort((a, b) => a.parameter - b.parameter),
  }));
}

function breaksOf(aCase, target) {
  return aCase.breaks.filter((b) => b.target === target && known(b.parameter));
}

// Where a target fails inside of the promise, in the form of a break.
function failuresInside(aCase, target) {
  return aCase.points
    .filter((p) => p.target === target && p.promised && !p.verdict.good)
    .filter((p) => known(p.parameter))
    .sort((a, b) => a.parameter - b.parameter)
    .map((p) => ({ ...p.verdict, target, parameter: p.parameter, inside: true }));
}

// The break nearest to the promise below and above, and the first inside: at most three.
function nearestBreaks(aCase, target) {
  const found = breaksOf(aCase, target);
  const below = found.filter((b) => !b.above).sort((a, b) => b.parameter - a.parameter);
  const above = found.filter((b) => b.above).sort((a, b) => a.parameter - b.parameter);
  return [failuresInside(aCase, target)[0], below[0], above[0]].filter(Boolean);
}

// The same among all targets, for the table.
function firstBreaks(aCase) {
  const all = targets.flatMap((target) => nearestBreaks(aCase, target));
  const side = (above) =>
    all
      .filter((b) => !b.inside && b.above === above)
      .sort((a, b) => (above ? 1 : -1) * (a.parameter - b.parameter))[0];
  return [side(false), side(true)].filter(Boolean);
}

// A value of the axis without its unit.
function parameterTick(x) {
  if (x === 0) return "0";
  const y = Math.abs(x);
  const plain = y >= 1e-3 && y < 1e4;
  const size = plain ? String(Number(y.toPrecision(5))) : errorTick(y);
  return x < 0 ? MINUS + size : size;
}

function fmtParameter(aCase, x) {
  const { unit } = aCase.axis;
  return unit ? `${parameterTick(x)} ${unit}` : parameterTick(x);
}

function breakText(aCase, place) {
  const what =
    place.fault === "refused" || place.fault === "crashed" ? place.fault : place.why;
  const where = place.inside ? "inside the supported range, " : "";
  return `${where}${fmtParameter(aCase, place.parameter)}: ${what}`;
}

function promiseText(aCase) {
  const { promised_low: low, promised_high: high } = aCase.axis;
  if (known(low) && known(high)) {
    return `${fmtParameter(aCase, low)} to ${fmtParameter(aCase, high)}`;
  }
  if (known(low)) return `${fmtParameter(aCase, low)} and above`;
  return known(high) ? `up to ${fmtParameter(aCase, high)}` : "all values";
}

// Errors that are found, relative: percent where that reads well.
function fmtFound(x) {
  if (!known(x)) return UNKNOWN;
  if (x === 0) return "any";
  if (x > 10) return `${fmt(x, 2)} ×`;
  return x < 1e-3 ? fmt(x, 2) : fmtPercent(x, 2);
}

function sumPoints(aCase, key) {
  return aCase.points.reduce((sum, point) => sum + (point[key] || 0), 0);
}
