"use strict";
// The cells of a sweep and the axes of its grid.

const UNSET = "not set";

// Values of an axis in the order of the grid, as texts.
function axisValues(axis) {
  return axis.unset ? [...axis.values, UNSET] : axis.values;
}

function valueOn(cell, axis) {
  const value = cell.values[axis.name];
  return value === undefined ? UNSET : value;
}

const doneCells = study.cells.filter((cell) => cell.status === "done");
const varyingAxes = study.axes.filter((axis) => axisValues(axis).length > 1);

// Where a cell stands on a logarithmic axis; null where that means nothing.
function positionOn(cell, axis) {
  const { measured } = cell;
  let x = Number(valueOn(cell, axis));
  if (axis.name === "resolution") x = measured.width_pixels * measured.height_pixels;
  if (axis.name === "threads") x = measured.used_threads;
  return known(x) && x > 0 ? x : null;
}

function hasPositions(axis) {
  return axis.numeric || axis.name === "resolution";
}

// A value as a legend or a menu says it.
function valueLabel(axis, value) {
  if (value === UNSET) return value;
  if (axis.name === "threads" && value === "0") return "all cores";
  if (axis.name === "threads" && value === "1") return "1 thread";
  const units = { spp: " spp", time: " s", threads: " threads", resolution: " pixels" };
  return `${value}${units[axis.name] || ""}`;
}

// Means over cells that differ only in what the reader averages over. Bounds are means of
// bounds: wider than those of the mean.
function meanOf(cells, name) {
  const values = cells.map((cell) => cell.measured[name]);
  if (values.length === 0 || !values.every(known)) return null;
  return values.reduce((sum, x) => sum + x, 0) / values.length;
}

function meanInterval(cells, name) {
  return {
    value: meanOf(cells, name),
    low: meanOf(cells, `${name}_low`),
    high: meanOf(cells, `${name}_high`),
  };
}
