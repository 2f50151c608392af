"use strict";
// Error against processor seconds and against samples, with one legend for both.

const MEASURES = {
  relmse: { label: "Relative MSE", power: 2 },
  rmse: { label: "RMSE", power: 1 },
  relmse_trimmed: { label: "Relative MSE, trimmed", power: 2 },
};

// A line for each strategy, of the levels for which pointOf(level) knows a point.
function levelLines(view, pointOf) {
  return view.ran
    .map(({ index, name, style, levels }) => ({
      index, name, style,
      points: (levels || []).map(pointOf).filter(Boolean).sort((a, b) => a.x - b.x),
    }))
    .filter((line) => line.points.length > 0);
}

function curveLines(view, measure, xOf) {
  return levelLines(view, (level) => curvePoint(level, measure, xOf));
}

function curvePoint(level, measure, xOf) {
  const x = xOf(level),
    y = valueOf(level[measure]);
  if (!known(x) || x <= 0 || !known(y) || y <= 0) return null;
  const { low, high } = level[measure];
  return { x, y, low, high, level, hollow: Boolean(level.reference_limited) };
}

function describePoint(measure, line, { level }) {
  return noteOf(
    line.name,
    `${fmtCount(level.spp)} spp, ${fmtSeconds(valueOf(level.cpu_seconds))}`,
    `${MEASURES[measure].label} ${joined(intervalTexts(level[measure]))}`,
    level.reference_limited && "limited by the error of the reference",
  );
}

function curvePlot(view, host, measure, xAxis, xOf, more = {}) {
  const { label, power } = MEASURES[measure];
  return logPlot(view, host, {
    lines: curveLines(view, measure, xOf),
    label: `${label} against ${xAxis.label}, one line per strategy`,
    xAxis,
    yAxis: { label, ticks: decadeTicks, format: errorTick },
    ghosts: true,
    guides: (frame) => [
      slopeGuides(frame, power),
      measure === "relmse" && targetGuide(frame, view.scene.target_relmse),
    ],
    describe: (line, point) => describePoint(measure, line, point),
    ...more,
  });
}

function curvesSection(view) {
  const title = "Error against time and samples";
  if (curveLines(view, "relmse", (level) => level.spp).length === 0) {
    return section("curves", title, el("p", "No strategy has a measured error."));
  }
  const time = plotFigure("seconds", "Error against time");
  const samples = plotFigure("spp", "Error against samples");
  let plots = [];
  const draw = (measure) => {
    plots.forEach((end) => end());
    const seconds = {
      label: "processor time of one render",
      ticks: decadeTicks,
      format: secondsTick,
    };
    const counts = { label: "samples per pixel", ticks: binaryTicks, format: fmtCount };
    plots = [
      curvePlot(view, time.host, measure, seconds, (level) => valueOf(level.cpu_seconds)),
      curvePlot(view, samples.host, measure, counts, (level) => level.spp),
    ];
  };
  whenVisible(view, time.figure, () => draw("relmse"));
  const choices = Object.entries(MEASURES).map(([key, { label }]) => [key, label]);
  return section("curves", title,
    el("div.toolbar",
      choiceButtons("Measure", choices, "relmse", draw),
      showAllButtons(view),
    ),
    strategyLegend(view),
    el("div.plots", time.figure, samples.figure),
    el("p.hint",
      "Lower and further left is better. Bands are confidence " +
        "intervals; hollow markers are limited by the error of the reference. Point at a marker " +
        "for its values, drag to zoom, double-click to reset the zoom. Double-click a strategy " +
        "to show only that one; unselected strategies are thin grey lines.",
    ),
  );
}
