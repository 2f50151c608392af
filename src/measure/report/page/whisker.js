"use strict";
// Dots with whiskers: an estimate and its interval on an axis.

// Position of x in [0, width], held inside.
function whiskerX(scale, x, width) {
  return Math.max(0, Math.min(1, shareOn(scale, x))) * width;
}

// A scale that holds all intervals and `include`, with some room.
function whiskerScale(intervals, log, include = []) {
  const values = [...include];
  for (const interval of intervals) {
    for (const x of [
      valueOf(interval),
      interval && interval.low,
      interval && interval.high,
    ]) {
      if (known(x) && (!log || x > 0)) values.push(x);
    }
  }
  if (values.length === 0) return null;
  const low = Math.min(...values),
    high = Math.max(...values);
  if (log) return { from: low / 1.25, to: high * 1.25, log };
  const room = 0.06 * (high - low || 1);
  return { from: low - room, to: high + room, log };
}

// The drawing of one interval. marks: values with a vertical line.
function whisker(
  interval, scale,
  { style, width = 150, height = 26, marks = [], label },
) {
  const x = valueOf(interval);
  if (x === null || !scale || (scale.log && x <= 0)) return el("span", UNKNOWN);
  const color = style ? `var(${style.variable})` : "var(--text)";
  const y = height / 2,
    pad = 6;
  const at = (v) => pad + whiskerX(scale, v, width - 2 * pad);
  const low = scale.log && interval.low <= 0 ? scale.from : interval.low;
  return svg("svg.whisker",
    {
      width, height, viewBox: `0 0 ${width} ${height}`, role: "img",
      "aria-label": label || joined(intervalTexts(interval)),
    },
    marks.map((mark) =>
      svg("line.mark", { x1: at(mark), x2: at(mark), y1: 0, y2: height }),
    ),
    hasBounds(interval) && [
      svg("line", {
        x1: at(low), x2: at(interval.high), y1: y, y2: y, "stroke-width": 2,
        style: { stroke: color },
      }),
      [low, interval.high].map((v) =>
        svg("line", {
          x1: at(v), x2: at(v), y1: y - 4, y2: y + 4, "stroke-width": 2,
          style: { stroke: color },
        }),
      ),
    ],
    svg("path", {
      d: markerPath(style ? style.marker : "circle", at(x), y, 4.2), "stroke-width": 2,
      style: { stroke: color, fill: color },
    }),
  );
}

// The axis above or below a column of whiskers.
function whiskerAxis(
  scale, { width = 150, format = fmtShort, most = 5, ticks = roundTicks },
) {
  const pad = 6;
  const at = (v) => pad + whiskerX(scale, v, width - 2 * pad);
  return svg("svg.whisker-axis",
    { width, height: 22, viewBox: `0 0 ${width} 22`, "aria-hidden": "true" },
    svg("line", { x1: pad, x2: width - pad, y1: 20.5, y2: 20.5 }),
    ticks(scale, most).map((tick) => [
      svg("line", { x1: at(tick), x2: at(tick), y1: 16, y2: 21 }),
      svg("text",
        {
          x: Math.max(10, Math.min(width - 10, at(tick))), y: 12, "text-anchor": "middle",
        },
        format(tick),
      ),
    ]),
  );
}
