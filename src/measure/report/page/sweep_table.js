"use strict";
// All cells in a table.

const MOST_CELLS = 500;

function axisColumn(axis) {
  const number = ({ values }) => {
    const x = Number(values[axis.name]);
    return known(x) ? x : null;
  };
  const text = (cell) => valueOn(cell, axis);
  const sort = axis.numeric ? number : text;
  return textColumn(axis.name, axis.title, text, { text: !axis.numeric, sort });
}

function measuredColumn(key, title, unit, format) {
  return numberColumn(key, title, (cell) => cell.measured[key], format, { unit });
}

function errorColumn(key, title) {
  return intervalColumn(key, title, ({ measured }) => statedInterval(measured, key));
}

function statusCell(cell) {
  if (cell.status === "done") return "done";
  return el("span.why", [cell.status, cell.message].filter(Boolean).join(": "));
}

function cellColumns() {
  const varying = varyingAxes.length > 0 ? varyingAxes : study.axes;
  const own = study.axes.filter((axis) => !axis.parameter);
  const strategies = varying.some((axis) => axis.parameter || axis.name === "strategy");
  const shown = own.filter(
    (axis) => varying.includes(axis) || (strategies && axis.name === "strategy"),
  );
  const seed = { name: "seed", title: "Seed", numeric: true };
  return [
    ...[...shown, ...(study.seeds > 1 ? [seed] : [])].map(axisColumn),
    textColumn("status", "Status", statusCell, { sort: (c) => c.status }),
    errorColumn("relmse", "Relative MSE"),
    errorColumn("rmse", "RMSE"),
    measuredColumn("cpu_seconds", "Processor time", null, fmtSeconds),
    measuredColumn("render_seconds", "Wall time", null, fmtSeconds),
    measuredColumn("samples", "Samples", null, fmtCount),
    measuredColumn("samples_per_second", "Samples", "per second", rateTick),
    measuredColumn("rays_per_second", "Rays", "per second", rateTick),
  ];
}

function tableSection() {
  const cut = study.cells.length > MOST_CELLS;
  return section("cells", "All cells",
    el("p.lead",
      "sweep.csv contains all columns.",
      cut &&
        ` The table shows the first ${MOST_CELLS} of ${fmtCount(study.cells.length)} rows, in ` +
          "the chosen order.",
    ),
    sortableTable({
      columns: cellColumns(),
      rows: study.cells,
      caption: "All cells of the sweep",
      rowClass: (cell) => (cell.status === "done" ? null : "not-run"),
      most: MOST_CELLS,
    }),
  );
}
