"use strict";
// A plot in the page: which lines are shown, values under the pointer, zoom.

function placeIn(node, event) {
  const { left, top } = node.getBoundingClientRect();
  return { x: event.clientX - left, y: event.clientY - top };
}

// The point nearest to the pointer, within 40 pixels.
function nearestPoint({ node, frame, lines }, event) {
  const { x, y } = placeIn(node, event);
  let best = { distance: 40 };
  for (const line of lines) {
    for (const point of line.points) {
      const distance = Math.hypot(frame.x(point.x) - x, frame.y(point.y) - y);
      if (distance < best.distance) best = { distance, line, point };
    }
  }
  return best.line ? best : null;
}

function bindHover(host, describe, signal) {
  const move = (event) => {
    if (event.target.closest(".told")) return; // has a note of its own
    const near = nearestPoint(host.plot, event);
    if (!near) return tip.hide();
    tip.show(describe(near.line, near.point), event.clientX, event.clientY);
  };
  host.addEventListener("pointermove", move, { signal });
  host.addEventListener("pointerleave", tip.hide, { signal });
}

const LEAST_DRAG = 20; // pixels; less along an axis leaves all of it

// Drags choose a part, a double click all. zoom(scales or null)
function bindZoom(host, zoom, signal) {
  const part = (scale, pixels, from, to) => {
    if (Math.abs(pixels[1] - pixels[0]) < LEAST_DRAG) return scale;
    const ends = pixels.map((p) => valueAt(scale, (p - from) / (to - from)));
    return { ...scale, from: Math.min(...ends), to: Math.max(...ends), zero: -1 };
  };
  const press = (event) => {
    if (event.button !== 0) return;
    event.preventDefault(); // selects no text
    const { node, frame } = host.plot;
    const start = placeIn(node, event);
    const area = svg("rect.area");
    const gesture = new AbortController();
    const drag = (now) => {
      const end = placeIn(node, now);
      node.append(area);
      setAttributes(area, {
        x: Math.min(start.x, end.x), width: Math.abs(start.x - end.x),
        y: Math.min(start.y, end.y), height: Math.abs(start.y - end.y),
      });
    };
    const release = (now) => {
      const end = placeIn(node, now);
      gesture.abort();
      area.remove();
      if (Math.hypot(end.x - start.x, end.y - start.y) < LEAST_DRAG) return;
      zoom({
        x: part(frame.scales.x, [start.x, end.x], frame.left, frame.right),
        y: part(frame.scales.y, [start.y, end.y], frame.bottom, frame.top),
      });
    };
    addEventListener("mousemove", drag, { signal: gesture.signal });
    addEventListener("mouseup", release, { signal: gesture.signal });
  };
  host.addEventListener("mousedown", press, { signal });
  host.addEventListener("dblclick", () => zoom(null), { signal });
}

// Draws into host, whose size is that of the plot, and keeps it up to date. options: as of
// drawPlot(), and {describe(line, point), beside: {label, of(line), marks}: intervals of the
// lines that files of the plot have beside it}. Returns a function that ends the plot.
function showPlot(view, host, options) {
  const abort = new AbortController();
  let scales = null;
  const focus = () => {
    const index = view.focus.value;
    host.plot.node.classList.toggle("focused", index !== null);
    for (const node of host.querySelectorAll("g[data-series]")) {
      node.classList.toggle("focus", Number(node.dataset.series) === index);
    }
  };
  const draw = () => {
    const size = { width: host.clientWidth, height: host.clientHeight };
    if (size.width === 0) return;
    const shown = options.lines.filter((line) => view.shown.value.has(line.index));
    host.plot = { ...drawPlot(size, options, shown, scales), options };
    host.replaceChildren(host.plot.node);
    focus();
  };
  const observer = new ResizeObserver(draw);
  const stops = [view.shown.listen(draw), view.focus.listen(() => host.plot && focus())];
  const end = () => {
    abort.abort();
    observer.disconnect();
    stops.forEach((stop) => stop());
    host.replaceChildren();
    delete host.plot;
  };
  bindHover(host, options.describe, abort.signal);
  bindZoom(host, (chosen) => { scales = chosen; draw(); }, abort.signal);
  view.signal.addEventListener("abort", end, { signal: abort.signal });
  observer.observe(host);
  draw();
  return end;
}

function logPlot(view, host, options) {
  return showPlot(view, host, { ...options, scales: logScales(options) });
}
