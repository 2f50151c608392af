"use strict";
// Lines that help to read the curves: slopes and the target.

// Short lines of constant order, named by their slope on these axes, where curves that fall
// leave room: at the upper right.
function slopeGuides({ scales, ...frame }, power) {
  const x0 = valueAt(scales.x, 0.58),
    y0 = valueAt(scales.y, 0.94);
  return [0.5, 1].map((order) => {
    const slope = order * power;
    const yAt = (x) => y0 * (x / x0) ** -slope;
    const end = Math.min(scales.x.to / 1.03, x0 * (y0 / valueAt(scales.y, 0.45)) ** (1 / slope));
    const from = { x: frame.x(x0), y: frame.y(y0) },
      to = { x: frame.x(end), y: frame.y(yAt(end)) };
    const angle = (Math.atan2(to.y - from.y, to.x - from.x) * 180) / Math.PI;
    return [
      svg("path.guide", { d: `M${from.x} ${from.y}L${to.x} ${to.y}` }),
      svg("text.guide-name",
        { "text-anchor": "end", transform: `translate(${to.x} ${to.y}) rotate(${angle})` },
        svg("tspan", { dx: -4, dy: -5 }, `slope ${MINUS}${slope === 0.5 ? "½" : slope}`),
      ),
    ];
  });
}

function targetGuide({ left, right, scales, ...frame }, target) {
  if (!known(target) || target <= scales.y.from || target >= scales.y.to) return null;
  const y = frame.y(target);
  return [
    svg("path.target", { d: `M${left} ${y}H${right}` }),
    svg("text.target-name", { x: left + 6, y: y - 4 }, `target ${fmtShort(target)}`),
  ];
}
