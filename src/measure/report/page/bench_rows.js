"use strict";
// Rates with their intervals, and efficiency against threads.

function rowName(row) {
  return targetNames.length > 1 ? `${row.scene}, ${row.target}` : row.scene;
}

// [{index, name, style, status, rows}]: a line for each scene and target, by threads.
function benchLines() {
  const lines = new Map();
  for (const row of study.rows) {
    const name = rowName(row);
    if (!lines.has(name)) lines.set(name, []);
    lines.get(name).push(row);
  }
  return [...lines].map(([name, rows], index) => ({
    index, name,
    status: "ok",
    style: strategyStyle(index),
    rows: [...rows].sort((a, b) => a.threads - b.threads),
  }));
}

function threadsText(n) {
  return n === 1 ? "1 thread" : `${n} threads`;
}

function rateRows(lines) {
  const rates = study.rows.map((row) => row.samples_per_second);
  const scale = whiskerScale(rates, true);
  const name = (line, { threads }) => `${line.name}, ${threadsText(threads)}`;
  return el("div.plot-figure",
    rateAxis(scale, "Samples per wall second", rateTick),
    lines.flatMap((line) =>
      line.rows.map((row) =>
        rateRow(line.style, name(line, row), row.samples_per_second, rateTexts, scale),
      ),
    ),
  );
}

function efficiencyPoints(line) {
  const points = line.rows.map((row) => {
    const interval = row.parallel_efficiency || { value: null };
    const { value: y, low, high } = interval;
    return { x: row.threads, y, low, high, interval };
  });
  return { ...line, bars: true, points: points.filter(({ y }) => known(y)) };
}

function efficiencyFigure(view, lines) {
  const { host, figure } = plotFigure("efficiency", "");
  whenVisible(view, figure, () =>
    logPlot(view, host, {
      lines: lines.map(efficiencyPoints),
      label: "Parallel efficiency against thread count",
      xAxis: { label: "threads", ticks: binaryTicks, format: fmtCount },
      yAxis: {
        label: "rate / (threads × rate of 1 thread)",
        ticks: decadeTicks,
        format: errorTick,
      },
      include: [0.5, 1],
      describe: (line, point) => noteOf(
        line.name,
        threadsText(point.x),
        `parallel efficiency ${joined(intervalTexts(point.interval))}`,
      ),
    }),
  );
  return figure;
}

// One bar for each line, of the row with the fewest threads: more threads hardly change how a
// sample's time is divided.
function groupBars(view) {
  const bars = view.ran.map((line) => {
    const stages = line.rows[0].groups.filter((group) => group.ns_per_sample > 0);
    const total = stages.reduce((sum, group) => sum + group.ns_per_sample, 0);
    return {
      line, name: line.name, total, text: `${fmt(total)} ns per sample, ${threadsText(line.rows[0].threads)}`,
      stages: stages.map(({ name, ns_per_sample: ns, lanes }) => ({
        name,
        share: ns / total,
        seconds: ns * 1e-9,
        occupancy: lanes,
      })),
    };
  });
  return costRows(view, bars, stageNames({ ranked: bars }));
}
