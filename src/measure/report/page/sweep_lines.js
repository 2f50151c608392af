"use strict";
// The chosen groups in lines: a line for each value of one axis, a point for each of
// another; a panel for each scene.

// [{name, lines}]; a single one where there is one scene, or scenes are lines.
function choicePanels(choice) {
  if (!choice.panels) {
    const scenes = axisNamed("scene").values;
    const name = scenes.length === 1 ? scenes[0] : null;
    return [{ name, lines: groupLines(choice, study.groups) }];
  }
  return axisValues(choice.panels)
    .map((name) => {
      const groups = study.groups.filter((g) => valueOn(g, choice.panels) === name);
      return { name, lines: groupLines(choice, groups) };
    })
    .filter((panel) => panel.lines.length > 0);
}

// [{index, name, value, style, points: [{value, name, group}]}]; no empty lines.
function groupLines(choice, groups) {
  const chosen = groups.filter((group) => isChosen(group, choice));
  const values = choice.lines ? axisValues(choice.lines) : [null];
  return values
    .map((value, index) => ({
      index, value,
      name: value === null ? allName(choice) : valueLabel(choice.lines, value),
      style: strategyStyle(index),
      status: "ok",
      points: chosen
        .filter((group) => value === null || valueOn(group, choice.lines) === value)
        .map((group) => linePoint(choice, group)),
    }))
    .filter((line) => line.points.length > 0);
}

function allName({ along }) {
  return along ? along.title : study.baseline || "all cells";
}

function linePoint({ along }, group) {
  const value = along ? valueOn(group, along) : null;
  const alone = along && along.parameter && value === UNSET; // depends on no part of it
  const name = alone ? group.strategy : along ? valueLabel(along, value) : "all";
  return { value, name, group };
}

// The lines of all panels, each once, for the legend.
function allLines(panels) {
  const lines = new Map();
  for (const line of panels.flatMap((panel) => panel.lines)) lines.set(line.index, line);
  return [...lines.values()].sort((a, b) => a.index - b.index);
}

// The points of a line in a plot against `xs` of each: null where a group has no place.
function plotted(line, measure, xs) {
  const points = line.points
    .flatMap((point) => {
      const interval = intervalOf(point.group, measure);
      const { value: y, low, high } = interval;
      return xs(point).map((x) => ({ ...point, x, y, low, high, interval }));
    })
    .filter(({ x, y }) => known(x) && x > 0 && known(y) && y > 0)
    .sort((a, b) => a.x - b.x);
  return { ...line, points, bars: true };
}

// Positions along the axis. What does not depend on it is level from end to end.
function alongPositions(choice) {
  const { along } = choice;
  const ends = study.groups.map((g) => positionOn(g, along)).filter(known);
  const level = [Math.min(...ends), Math.max(...ends)];
  return (point) =>
    along.parameter && point.value === UNSET ? level : [positionOn(point.group, along)];
}
