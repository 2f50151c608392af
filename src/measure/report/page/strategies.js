"use strict";
// How a strategy looks wherever it appears: colour, dash and marker, so that the colour
// is never the only clue. The colours themselves are in base.css, one set for each theme.

const COLOR_COUNT = 8;
const DASHES = [[], [7, 4], [2, 3], [9, 3, 2, 3]];
const MARKERS = ["circle", "square", "triangle", "diamond", "down", "cross", "plus"];

function strategyStyle(index) {
  const round = Math.floor(index / COLOR_COUNT);
  return {
    variable: `--c${index % COLOR_COUNT}`,
    dash: DASHES[(index + round) % DASHES.length],
    marker: MARKERS[index % MARKERS.length],
  };
}

function markerPath(marker, x, y, r) {
  const d = r * 1.3;
  const paths = {
    circle: `M${x - r} ${y}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`,
    square: `M${x - r} ${y - r}h${2 * r}v${2 * r}h${-2 * r}z`,
    triangle: `M${x} ${y - r * 1.2}L${x + r * 1.15} ${y + r * 0.9}H${x - r * 1.15}z`,
    down: `M${x} ${y + r * 1.2}L${x + r * 1.15} ${y - r * 0.9}H${x - r * 1.15}z`,
    diamond: `M${x} ${y - d}l${d} ${d}l${-d} ${d}l${-d} ${-d}z`,
    cross: `M${x - r} ${y - r}L${x + r} ${y + r}M${x + r} ${y - r}L${x - r} ${y + r}`,
    plus: `M${x - r * 1.2} ${y}H${x + r * 1.2}M${x} ${y - r * 1.2}V${y + r * 1.2}`,
  };
  return paths[marker];
}

// A piece of the strategy's line with its marker.
function swatch(style) {
  const color = `var(${style.variable})`;
  return svg("svg.swatch",
    { viewBox: "0 0 34 12", width: 34, height: 12, "aria-hidden": "true" },
    svg("line", {
      x1: 1, y1: 6, x2: 33, y2: 6, "stroke-width": 2,
      "stroke-dasharray": style.dash.join(" ") || null, style: { stroke: color },
    }),
    svg("path", {
      d: markerPath(style.marker, 17, 6, 4), "stroke-width": 1.8,
      style: { stroke: color, fill: color },
    }),
  );
}

const LONGEST_NAME = 38;

// What tells a strategy from others in little room: of a long list of changes the values
// only, "mis · halton · antithetic", cut where even that is long.
function shortName(name) {
  if (name.length <= LONGEST_NAME) return name;
  const values = name
    .split(",")
    .map((change) => change.slice(change.indexOf("=") + 1))
    .join(" · ");
  return values.length <= LONGEST_NAME ? values : `${values.slice(0, LONGEST_NAME - 1)}…`;
}

// The name in full, and what it stands for.
function fullName(strategy) {
  const { name, text } = strategy;
  return text && text !== name ? `${name}: ${text}` : name;
}

function strategyLabel(strategy) {
  return el("span.strategy", { title: fullName(strategy) },
    swatch(strategy.style),
    el("span.strategy-name", shortName(strategy.name)),
  );
}

// "A, B and 3 more".
function someNames(strategies, most = 4) {
  const names = strategies.map((s) => shortName(s.name));
  if (names.length <= most + 1) return names.join(", ");
  return `${names.slice(0, most).join(", ")} and ${names.length - most} more`;
}

const STATUS_WORDS = { refused: "refused", failed: "failed", skipped: "not finished" };

function statusWord(strategy) {
  return STATUS_WORDS[strategy.status] || null;
}

function whyMissing(strategy) {
  const word = statusWord(strategy);
  if (!word) return strategy.message || "There is no result.";
  const reason = strategy.message || "no reason given";
  return `${capitalised(word)}: ${reason}`;
}
