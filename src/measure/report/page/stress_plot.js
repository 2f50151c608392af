"use strict";
// A plot of curves against the parameter of a map, as SVG: the promised range shaded,
// breaks marked, every point with a note.

// With more curves, bands and limits are those of the one that the legend points at.
const MOST_BANDS = 4;

const BOX = { left: 58, right: 12, top: 10, bottom: 40 };

function plotFrame(width, height) {
  return {
    width,
    height,
    x: (share) => BOX.left + share * (width - BOX.left - BOX.right),
    y: (share) => height - BOX.bottom - share * (height - BOX.top - BOX.bottom),
  };
}

function gridLines(frame, scale, yTick) {
  return scaleTicks(scale, 6).map((tick) => {
    const y = frame.y(scale.at(tick));
    return [
      svg("line.grid", { x1: frame.x(0), x2: frame.x(1), y1: y, y2: y }),
      svg("text", { x: BOX.left - 6, y: y + 4, "text-anchor": "end" }, yTick(tick)),
    ];
  });
}

function xTicks(frame, aCase, scale) {
  const most = Math.max(3, Math.floor(frame.width / 75));
  const bottom = frame.y(0);
  const { name, unit } = aCase.axis;
  const zero = aCase.points.some((p) => p.parameter === 0) && scale.log ? [0] : [];
  return [
    [...zero, ...scaleTicks(scale, most)].map((tick) => {
      const x = frame.x(scale.at(tick));
      return [
        svg("line.grid", { x1: x, x2: x, y1: bottom, y2: bottom + 4 }),
        svg("text", { x, y: bottom + 16, "text-anchor": "middle" },
          parameterTick(tick),
        ),
      ];
    }),
    svg("text.axis-name", { x: frame.x(0.5), y: bottom + 33, "text-anchor": "middle" },
      unit ? `${name} (${unit})` : name,
    ),
  ];
}

function promiseShade(frame, aCase, scale) {
  const [from, to] = promisedShare(aCase, scale);
  return svg("rect.promise", {
    x: frame.x(from), width: Math.max(1, frame.x(to) - frame.x(from)), y: frame.y(1),
    height: frame.y(0) - frame.y(1),
  });
}

function breakLines(frame, aCase, target, scale) {
  return nearestBreaks(aCase, target).map((place) => {
    const x = frame.x(scale.at(place.parameter));
    return withTip(
      svg("line.break", { x1: x, x2: x, y1: frame.y(0), y2: frame.y(1) }),
      () => [el("b", "First breaks here"), el("div", breakText(aCase, place))],
    );
  });
}

// points: [{x, y, low, high, bad, point}] in pixels. limit: drawn below it, or null.
function curve(line, points, describe, limit) {
  const color = `var(${line.style.variable})`;
  const path = points.map((p, i) => `${i === 0 ? "M" : "L"}${p.x} ${p.y}`).join("");
  const banded = points.filter((p) => known(p.low) && known(p.high));
  const corners = [
    ...banded.map((p) => `${p.x},${p.high}`),
    ...banded.reverse().map((p) => `${p.x},${p.low}`),
  ];
  return svg("g", { "data-series": line.index },
    limit,
    corners.length > 3 &&
      svg("polygon.band", { points: corners.join(" "), style: { fill: color } }),
    svg("path.curve", {
      d: path, "stroke-dasharray": line.style.dash.join(" ") || null,
      style: { stroke: color },
    }),
    points.map((p) => [
      p.bad && svg("circle.bad", { cx: p.x, cy: p.y, r: 8 }),
      withTip(
        svg("path.marker", {
          d: markerPath(line.style.marker, p.x, p.y, 3.6),
          style: { stroke: color, fill: p.hollow ? "var(--panel)" : color },
        }),
        () => describe(line, p.point),
      ),
    ]),
  );
}

// Values that are not there: a cross at the bottom, with the message.
function refusals(frame, lines, scale, describe) {
  const seen = new Map();
  for (const line of lines) {
    for (const point of line.points) {
      if (hasNumber(point) || point.not_measured) continue;
      seen.set(point.parameter, { line, point });
    }
  }
  return [...seen.values()].map(({ line, point }) =>
    withTip(
      svg("path", {
        class: point.crash ? "refused bad" : "refused",
        d: markerPath("cross", frame.x(scale.at(point.parameter)), frame.y(0) - 8, 4),
      }),
      () => describe(line, point),
    ),
  );
}

// options: {aCase, target, lines, shown, value(point) -> {value, low, high} or null,
// yLog, yTick, include, label, describe(line, point)}
function mapPlot(host, options) {
  const { aCase, target, lines } = options;
  const frame = plotFrame(Math.max(260, host.clientWidth), host.clientHeight || 300);
  const xScale = parameterScale(aCase);
  const drawn = lines.map((line) => ({
    line,
    points: line.points
      .filter(hasNumber)
      .map((point) => ({ point, ...options.value(point) }))
      .filter((p) => known(p.value)),
  }));
  const all = drawn.flatMap((d) => d.points);
  const values = all.flatMap((p) => [p.value, p.high, p.limit]).filter(known);
  const yScale = makeScale([...values, ...(options.include || [])], options.yLog, 0.06);
  const yAt = (v) => frame.y(Math.max(0, yScale.at(v)));
  host.drawn = { lines, drawn, aCase, label: options.quantity }; // for mapSaveButtons()
  host.replaceChildren(
    svg("svg",
      {
        class: lines.length > MOST_BANDS ? "map-plot many" : "map-plot",
        width: frame.width, height: frame.height, role: "img",
        "aria-label": options.label,
      },
      promiseShade(frame, aCase, xScale),
      gridLines(frame, yScale, options.yTick),
      xTicks(frame, aCase, xScale),
      breakLines(frame, aCase, target, xScale),
      drawn.map(({ line, points }) =>
        curve(
          line,
          points.map((p) => ({
            x: frame.x(xScale.at(p.point.parameter)),
            y: yAt(p.value),
            low: known(p.low) ? yAt(p.low) : null,
            high: known(p.high) ? yAt(p.high) : null,
            hollow: yScale.log && p.value <= 0,
            bad: !p.point.verdict.good,
            point: p.point,
          })),
          options.describe,
          limitLine(frame, line, points, xScale, yAt),
        ),
      ),
      refusals(frame, lines, xScale, options.describe),
    ),
  );
}

// Where a point would fail.
function limitLine(frame, line, points, xScale, yAt) {
  const limits = points.filter((p) => known(p.limit));
  if (limits.length < 2) return null;
  const d = limits
    .map((p, i) => `${i === 0 ? "M" : "L"}${frame.x(xScale.at(p.point.parameter))} ` +
      `${yAt(p.limit)}`)
    .join("");
  return svg("path.limit", { d, style: { stroke: `var(${line.style.variable})` } });
}
