"use strict";
// Curves in a frame with axes, as SVG. Colours and strokes are in plots.css.
//
// options: {lines, xAxis, yAxis, label, scales(lines): {x, y} that hold them, ghosts: lines
// that are not shown stay, thin and grey; under(frame), guides(frame),
// over(frame, lines): what else is drawn}
// axis: {label, ticks(scale, most), format(value)}
// line: {index, name, style, bars, steps: it has no markers, points: [{x, y, low, high,
// hollow, bad, limit}]}, x ascending; limit: where a point would be bad.

function plotFrame({ width, height }, { x, y }) {
  const left = 80,
    right = width - 12,
    top = 10,
    bottom = height - 44;
  return {
    left, right, top, bottom,
    scales: { x, y },
    x: (v) => left + shareOn(x, v) * (right - left),
    y: (v) => bottom - shareOn(y, v) * (bottom - top),
  };
}

function plotAxes(frame, { xAxis, yAxis }) {
  const { left, right, top, bottom, scales } = frame;
  const text = (place, content) =>
    svg("text", { "text-anchor": "middle", ...place }, content);
  const across = (left + right) / 2,
    down = (top + bottom) / 2;
  return [
    xAxis.ticks(scales.x, Math.floor((right - left) / 62)).map((tick) => {
      const x = frame.x(tick);
      return [
        svg("line.grid", { x1: x, x2: x, y1: top, y2: bottom + 5 }),
        text({ x, y: bottom + 18 }, xAxis.format(tick)),
      ];
    }),
    yAxis.ticks(scales.y, Math.floor((bottom - top) / 34)).map((tick) => {
      const y = frame.y(tick);
      return [
        svg("line.grid", { x1: left - 5, x2: right, y1: y, y2: y }),
        text({ x: left - 8, y: y + 4, "text-anchor": "end" }, yAxis.format(tick)),
      ];
    }),
    text({ class: "axis-name", x: across, y: bottom + 38 }, xAxis.label),
    text({ class: "axis-name", transform: `translate(16 ${down}) rotate(-90)` },
      yAxis.label),
  ];
}

function pathOf(places) {
  return places
    .map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`)
    .join("");
}

// The area between the bounds, or bars where there is a single point or `line.bars`.
function curveBounds(frame, line) {
  const points = line.points.filter((p) => known(p.low) && known(p.high) && p.high > 0);
  const color = `var(${line.style.variable})`;
  if (line.steps) return null;
  if (line.bars || points.length === 1) {
    const bars = points.map((p) => [
      [frame.x(p.x), frame.y(p.low)],
      [frame.x(p.x), frame.y(p.high)],
    ]);
    return svg("path.bars", { d: bars.map(pathOf).join(""), style: { stroke: color } });
  }
  const corners = [
    ...points.map((p) => [frame.x(p.x), frame.y(p.high)]),
    ...points.reverse().map((p) => [frame.x(p.x), frame.y(p.low)]),
  ];
  return svg("path.band", { d: pathOf(corners), style: { fill: color } });
}

function plotCurve(frame, line) {
  const stroke = `var(${line.style.variable})`;
  const limits = line.points.filter((p) => known(p.limit));
  return svg("g", { "data-series": line.index },
    svg("path.limit", {
      d: pathOf(limits.map((p) => [frame.x(p.x), frame.y(p.limit)])), style: { stroke },
    }),
    curveBounds(frame, line),
    svg("path.curve", {
      d: pathOf(line.points.map((p) => [frame.x(p.x), frame.y(p.y)])),
      "stroke-dasharray": line.style.dash.join(" ") || null, style: { stroke },
    }),
    !line.steps && line.points.map((p) => [
      p.bad && svg("circle.bad", { cx: frame.x(p.x), cy: frame.y(p.y), r: 8 }),
      svg("path.marker", {
        d: markerPath(line.style.marker, frame.x(p.x), frame.y(p.y), 4),
        style: { stroke, fill: p.hollow ? "var(--panel)" : stroke },
        "data-series": line.name, "data-x": p.x, "data-y": p.y,
      }),
    ]),
  );
}

// {node, frame, lines}: a drawing of the lines that are shown. scales: other ones.
function drawPlot(size, options, lines = options.lines, scales = null) {
  const some = lines.some((line) => line.points.length > 0) ? lines : options.lines;
  const frame = plotFrame(size, scales || options.scales(some));
  const { left: x, top: y } = frame;
  const box = { x, y, width: frame.right - x, height: frame.bottom - y };
  const others = options.ghosts ? options.lines.filter((line) => !lines.includes(line)) : [];
  const node = svg("svg.curves",
    {
      ...size, viewBox: `0 0 ${size.width} ${size.height}`, role: "img",
      "aria-label": options.label, class: options.kind,
    },
    options.under && options.under(frame),
    plotAxes(frame, options),
    // An SVG within an SVG cuts off what is outside of it.
    svg("svg", { ...box, viewBox: Object.values(box).join(" ") },
      options.guides && options.guides(frame),
      others.map(({ points }) =>
        svg("path.ghost", { d: pathOf(points.map((p) => [frame.x(p.x), frame.y(p.y)])) }),
      ),
      lines.map((line) => plotCurve(frame, line)),
      options.over && options.over(frame, lines),
    ),
  );
  return { node, frame, lines };
}
