"use strict";
// The groups of a sweep (cells that differ in their seed only) and the axes of its grid.

const UNSET = "not set";

// Calls set(cell, key, value) for the known values of columns.
function unpack(columns, cells, set) {
  for (const [key, { at, texts }] of Object.entries(columns)) {
    at.forEach((x, i) => {
      if (x !== null) set(cells[i], key, texts ? texts[x] : x);
    });
  }
}

function unpackedCells({ names, own, ...parts }) {
  const cells = names.map((name) => (
    { name, message: null, values: {}, measured: {}, stages: [] }));
  unpack(own, cells, (cell, key, x) => { cell[key] = x; });
  for (const [part, columns] of Object.entries(parts)) {
    unpack(columns, cells, (cell, key, x) => { cell[part][key] = x; });
  }
  return cells;
}

study.cells = unpackedCells(study.packed);

// Values of an axis in the order of the grid, as texts.
function axisValues(axis) {
  return axis.unset ? [...axis.values, UNSET] : axis.values;
}

// Of a cell or a group.
function valueOn({ values }, axis) {
  const value = values[axis.name];
  return value === undefined ? UNSET : value;
}

const doneCells = study.cells.filter((cell) => cell.status === "done");
const varyingAxes = study.axes.filter((axis) => axisValues(axis).length > 1);

function axisNamed(name) {
  return study.axes.find((axis) => axis.name === name) || null;
}

function cellsOf(group) {
  return group.cells.map((i) => study.cells[i]);
}

// A mean over the seeds with its interval; of a single cell its value, with the render's
// own interval where it has stated one.
function intervalOf(group, name) {
  if (name === "efficiency") return group.efficiency || { value: null };
  if (group.measured) return group.measured[name] || { value: null };
  return statedInterval(study.cells[group.cells[0]].measured, name);
}

function statedInterval(measured, name) {
  return {
    value: measured[name], low: measured[`${name}_low`], high: measured[`${name}_high`],
  };
}

// Where a group stands on a logarithmic axis; null where that means nothing.
function positionOn(group, axis) {
  const { measured } = study.cells[group.cells[0]];
  let x = Number(valueOn(group, axis));
  if (axis.name === "resolution") x = measured.width_pixels * measured.height_pixels;
  if (axis.name === "threads") x = measured.used_threads;
  return known(x) && x > 0 ? x : null;
}

function hasPositions(axis) {
  if (axis.name === "resolution" || axis.name === "threads") return true;
  return axis.numeric && axis.values.every((value) => Number(value) > 0);
}

// A value as a legend or a menu says it.
function valueLabel(axis, value) {
  if (value === UNSET) return value;
  if (axis.name === "threads" && value === "0") return "all cores";
  if (axis.name === "threads" && value === "1") return "1 thread";
  const units = { spp: " spp", time: " s", threads: " threads", resolution: " pixels" };
  return `${value}${units[axis.name] || ""}`;
}
