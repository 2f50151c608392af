"use strict";
// Error against cost as both render, with intervals, in logarithmic axes.

const PLOT_SIZE = { width: 460, height: 260, left: 62, right: 10, top: 10, bottom: 40 };

function plotScales(points) {
  const { width, height, left, right, top, bottom } = PLOT_SIZE;
  const [x0, x1] = logRange(points.map((p) => p.x));
  const [y0, y1] = logRange(points.flatMap((p) => [p.y, p.low, p.high]));
  const share = (v, a, b) => Math.log(v / a) / Math.log(b / a);
  return {
    x: (v) => left + share(v, x0, x1) * (width - left - right),
    y: (v) => height - bottom - share(v, y0, y1) * (height - top - bottom),
    xTicks: decadeTicks(x0, x1, 6),
    yTicks: decadeTicks(y0, y1, 6),
  };
}

function plotFrame(scales, pace) {
  const { width, height, left, right, top, bottom } = PLOT_SIZE;
  const label = (x, y, anchor, text) =>
    svg("text.plot-label", { x, y, "text-anchor": anchor }, text);
  const tick = pace === "time" ? secondsTick : (x) => fmtShort(x);
  return [
    scales.xTicks.map((v) => [
      svg("line.plot-grid", {
        x1: scales.x(v), x2: scales.x(v), y1: top, y2: height - bottom,
      }),
      label(scales.x(v), height - bottom + 16, "middle", tick(v)),
    ]),
    scales.yTicks.map((v) => [
      svg("line.plot-grid", {
        x1: left, x2: width - right, y1: scales.y(v), y2: scales.y(v),
      }),
      label(left - 6, scales.y(v) + 4, "end", errorTick(v)),
    ]),
    label((left + width) / 2, height - 4, "middle",
      pace === "time" ? "processor time" : "samples per pixel"),
  ];
}

function plotCurve(scales, points, style) {
  const color = { stroke: `var(${style.variable})` };
  const whisker = (p) => {
    const low = known(p.low) && p.low > 0 ? p.low : p.y;
    const high = known(p.high) ? p.high : p.y;
    return svg("line.plot-whisker", {
      x1: scales.x(p.x), x2: scales.x(p.x), y1: scales.y(low), y2: scales.y(high),
      style: color,
    });
  };
  const path = points.map((p, i) => `${i ? "L" : "M"}${scales.x(p.x)} ${scales.y(p.y)}`);
  return [
    svg("path", {
      d: path.join(""), fill: "none", "stroke-width": 2,
      "stroke-dasharray": style.dash.join(" ") || null, style: color,
    }),
    points.map(whisker),
    points.map((p) =>
      svg("path", {
        d: markerPath(style.marker, scales.x(p.x), scales.y(p.y), 3),
        style: { ...color, fill: `var(${style.variable})` },
      })),
  ];
}

function drawErrorPlot(node, state) {
  const curves = state.slots.map((slot) =>
    (slot.looks || [])
      .filter((look) => look.relmse > 0)
      .map((look) => ({
        x: state.pace === "time" ? look.seconds : look.spp,
        y: look.relmse, low: look.low, high: look.high,
      })),
  );
  const points = curves.flat();
  node.hidden = points.length === 0;
  if (node.hidden) return;
  const scales = plotScales(points);
  const { width, height } = PLOT_SIZE;
  node.replaceChildren(
    svg("svg", {
        viewBox: `0 0 ${width} ${height}`, role: "img",
        "aria-label": "Relative mean squared error against cost",
      },
      plotFrame(scales, state.pace),
      curves.map((curve, i) => plotCurve(scales, curve, STYLES[i]))),
    el("p.note",
      "Relative MSE with 95 % intervals; a lower end alone where samples cannot tell the ",
      "upper one. In plain Monte Carlo it falls as 1 / cost."),
  );
}
