"use strict";
// What the plots show: the axis along a line, the axis that tells lines apart, a plot for
// each scene, and the values at which the other axes are held.

const AMOUNTS = ["spp", "time", "target-relmse", "target-rmse"];

function preferredAxis(names, taken) {
  const free = varyingAxes.filter((axis) => axis !== taken);
  const found = names.map((name) => free.find((axis) => axis.name === name));
  return found.find(Boolean) || free[0] || null;
}

// A numeric part of strategies first: whoever lists its values wants the best one.
function firstAlong() {
  const parameters = varyingAxes.filter((axis) => axis.parameter);
  const number = parameters.find(hasPositions);
  if (number) return number;
  const names = [...AMOUNTS, "resolution", "threads", "max-depth"];
  return preferredAxis([...names, ...parameters.map((axis) => axis.name)], null);
}

// {along, lines, panels: axes or null, fixed: Map from the other varying axes to a value}
function firstChoice() {
  const along = firstAlong();
  const choices = varyingAxes.filter((axis) => axis.parameter && !hasPositions(axis));
  const names = ["strategy", ...choices.map((axis) => axis.name), "build", "target"];
  const free = varyingAxes.filter((axis) => axis !== along && axis.name !== "scene");
  const lines = preferredAxis(names, along);
  return completed({ along, lines: free.length > 0 ? lines : null, fixed: new Map() });
}

// With a plot for each scene, and a value for every axis that is left.
function completed({ along, lines, fixed }) {
  const left = varyingAxes.filter((axis) => axis !== along && axis !== lines);
  const panels = left.find((axis) => axis.name === "scene") || null;
  return {
    along, lines, panels,
    fixed: new Map(
      left
        .filter((axis) => axis !== panels)
        .map((axis) => [axis, fixed.get(axis) || commonValue(axis, along)]),
    ),
  };
}

// Whether strategies have both open parts, so that one can be held while the other varies.
function occurTogether(a, b) {
  if (!a || !a.parameter || !b.parameter) return true;
  return study.groups.some((g) => valueOn(g, a) !== UNSET && valueOn(g, b) !== UNSET);
}

// The value with the most different values along the line that have a known error; the
// last of several, which has the most samples or threads.
function commonValue(axis, along) {
  if (!occurTogether(along, axis)) return UNSET;
  const values = axis.parameter ? axis.values : axisValues(axis);
  const counts = values.map((value) => {
    const found = study.groups.filter(
      (group) =>
        valueOn(group, axis) === value && known(intervalOf(group, "relmse").value),
    );
    return along ? new Set(found.map((g) => valueOn(g, along))).size : found.length;
  });
  const most = Math.max(...counts);
  return values[axis.numeric ? counts.lastIndexOf(most) : counts.indexOf(most)];
}

// Strategies without a part that is held at a value do not depend on it.
function isChosen(group, choice) {
  return [...choice.fixed].every(([axis, value]) => {
    const own = valueOn(group, axis);
    return own === value || (axis.parameter && own === UNSET);
  });
}

function axisMenu(name, label, choice, onChange) {
  const options = varyingAxes.map((axis) => [axis.name, axis.title]);
  const other = name === "along" ? "lines" : "along";
  if (name === "lines") options.push(["", "none"]);
  const value = choice[name] ? choice[name].name : "";
  return menu(label, { "data-menu": name }, options, value, (chosen) => {
    const axis = axisNamed(chosen);
    const next = { ...choice, [name]: axis };
    if (axis && next[other] === axis) next[other] = choice[name]; // they change places
    onChange(completed(next));
  });
}

function fixedMenu(axis, choice, onChange) {
  const options = axisValues(axis).map((value) => [value, valueLabel(axis, value)]);
  const chosen = choice.fixed.get(axis);
  return menu(axis.title, { "data-menu": axis.name }, options, chosen, (value) =>
    onChange({ ...choice, fixed: new Map(choice.fixed).set(axis, value) }),
  );
}

function choiceMenus(choice, onChange) {
  return el("div.menus", { role: "group", "aria-label": "Axes of the plots" },
    choice.along && axisMenu("along", "Horizontal axis", choice, onChange),
    varyingAxes.length > 1 && axisMenu("lines", "One line per", choice, onChange),
    [...choice.fixed.keys()]
      .filter((axis) => occurTogether(choice.along, axis))
      .map((axis) => fixedMenu(axis, choice, onChange)),
  );
}
