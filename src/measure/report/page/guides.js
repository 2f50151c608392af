"use strict";
// Lines that help to read the curves: slopes and the target.

// Short lines of constant order, named by their slope on these axes, where curves that fall
// leave room: at the upper right.
function drawSlopes(u, power) {
  const { x, y } = u.scales;
  const x0 = x.min ** 0.42 * x.max ** 0.58,
    y0 = y.max ** 0.94 * y.min ** 0.06;
  const lowest = y.max ** 0.45 * y.min ** 0.55;
  const dash = 4 * devicePixelRatio;
  u.ctx.strokeStyle = u.ctx.fillStyle = theme.color("--faint");
  u.ctx.lineWidth = devicePixelRatio;
  u.ctx.font = `${11 * devicePixelRatio}px system-ui, sans-serif`;
  u.ctx.textAlign = "right";
  u.ctx.textBaseline = "bottom";
  for (const order of [0.5, 1]) {
    const text = `slope ${MINUS}${order * power === 0.5 ? "½" : order * power}`;
    const yAt = (v) => y0 * (v / x0) ** (-order * power);
    const end = Math.min(x.max / 1.03, x0 * (y0 / lowest) ** (1 / (order * power)));
    u.ctx.setLineDash([dash, dash]);
    u.ctx.beginPath();
    u.ctx.moveTo(u.valToPos(x0, "x", true), u.valToPos(y0, "y", true));
    u.ctx.lineTo(u.valToPos(end, "x", true), u.valToPos(yAt(end), "y", true));
    u.ctx.stroke();
    labelSlope(u, text, end, yAt);
  }
  u.ctx.setLineDash([]);
}

function labelSlope(u, text, x, yAt) {
  const px = u.valToPos(x, "x", true),
    py = u.valToPos(yAt(x), "y", true);
  const px0 = u.valToPos(x / 20, "x", true),
    py0 = u.valToPos(yAt(x / 20), "y", true);
  u.ctx.save();
  u.ctx.translate(px, py);
  u.ctx.rotate(Math.atan2(py - py0, px - px0));
  u.ctx.fillText(text, -4 * devicePixelRatio, -5 * devicePixelRatio);
  u.ctx.restore();
}

function drawTarget(u, target) {
  if (!known(target) || target <= u.scales.y.min || target >= u.scales.y.max) return;
  const y = u.valToPos(target, "y", true);
  const { left, width } = u.bbox;
  u.ctx.strokeStyle = u.ctx.fillStyle = theme.color("--target");
  u.ctx.lineWidth = 1.5 * devicePixelRatio;
  u.ctx.beginPath();
  u.ctx.moveTo(left, y);
  u.ctx.lineTo(left + width, y);
  u.ctx.stroke();
  u.ctx.font = `${11 * devicePixelRatio}px system-ui, sans-serif`;
  u.ctx.textAlign = "left";
  u.ctx.textBaseline = "bottom";
  u.ctx.fillText(
    `target ${fmtShort(target)}`,
    left + 6 * devicePixelRatio,
    y - 2 * devicePixelRatio,
  );
}
