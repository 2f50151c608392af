"use strict";
// The chosen cells in lines: a line for each value of one axis, a point for each of another.

// [{index, name, value, style, points: [{value, name, cells}]}]; empty lines are left out.
function cellLines(choice) {
  const chosen = doneCells.filter((cell) => isChosen(cell, choice));
  const values = choice.lines ? axisValues(choice.lines) : [null];
  return values
    .map((value, index) => {
      const cells = chosen.filter(
        (cell) => value === null || valueOn(cell, choice.lines) === value,
      );
      return {
        index,
        value,
        name: value === null ? "all cells" : valueLabel(choice.lines, value),
        style: strategyStyle(index),
        status: "ok",
        points: linePoints(choice, cells),
      };
    })
    .filter((line) => line.points.length > 0);
}

function linePoints(choice, cells) {
  if (!choice.along) return cells.length > 0 ? [{ name: "all cells", cells }] : [];
  return axisValues(choice.along)
    .map((value) => ({
      value,
      name: valueLabel(choice.along, value),
      cells: cells.filter((cell) => valueOn(cell, choice.along) === value),
    }))
    .filter((point) => point.cells.length > 0);
}

// The points of a line in a plot: x and y of functions of a point's cells.
function plotted(line, xOf, intervalOf) {
  const points = line.points
    .map((point) => {
      const interval = intervalOf(point.cells);
      const { value: y, low, high } = interval;
      return { ...point, x: xOf(point.cells), y, low, high, interval };
    })
    .filter(({ x, y }) => known(x) && x > 0 && known(y) && y > 0)
    .sort((a, b) => a.x - b.x);
  return { ...line, points };
}
