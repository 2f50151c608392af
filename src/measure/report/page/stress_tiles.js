"use strict";
// All maps as small multiples on one scale of errors: the picture of the first screen.

const TILE = { width: 200, height: 84, from: -8, to: 1 };

// Height of a relative error; what is smaller or larger lies on the edge.
function tileY(error) {
  const exponent = error > 0 ? Math.log10(error) : TILE.from;
  const share = (exponent - TILE.from) / (TILE.to - TILE.from);
  return TILE.height * (1 - Math.max(0.02, Math.min(0.98, share)));
}

function tilePoints(line, xScale) {
  return line.points.filter(hasNumber).map((point) => {
    const { value, limit } = errorOf(point);
    return {
      x: TILE.width * shareOn(xScale, point.parameter),
      y: tileY(value),
      limit: known(limit) ? tileY(limit) : TILE.height,
      bad: !point.verdict.good,
    };
  });
}

function tileCurve(line, points) {
  const d = points.map((p, i) => `${i === 0 ? "M" : "L"}${p.x} ${p.y}`).join("");
  const color = `var(${line.style.variable})`;
  return [
    svg("path.curve", { d, style: { stroke: color } }),
    points.map((p) =>
      svg("circle", {
        class: p.bad ? "dot bad" : "dot", cx: p.x, cy: p.y, r: p.bad ? 3.4 : 1.8,
        style: { fill: p.bad ? null : color },
      }),
    ),
  ];
}

// What noise and tolerance allow: below it an error cannot be told from none.
function tileAllowance(curves) {
  const lowest = new Map();
  for (const { x, limit } of curves.flat()) {
    lowest.set(x, Math.min(limit, lowest.get(x) ?? limit));
  }
  const xs = [...lowest.keys()].sort((a, b) => a - b);
  if (xs.length < 2) return null;
  const top = xs.map((x) => `${x},${lowest.get(x)}`).join(" ");
  const [first, last] = [xs[0], xs[xs.length - 1]];
  const points = `${first},${TILE.height} ${top} ${last},${TILE.height}`;
  return svg("polygon.allowed", { points });
}

function tileDrawing(aCase, target) {
  const xScale = parameterScale(aCase);
  const lines = seriesOf(aCase, target);
  const curves = lines.map((line) => tilePoints(line, xScale));
  const [from, to] = promisedShare(aCase, xScale);
  return svg("svg.tile-plot",
    {
      viewBox: `0 0 ${TILE.width} ${TILE.height}`, preserveAspectRatio: "none",
      role: "img", "aria-label": `Error against ${aCase.axis.name}`,
    },
    svg("rect.promise", {
      x: TILE.width * from, width: Math.max(1, TILE.width * (to - from)), y: 0,
      height: TILE.height,
    }),
    [1, 1e-2, 1e-4, 1e-6].map((error) =>
      svg("line.grid", { x1: 0, x2: TILE.width, y1: tileY(error), y2: tileY(error) }),
    ),
    tileAllowance(curves),
    nearestBreaks(aCase, target).map((place) => {
      const x = TILE.width * shareOn(xScale, place.parameter);
      return svg("line.break", { x1: x, x2: x, y1: 0, y2: TILE.height });
    }),
    lines.map((line, i) => tileCurve(line, curves[i])),
  );
}

function axisTitle({ axis: { name, unit } }) {
  return unit ? `${name} (${unit})` : name;
}

function axisEnds(aCase) {
  const values = aCase.points.map((p) => p.parameter).filter(known);
  return [Math.min(...values), Math.max(...values)].map(parameterTick);
}

// The outcome on one target: failing points there.
function failsOn(aCase, target) {
  return aCase.points.some((p) => p.target === target && p.promised && !p.verdict.good);
}

function tile(aCase, target, onChoose) {
  const failed = failsOn(aCase, target);
  const outcome = failed ? "failed" : aCase.outcome === "failed" ? "good" : aCase.outcome;
  const [low, high] = axisEnds(aCase);
  return withTip(
    el("button.tile",
      {
        "data-case": aCase.name, "data-outcome": outcome,
        onclick: () => onChoose(aCase.name),
      },
      el("span.tile-name", aCase.name),
      tileDrawing(aCase, target),
      el("span.tile-ends", el("span", low), el("span", high)),
      el("span.tile-axis", axisTitle(aCase)),
    ),
    () => noteOf(
      aCase.name,
      aCase.extreme,
      `${WORDS[outcome]}; supported range: ${promiseText(aCase)}`,
      ...nearestBreaks(aCase, target).map((b) => `first failure at ${breakText(aCase, b)}`),
    ),
  );
}

// Failed ones first; the others in their order.
function tileGrid(target, onChoose) {
  const order = [...maps].sort(
    (a, b) => Number(failsOn(b, target)) - Number(failsOn(a, target)),
  );
  return el("div.tiles", order.map((aCase) => tile(aCase, target, onChoose)));
}
