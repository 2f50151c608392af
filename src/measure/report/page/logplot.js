"use strict";
// One log-log plot: lines with markers and confidence bands, guides, hover values. uPlot
// keeps axes, scales, lines, zoom and toggling; the rest is drawn in its hooks.
//
// options: {lines, xAxis, yAxis, label, guides(u), describe(line, point), square: one range
// for both axes, include: values that the y axis must hold, ghosts: lines that are not
// shown stay, thin and grey, beside: {label, of(line), marks}: intervals of the lines that
// files of the plot have beside it}
// line: {index, name, style, bars, points: [{x, y, low, high, hollow}]}, x ascending.

function alignedData(lines) {
  const xs = [...new Set(lines.flatMap((line) => line.points.map((p) => p.x)))];
  xs.sort((a, b) => a - b);
  const columns = lines.map((line) => {
    const at = new Map(line.points.map((p) => [p.x, p.y]));
    return xs.map((x) => (at.has(x) ? at.get(x) : null));
  });
  return [xs.length > 0 ? xs : [1], ...columns];
}

// Values that the y axis should hold: bounds only as far as a factor 8 below the value.
function shownRanges(view, options) {
  const { lines } = options;
  const points = lines
    .filter((line) => view.shown.value.has(line.index))
    .flatMap((line) => line.points);
  const all = points.length > 0 ? points : lines.flatMap((line) => line.points);
  return {
    x: logRange(
      all.map((p) => p.x),
      1.35,
    ),
    y: logRange(
      all
        .flatMap((p) => [p.y, p.high, p.low && Math.max(p.low, p.y / 8)])
        .concat(options.include || []),
    ),
  };
}

// uPlot asks for a range both to show all and when the reader zooms.
function isZoomed(u, min, max) {
  const xs = u.data[0];
  return known(min) && (min !== xs[0] || max !== xs[xs.length - 1]) && xs.length > 1;
}

function plotOptions(view, options, size) {
  const ranges = () => shownRanges(view, options);
  const both = () => {
    const { x, y } = ranges();
    return [Math.min(x[0], y[0]), Math.max(x[1], y[1])];
  };
  return {
    ...size,
    padding: [10, 12, 0, 0],
    legend: { show: false },
    cursor: { points: { show: false }, drag: { x: true, y: true, uni: 20 } },
    focus: { alpha: 0.18 },
    scales: {
      x: {
        time: false,
        distr: 3,
        range: (u, min, max) => {
          if (isZoomed(u, min, max)) return [min, max];
          return options.square ? both() : ranges().x;
        },
      },
      y: { distr: 3, range: () => (options.square ? both() : ranges().y) },
    },
    axes: [options.xAxis, options.yAxis].map((axis, i) =>
      logAxis({ space: i === 0 ? 62 : 34, size: i === 0 ? 30 : 58, ...axis }),
    ),
    series: [
      {},
      ...options.lines.map((line) => ({
        label: line.name,
        spanGaps: true,
        points: { show: false },
        alpha: 1,
        stroke: () =>
          theme.color(view.shown.value.has(line.index) ? line.style.variable : "--ghost"),
        show: options.ghosts || view.shown.value.has(line.index),
        ...lineLook(view, line),
      })),
    ],
    hooks: plotHooks(view, options),
  };
}

function lineLook(view, line) {
  const shown = view.shown.value.has(line.index);
  return { width: shown ? 2 : 1, dash: shown ? line.style.dash : [] };
}

// The point nearest to the pointer, within 40 pixels.
function nearestPoint(u, lines) {
  let best = { distance: 40 };
  for (const line of lines) {
    for (const point of line.points) {
      const distance = Math.hypot(
        u.valToPos(point.x, "x") - u.cursor.left,
        u.valToPos(point.y, "y") - u.cursor.top,
      );
      if (distance < best.distance) best = { distance, line, point };
    }
  }
  return best.line ? best : null;
}

function bindHover(view, u, options) {
  u.over.addEventListener(
    "mousemove",
    (event) => {
      const near = nearestPoint(u, shownLines(view, options.lines));
      if (!near) return tip.hide();
      tip.show(options.describe(near.line, near.point), event.clientX, event.clientY);
    },
    { signal: view.signal },
  );
  u.over.addEventListener("mouseleave", tip.hide, { signal: view.signal });
}

// Draws into host, whose size is that of the plot, and keeps it up to date. Returns a
// function that ends the plot.
function logPlot(view, host, options) {
  const size = () => ({ width: host.clientWidth, height: host.clientHeight });
  const u = new uPlot(
    plotOptions(view, options, size()),
    alignedData(options.lines),
    host,
  );
  host.plot = u;
  host.drawn = { view, options, u }; // for exportButtons()
  host.classList.add("drawn");
  u.root.querySelector("canvas").setAttribute("role", "img");
  u.root.querySelector("canvas").setAttribute("aria-label", options.label);
  bindHover(view, u, options);
  let alive = true;
  view.shown.listen((shown) => {
    if (!alive) return;
    options.lines.forEach((line, i) =>
      Object.assign(u.series[i + 1], lineLook(view, line)),
    );
    if (!options.ghosts) {
      u.batch(() =>
        options.lines.forEach((line, i) =>
          u.setSeries(i + 1, { show: shown.has(line.index) }),
        ),
      );
    }
    u.setData(u.data); // new ranges
  });
  view.focus.listen((index) => {
    if (!alive) return;
    const at = options.lines.findIndex((line) => line.index === index);
    u.setSeries(at < 0 ? null : at + 1, { focus: at >= 0 });
    u.redraw(false, false);
  });
  const redraw = () => alive && u.redraw(false, true);
  document.addEventListener("themechange", redraw, { signal: view.signal });
  const observer = new ResizeObserver(() => alive && u.setSize(size()));
  observer.observe(host);
  const end = () => {
    if (!alive) return;
    alive = false;
    delete host.drawn;
    host.classList.remove("drawn");
    observer.disconnect();
    u.destroy();
  };
  view.signal.addEventListener("abort", end);
  return end;
}
