"use strict";
// Error against time, and throughput and error along the chosen axis.

const ERRORS = {
  relmse: { label: "Relative MSE", power: 2 },
  rmse: { label: "RMSE", power: 1 },
};
const TIMES = { cpu_seconds: "processor time", render_seconds: "wall time" };
const RATES = {
  samples_per_second: "Samples per second",
  rays_per_second: "Rays per second",
};

const RATE_PREFIXES = [
  [1e9, "G"],
  [1e6, "M"],
  [1e3, "k"],
];

function rateTick(x) {
  if (!known(x)) return UNKNOWN;
  const [factor, prefix] = RATE_PREFIXES.find(([size]) => x >= size * 0.9999) || [1, ""];
  return `${Number((x / factor).toPrecision(3))}${prefix && ` ${prefix}`}`;
}

function describeCells(choice, line, point, rows) {
  return [
    el("b", {}, choice.lines ? line.name : point.name),
    choice.lines && choice.along && el("div", {}, point.name),
    rows.map(([name, text]) => el("div", {}, `${name} ${text}`)),
    point.cells.length > 1 && el("div", {}, `mean of ${point.cells.length} cells`),
  ];
}

function errorPlot(view, host, choice, lines, error, time) {
  const { label, power } = ERRORS[error];
  const seconds = (cells) => meanOf(cells, time);
  const drawn = lines.map((line) =>
    plotted(line, seconds, (cells) => meanInterval(cells, error)),
  );
  if (drawn.every((line) => line.points.length === 0)) {
    host.replaceChildren(el("p", { class: "hint" }, "No error of these cells is known."));
    return () => host.replaceChildren();
  }
  return logPlot(view, host, {
    lines: drawn,
    label: `${label} against ${TIMES[time]}`,
    xAxis: { label: TIMES[time], ticks: decadeTicks, format: secondsTick },
    yAxis: { label, ticks: decadeTicks, format: errorTick },
    guides: (u) => drawSlopes(u, power),
    describe: (line, point) =>
      describeCells(choice, line, point, [
        [label, joined(intervalTexts(point.interval))],
        [TIMES[time], fmtSeconds(point.x)],
      ]),
  });
}

function alongAxis(axis) {
  const counts = axis.name === "spp" || axis.name === "threads";
  return {
    label: axis.title,
    ticks: counts ? binaryTicks : decadeTicks,
    format:
      axis.name === "time"
        ? secondsTick
        : axis.name.startsWith("target-")
          ? errorTick
          : rateTick,
  };
}

function ratePlot(view, host, choice, lines, rate) {
  const position = (cells) => positionOn(cells[0], choice.along);
  const interval = (cells) => ({ value: meanOf(cells, rate) });
  return logPlot(view, host, {
    lines: lines.map((line) => plotted(line, position, interval)),
    label: `${RATES[rate]} along ${choice.along.title}`,
    xAxis: alongAxis(choice.along),
    yAxis: { label: RATES[rate], ticks: decadeTicks, format: rateTick },
    describe: (line, point) =>
      describeCells(choice, line, point, [[RATES[rate], rateTick(point.y)]]),
  });
}

// Where the axis has no positions: a bar for each value and line.
function rateBars(view, host, choice, lines, rate) {
  const rows = lines.flatMap((line) =>
    line.points.map((point) => ({ line, point, y: meanOf(point.cells, rate) })),
  );
  const most = Math.max(...rows.map(({ y }) => y));
  const draw = () =>
    host.replaceChildren(
      ...rows
        .filter(({ line }) => view.shown.value.has(line.index))
        .map(({ line, point, y }) =>
          el(
            "div",
            { class: "rate-row" },
            el("span", { class: "rate-name" }, swatch(line.style), point.name),
            el("span", {
              class: "rate-bar",
              style: {
                width: `${(y / most) * 100}%`,
                "background-color": `var(${line.style.variable})`,
              },
            }),
            el("span", { class: "rate-value" }, rateTick(y)),
          ),
        ),
    );
  view.shown.listen(draw);
  draw();
  return () => host.replaceChildren();
}

// A figure with buttons for what it shows; draw(host, chosen) returns what ends it.
function choosableFigure(view, name, title, options, draw) {
  const { host, figure } = plotFigure(name, title);
  let end = () => {};
  const show = (chosen) => {
    end();
    end = draw(host, chosen);
  };
  const entries = Object.entries(options).map(([key, text]) => [key, text.label || text]);
  figure
    .querySelector("figcaption")
    .append(choiceButtons(title, entries, entries[0][0], show));
  whenVisible(view, figure, () => show(entries[0][0]));
  return figure;
}

function plotsSection(view, choice, lines) {
  const error = choosableFigure(
    view,
    "error",
    "Error against time",
    ERRORS,
    (host, key) => errorPlot(view, host, choice, lines, key, "cpu_seconds"),
  );
  const drawRate = choice.along && hasPositions(choice.along) ? ratePlot : rateBars;
  const rate = choosableFigure(view, "rate", "Throughput", RATES, (host, key) =>
    drawRate(view, host, choice, lines, key),
  );
  return [
    lines.length > 1 && strategyLegend(view, "Lines shown"),
    el("div", { class: "plots" }, error, rate),
    el(
      "p",
      { class: "hint" },
      "Errors are the renders' own estimates, with 95 % intervals. Cells whose error is " +
        "not known (one sample per pixel, say) are left out of the left plot. Point at a " +
        "marker for its values, drag to zoom, double-click to see all again.",
    ),
  ];
}
