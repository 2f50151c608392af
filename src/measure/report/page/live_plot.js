"use strict";
// Error against cost as both render, with intervals, in logarithmic axes.

// Of an interval that is open, the end that is known.
function lookPoint(pace, { seconds, spp, relmse: y, low, high }) {
  return {
    x: pace === "time" ? seconds : spp, y,
    low: known(low) && low > 0 ? low : y, high: known(high) ? high : y,
  };
}

function drawErrorPlot(node, { slots, pace }) {
  const lines = slots.map((slot, index) => ({
    index, name: "AB"[index], style: STYLES[index], bars: true,
    points: (slot.looks || []).filter((l) => l.relmse > 0).map((l) => lookPoint(pace, l)),
  }));
  node.hidden = lines.every((line) => line.points.length === 0);
  if (node.hidden) return;
  const { node: drawing } = drawPlot({ width: 460, height: 280 }, {
    lines,
    label: "Relative MSE against cost",
    scales: logScales({}),
    xAxis: {
      label: pace === "time" ? "processor time" : "samples per pixel",
      ticks: decadeTicks,
      format: pace === "time" ? secondsTick : (x) => fmtShort(x),
    },
    yAxis: { label: "relative MSE", ticks: decadeTicks, format: errorTick },
  });
  node.replaceChildren(
    drawing,
    el("p.note",
      "Relative MSE with 95 % confidence intervals. A bar without an upper end means that the ",
      "samples are too few for an upper limit. For independent samples, the relative MSE falls as 1 / cost."),
  );
}
