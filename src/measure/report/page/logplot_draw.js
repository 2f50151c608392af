"use strict";
// What uPlot does not draw itself: bands, markers, guides.

function fadeFor(view, line) {
  return view.focus.value === null || view.focus.value === line.index ? 1 : 0.18;
}

function shownLines(view, lines) {
  return lines.filter((line) => view.shown.value.has(line.index));
}

function clipToPlot(u) {
  const { left, top, width, height } = u.bbox;
  u.ctx.beginPath();
  u.ctx.rect(left, top, width, height);
  u.ctx.clip();
}

// The area between the bounds, or whiskers where there is a single point or `line.bars`.
function drawBand(u, line, alpha) {
  const points = line.points.filter((p) => known(p.low) && known(p.high) && p.high > 0);
  if (points.length === 0) return;
  const x = (p) => u.valToPos(p.x, "x", true);
  const whiskers = line.bars || points.length === 1;
  const floor = u.scales.y.min / 1e3;
  const y = (v) => u.valToPos(Math.max(v, floor), "y", true);
  u.ctx.globalAlpha = alpha * (whiskers ? 0.8 : 0.16);
  u.ctx.beginPath();
  if (whiskers) {
    u.ctx.lineWidth = 2 * devicePixelRatio;
    u.ctx.strokeStyle = theme.color(line.style.variable);
    for (const p of points) {
      u.ctx.moveTo(x(p), y(p.low));
      u.ctx.lineTo(x(p), y(p.high));
    }
    u.ctx.stroke();
    return;
  }
  u.ctx.fillStyle = theme.color(line.style.variable);
  points.forEach((p) => u.ctx.lineTo(x(p), y(p.high)));
  [...points].reverse().forEach((p) => u.ctx.lineTo(x(p), y(p.low)));
  u.ctx.fill();
}

function drawMarkers(u, line, alpha) {
  u.ctx.globalAlpha = alpha;
  u.ctx.lineWidth = 1.6 * devicePixelRatio;
  u.ctx.strokeStyle = theme.color(line.style.variable);
  for (const p of line.points) {
    const x = u.valToPos(p.x, "x", true),
      y = u.valToPos(p.y, "y", true);
    const path = new Path2D(markerPath(line.style.marker, x, y, 4 * devicePixelRatio));
    u.ctx.fillStyle = p.hollow ? theme.color("--panel") : u.ctx.strokeStyle;
    u.ctx.fill(path);
    u.ctx.stroke(path);
  }
}

function plotHooks(view, options) {
  const each = (u, draw) => {
    u.ctx.save();
    clipToPlot(u);
    for (const line of shownLines(view, options.lines))
      draw(u, line, fadeFor(view, line));
    u.ctx.restore();
  };
  return {
    drawAxes: [
      (u) => {
        u.ctx.save();
        clipToPlot(u);
        if (options.guides) options.guides(u);
        u.ctx.restore();
        each(u, drawBand);
      },
    ],
    draw: [(u) => each(u, drawMarkers)],
  };
}
