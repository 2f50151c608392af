"use strict";
// What a plot shows, as a file for a paper: SVG, PNG and CSV, with title, legend and source,
// always in light colours. `lanelight plot` draws the same numbers without a browser.

const DRAWING = { width: 960, height: 540, left: 76, right: 640, top: 56, bottom: 456 };

// As much of a canvas's context as guides and bands use; it appends to an SVG element.
function svgContext(parent) {
  const n = (x) => Number((x / devicePixelRatio).toFixed(2));
  let path = "",
    transform = "",
    dash = null;
  const step = (command) => (x, y) => {
    path += `${path === "" ? "M" : command}${n(x)} ${n(y)}`;
  };
  const draw = (attributes) =>
    parent.append(svg("path", { d: path, opacity: ctx.globalAlpha, ...attributes }));
  const ctx = {
    globalAlpha: 1,
    beginPath: () => (path = ""),
    moveTo: (x, y) => (path += `M${n(x)} ${n(y)}`),
    lineTo: step("L"),
    setLineDash: (pattern) => (dash = pattern.map(n).join(" ") || null),
    stroke: () =>
      draw({
        fill: "none",
        stroke: ctx.strokeStyle,
        "stroke-width": n(ctx.lineWidth),
        "stroke-dasharray": dash,
      }),
    fill: () => draw({ fill: ctx.fillStyle }),
    save: () => {},
    restore: () => (transform = ""),
    translate: (x, y) => (transform += `translate(${n(x)} ${n(y)})`),
    rotate: (angle) => (transform += `rotate(${(angle * 180) / Math.PI})`),
    fillText: (text, x, y) =>
      parent.append(
        svg("text", {
            x: n(x), y: n(y), fill: ctx.fillStyle, "font-size": 11,
            "text-anchor": ctx.textAlign === "right" ? "end" : "start",
            transform: transform || null,
          }, text),
      ),
  };
  return ctx;
}

// What guides and bands take for uPlot: the same ranges, on the paper.
function paperPlot(u, parent) {
  const { left, right, top, bottom } = DRAWING;
  const scaled = (x) => x * devicePixelRatio;
  const share = ({ min, max }, v) => Math.log(v / min) / Math.log(max / min);
  return {
    ctx: svgContext(parent),
    scales: u.scales,
    bbox: { left: scaled(left), top: scaled(top), width: scaled(right - left),
            height: scaled(bottom - top) },
    valToPos: (v, axis) =>
      scaled(
        axis === "x"
          ? left + share(u.scales.x, v) * (right - left)
          : bottom - share(u.scales.y, v) * (bottom - top),
      ),
  };
}

function paperAxes(u, { xAxis, yAxis }) {
  const { left, right, top, bottom } = DRAWING;
  const at = (v, axis) => paper.valToPos(v, axis) / devicePixelRatio;
  const paper = paperPlot(u, svg("g"));
  const grid = { stroke: theme.color("--grid") },
    muted = theme.color("--muted");
  const { x, y } = u.scales;
  return [
    xAxis.ticks(x.min, x.max, 9).map((tick) => [
      svg("line", { x1: at(tick, "x"), x2: at(tick, "x"), y1: top, y2: bottom, ...grid }),
      paperText(at(tick, "x"), bottom + 18, xAxis.format(tick),
                { "text-anchor": "middle", fill: muted }),
    ]),
    yAxis.ticks(y.min, y.max, 11).map((tick) => [
      svg("line", { x1: left, x2: right, y1: at(tick, "y"), y2: at(tick, "y"), ...grid }),
      paperText(left - 8, at(tick, "y") + 4, yAxis.format(tick),
                { "text-anchor": "end", fill: muted }),
    ]),
    paperText((left + right) / 2, bottom + 40, xAxis.label, { "text-anchor": "middle" }),
    paperText(0, 0, yAxis.label, {
      "text-anchor": "middle",
      transform: `translate(18 ${(top + bottom) / 2}) rotate(-90)`,
    }),
  ];
}

function paperCurves(u, lines) {
  const { left, right, top, bottom } = DRAWING;
  const box = { x: left, y: top, width: right - left, height: bottom - top };
  const clip = svg("svg", { ...box, viewBox: Object.values(box).join(" ") }); // cuts
  const paper = paperPlot(u, clip);
  const at = (p) => [paper.valToPos(p.x, "x"), paper.valToPos(p.y, "y")]
    .map((v) => v / devicePixelRatio);
  lines.forEach((line) => drawBand(paper, line, 1));
  for (const line of lines) {
    const stroke = theme.color(line.style.variable);
    clip.append(svg("path", {
      d: line.points.map((p, i) => `${i ? "L" : "M"}${at(p).join(" ")}`).join(""),
      fill: "none", stroke, "stroke-width": 2,
      "stroke-dasharray": line.style.dash.join(" ") || null,
    }));
    for (const p of line.points) {
      clip.append(svg("path.point", {
        d: markerPath(line.style.marker, ...at(p), 4),
        fill: p.hollow ? "#ffffff" : stroke, stroke, "data-series": line.name,
        "data-x": p.x, "data-y": p.y,
      }));
    }
  }
  return clip;
}

// The names, and beside them the intervals that the plot has for its lines, if any.
function paperLegend(lines, beside) {
  const { right, top, bottom } = DRAWING;
  const pitch = Math.min(24, (bottom - top) / Math.max(1, lines.length));
  const placed = (node, x, y) => {
    setAttributes(node, { x, y });
    return node;
  };
  const place = (i) => top + pitch * (i + 0.5);
  const scale = beside && whiskerScale(lines.map((l) => beside.of(l)), false, beside.marks);
  return [
    lines.map((line, i) => [
      placed(swatch(line.style), right + 16, place(i) - 6),
      paperText(right + 56, place(i) + 4, shortName(line.name)),
      scale && placed(
        whisker(beside.of(line), scale, { ...beside, style: line.style, width: 130 }),
        right + 180, place(i) - 13),
    ]),
    scale && placed(whiskerAxis(scale, { width: 130, most: 3 }), right + 180, top - 26),
  ];
}

function plotSvgText({ view, options, u }, title) {
  return inLight(() => {
    const lines = shownLines(view, options.lines);
    const guides = svg("g");
    if (options.guides) options.guides(paperPlot(u, guides));
    return paperSvg(DRAWING, title, [
      paperAxes(u, options),
      guides,
      paperCurves(u, lines),
      paperLegend(lines, options.beside),
    ]);
  });
}

function plotCsvText({ view, options }) {
  const lines = shownLines(view, options.lines);
  const { beside } = options;
  return csvText([
    ...lines.flatMap(({ name, points }) => points.map(({ x, y, low, high }) =>
      [name, options.yAxis.label, y, low, high, x, options.xAxis.label])),
    ...(beside ? lines : []).map((line) => {
      const { value, low, high } = beside.of(line) || {};
      return [line.name, beside.label, value, low, high, "", ""];
    }),
  ]);
}

// Buttons for the plot that logPlot() has drawn into host; hidden while it has drawn none.
function exportButtons(host, title) {
  return saveButtons(host, title, {
    svg: (title) => plotSvgText(host.drawn, title),
    csv: () => plotCsvText(host.drawn),
  });
}
