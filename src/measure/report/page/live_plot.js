"use strict";
// Error against cost as both render, with intervals, in logarithmic axes.

// Returns the relative RMSE with its interval, of an estimate of the relative MSE. Open ends
// stay null.
function rmseOf({ relmse, low, high }) {
  const root = (x) => (known(x) && x >= 0 ? Math.sqrt(x) : null);
  return { value: root(relmse), low: root(low), high: root(high) };
}

// Returns the point of an estimate, in per cent. An open end of its interval lies at the value.
function lookPoint(pace, estimate) {
  const { value, low, high } = rmseOf(estimate);
  return {
    x: pace === "time" ? estimate.seconds : estimate.spp, y: 100 * value,
    low: 100 * (low > 0 ? low : value), high: 100 * (high ?? value),
  };
}

const COST_AXES = {
  time: { title: "processor time", label: "processor time, sum over all threads (s)" },
  samples: { title: "samples per pixel", label: "samples per pixel" },
};

function drawErrorPlot(node, { slots, pace }) {
  const lines = slots.map((slot, index) => ({
    index, name: "AB"[index], style: STYLES[index], bars: true,
    points: (slot.looks || []).filter((l) => l.relmse > 0).map((l) => lookPoint(pace, l)),
  }));
  node.hidden = lines.every((line) => line.points.length === 0);
  if (node.hidden) return;
  const { title, label } = COST_AXES[pace];
  const width = Math.max(260, Math.min(560, node.clientWidth - 26));
  const { node: drawing } = drawPlot({ width, height: 280 }, {
    lines,
    label: `Relative RMSE against ${title}`,
    scales: logScales({}),
    xAxis: { label, ticks: decadeTicks, format: errorTick },
    yAxis: { label: "relative RMSE (%)", ticks: decadeTicks, format: errorTick },
  });
  const names = lines.filter((line) => line.points.length > 0);
  node.replaceChildren(
    el("figure.plot-figure",
      el("figcaption", el("span", `Error against ${title}`),
        el("span.live-plot-lines",
          names.map((line) => el("span", swatch(line.style), ` ${line.name}`)))),
      drawing),
    el("p.note",
      "Relative RMSE (√ of the relative MSE) with 95 % confidence intervals. A bar without an ",
      "upper end means that the samples are too few for an upper limit. For independent ",
      "samples, the relative RMSE falls as 1 / √cost."),
  );
}
