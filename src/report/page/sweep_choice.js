"use strict";
// What the plots show: the axis along a line, the axis that tells lines apart, and what
// becomes of the others.

const MEAN = "mean";

function preferredAxis(names, taken) {
  const free = varyingAxes.filter((axis) => axis !== taken);
  const found = names.map((name) => free.find((axis) => axis.name === name));
  return found.find(Boolean) || free[0] || null;
}

// {along, lines: axes or null, fixed: Map from the other varying axes to a value or MEAN}
function firstChoice() {
  const amounts = [
    "spp",
    "time",
    "target-relmse",
    "target-rmse",
    "resolution",
    "threads",
  ];
  const along = preferredAxis([...amounts, "max-depth"], null);
  const lines = preferredAxis(["strategy", "scene", "build", "target"], along);
  return completed({ along, lines, fixed: new Map() });
}

// With a value for every axis that is neither along nor lines.
function completed({ along, lines, fixed }) {
  const others = varyingAxes.filter((axis) => axis !== along && axis !== lines);
  return {
    along,
    lines,
    fixed: new Map(
      others.map((axis) => [
        axis,
        fixed.get(axis) || (axis.name === "seed" ? MEAN : commonValue(axis, along)),
      ]),
    ),
  };
}

// The value with the most different values along the line that have a known error; the
// last of several, which has the most samples or threads.
function commonValue(axis, along) {
  const counts = axisValues(axis).map((value) => {
    const cells = doneCells.filter(
      (cell) => valueOn(cell, axis) === value && known(cell.measured.relmse),
    );
    return along ? new Set(cells.map((cell) => valueOn(cell, along))).size : cells.length;
  });
  const most = Math.max(...counts);
  return axisValues(axis)[axis.numeric ? counts.lastIndexOf(most) : counts.indexOf(most)];
}

function isChosen(cell, choice) {
  for (const [axis, value] of choice.fixed) {
    if (value !== MEAN && valueOn(cell, axis) !== value) return false;
  }
  return true;
}

function axisMenu(name, label, choice, onChange) {
  const options = varyingAxes.map((axis) => [axis.name, axis.title]);
  const other = name === "along" ? "lines" : "along";
  return menu(label, { "data-menu": name }, options, choice[name].name, (value) => {
    const axis = varyingAxes.find((candidate) => candidate.name === value);
    const next = { ...choice, [name]: axis };
    if (next[other] === axis) next[other] = choice[name]; // they change places
    onChange(completed(next));
  });
}

function fixedMenu(axis, choice, onChange) {
  const values = axisValues(axis).map((value) => [value, valueLabel(axis, value)]);
  const options = [...values, [MEAN, "mean of all"]];
  const chosen = choice.fixed.get(axis);
  return menu(axis.title, { "data-menu": axis.name }, options, chosen, (value) => {
    const fixed = new Map(choice.fixed).set(axis, value);
    onChange({ ...choice, fixed });
  });
}

function choiceMenus(choice, onChange) {
  return el(
    "div",
    { class: "menus", role: "group", "aria-label": "Axes of the plots" },
    choice.along && axisMenu("along", "Along a line", choice, onChange),
    choice.lines && axisMenu("lines", "A line for each", choice, onChange),
    [...choice.fixed.keys()].map((axis) => fixedMenu(axis, choice, onChange)),
  );
}
