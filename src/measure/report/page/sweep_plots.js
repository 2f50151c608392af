"use strict";
// Efficiency, throughput and error along the chosen axis, and error against time.

// power: of the slopes of errors against time.
const SWEEP_MEASURES = {
  efficiency: {
    label: "Efficiency",
    axis: `efficiency relative to ${study.baseline}`,
    texts: intervalTexts,
    tick: errorTick,
  },
  relmse: { label: "Relative MSE", power: 2, texts: intervalTexts, tick: errorTick },
  rmse: { label: "RMSE", power: 1, texts: intervalTexts, tick: errorTick },
  samples_per_second: { label: "Samples per second", texts: rateTexts, tick: rateTick },
  rays_per_second: { label: "Rays per second", texts: rateTexts, tick: rateTick },
};

// Those of which some group knows more than the baseline's 1.
function knownMeasures() {
  return Object.keys(SWEEP_MEASURES).filter((key) =>
    study.groups.some((group) => {
      const baseline = key === "efficiency" && group.strategy === study.baseline;
      return !baseline && known(intervalOf(group, key).value);
    }),
  );
}

function describeGroup(choice, measure, line, point) {
  const { label, texts } = SWEEP_MEASURES[measure];
  const seeds = point.group.cells.length;
  const seconds = intervalOf(point.group, "cpu_seconds").value;
  return noteOf(
    choice.lines ? line.name : point.name,
    choice.lines && choice.along && point.name,
    `${label} ${joined(texts(intervalOf(point.group, measure)))}`,
    `processor time ${fmtSeconds(seconds)}`,
    seeds > 1 ? `${seeds} seeds` : "one seed",
  );
}

function alongAxis(axis) {
  const counts = axis.name === "spp" || axis.name === "threads";
  const formats = { time: secondsTick, "target-relmse": errorTick, "target-rmse": errorTick };
  const format = axis.parameter ? errorTick : rateTick;
  return {
    label: axis.title,
    ticks: counts ? binaryTicks : decadeTicks,
    format: formats[axis.name] || format,
  };
}

const TIME_AXIS = { label: "processor time", ticks: decadeTicks, format: secondsTick };

// byTime: against processor time instead of the axis. include: of all panels.
function measurePlot(view, host, choice, lines, { measure, byTime, include }) {
  const { label, axis, power, tick } = SWEEP_MEASURES[measure];
  const xs = byTime
    ? (point) => [intervalOf(point.group, "cpu_seconds").value]
    : alongPositions(choice);
  const drawn = lines.map((line) => plotted(line, measure, xs));
  if (drawn.every((line) => line.points.length === 0)) {
    host.replaceChildren(el("p.hint", `${label} was not measured for this selection.`));
    return () => host.replaceChildren();
  }
  const xAxis = byTime ? TIME_AXIS : alongAxis(choice.along);
  return logPlot(view, host, {
    lines: drawn,
    label: `${label} against ${xAxis.label}`,
    xAxis,
    yAxis: { label: axis || label, ticks: decadeTicks, format: tick },
    include,
    guides: (frame) => byTime && power && slopeGuides(frame, power),
    describe: (line, point) => describeGroup(choice, measure, line, point),
  });
}

// Drops repeated rows of a line: a strategy that a grid names twice has two groups of the
// same cells. Keeps the later one. Each line of the legend keeps its own rows.
function distinctRows(rows) {
  const key = ({ line, point }) => `${line.index}:${point.group.cells.join()}`;
  return [...new Map(rows.map((row) => [key(row), row])).values()];
}

// Where the axis has no positions: a row with an interval for each value and line.
function measureRows(view, host, choice, lines, { measure, include }) {
  const { label, axis: name, texts, tick } = SWEEP_MEASURES[measure];
  const rows = distinctRows(
    lines.flatMap((line) =>
      line.points.map((point) => ({ line, point, y: intervalOf(point.group, measure) })),
    ),
  );
  const log = measure === "efficiency";
  const scale = whiskerScale([...rows.map(({ y }) => y), ...include], log, log ? [1] : [0]);
  const row = ({ line, point, y }) =>
    withTip(rateRow(line.style, point.name, y, texts, scale, log ? [1] : []), () =>
      describeGroup(choice, measure, line, point),
    );
  const axis = rateAxis(scale, capitalised(name || label), tick);
  const draw = () =>
    host.replaceChildren(
      axis,
      ...rows.filter(({ line }) => view.shown.value.has(line.index)).map(row),
    );
  const stop = view.shown.listen(draw);
  draw();
  return () => {
    stop();
    host.replaceChildren();
  };
}

// One figure for each panel; all show what is chosen. Returns the figures and show().
function panelFigures(view, choice, panels) {
  const figures = panels.map((panel, i) => {
    const { host, figure } = plotFigure(`panel-${i}`, panel.name || "");
    return { host, figure, lines: panel.lines, seen: false, end: () => {} };
  });
  let chosen = null;
  const draw = (it) => {
    it.end();
    const drawn = chosen.byTime || (choice.along && hasPositions(choice.along));
    it.end = (drawn ? measurePlot : measureRows)(view, it.host, choice, it.lines, chosen);
  };
  for (const it of figures) {
    whenVisible(view, it.figure, () => {
      it.seen = true;
      draw(it);
    });
  }
  const show = (measure, byTime) => {
    const groups = panels.flatMap((p) => p.lines.flatMap((l) => l.points.map((x) => x.group)));
    const shared = measure === "efficiency" ? groups.map((g) => intervalOf(g, measure)) : [];
    chosen = { measure, byTime, include: shared };
    if (byTime || (choice.along && hasPositions(choice.along))) {
      chosen.include = shared
        .flatMap(({ value, low, high }) => [value, high, low && Math.max(low, value / 8)])
        .filter(known);
    }
    figures.filter((it) => it.seen).forEach(draw);
  };
  return { figures: figures.map((it) => it.figure), show };
}

function intervalNote() {
  const few =
    study.seeds < 2
      ? "This sweep has one seed: use 2 or more for intervals of rates and 3 or more for " +
        "intervals of efficiencies. "
      : study.seeds < 3
        ? "Use 3 or more seeds for intervals of efficiencies. "
        : "";
  return (
    "Bars are 95 % confidence intervals over the seeds; with one seed, they are the error " +
    `estimates of the render. ${few}Efficiency is 1 / (error × processor time). It uses the ` +
    "error estimates of the renders, which do not include bias. Point at a marker for its " +
    "values, drag to zoom, double-click to reset the zoom."
  );
}

// What is shown survives a choice of other axes.
const shownMeasure = { measure: null, byTime: false };

function plotsSection(view, choice, panels, lines) {
  const keys = knownMeasures();
  if (!keys.includes(shownMeasure.measure)) shownMeasure.measure = keys[0];
  const { figures, show } = panelFigures(view, choice, panels);
  const update = (changes) => {
    Object.assign(shownMeasure, changes);
    show(shownMeasure.measure, shownMeasure.byTime);
  };
  const measures = keys.map((key) => [key, SWEEP_MEASURES[key].label]);
  const against = [
    ["along", choice.along ? `Against ${lowered(choice.along.title)}` : "By line"],
    ["time", "Against time"],
  ];
  update({});
  return [
    el("div.toolbar",
      choiceButtons("Measure", measures, shownMeasure.measure, (measure) =>
        update({ measure }),
      ),
      choiceButtons("Against", against, shownMeasure.byTime ? "time" : "along", (x) =>
        update({ byTime: x === "time" }),
      ),
    ),
    lines.length > 1 && strategyLegend(view, "Lines shown"),
    el("div", { class: panels.length > 2 ? "plots many" : "plots" }, figures),
    el("p.hint", intervalNote()),
  ];
}
