"use strict";
// What the parts of the page share while one scene is shown.

// A value that tells when it changes.
function makeSignal(value) {
  const listeners = new Set();
  return {
    get value() {
      return value;
    },
    set(next) {
      value = next;
      for (const listener of listeners) listener(value);
    },
    // Returns what ends the listening.
    listen(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}

// The largest complete level that efficiency, maps and images are of.
function levelOf(strategy) {
  const levels = strategy.levels || [];
  return levels.find((level) => level.spp === strategy.at_spp) || null;
}

function makeView(scene) {
  const abort = new AbortController();
  const strategies = (scene.strategies || []).map((strategy, index) => ({
    ...strategy,
    index,
    level: levelOf(strategy),
  }));
  const ran = strategies.filter((s) => s.status === "ok" || (s.levels || []).length > 0);
  const ranked = rankOrder(scene, ran);
  const baseline = strategies[scene.baseline] || null;
  giveStyles(strategies, leading(ranked, baseline));
  return {
    scene, strategies, ran, ranked, baseline,
    shown: makeSignal(leading(ranked, baseline)), // in colour in the plots
    focus: makeSignal(null), // index of a strategy, or null
    compare: makeSignal(null), // {a, b}: names that the comparator is asked to show
    tone: makeSignal({ curve: "srgb", exposure: 0 }),
    signal: abort.signal, // aborted when another scene is shown
    close: () => abort.abort(),
  };
}

// A view of lines that are not the strategies of a scene: all are shown.
function linesView(lines) {
  const view = makeView({ strategies: lines });
  view.ran = view.ranked = lines;
  view.shown.set(new Set(lines.map((line) => line.index)));
  return view;
}

const MOST_CURVES = 8; // that an eye can tell apart

// Indices of all, or of the first and the baseline where all would be too many.
function leading(ranked, baseline) {
  const few = ranked.length <= MOST_CURVES ? ranked : ranked.slice(0, MOST_CURVES - 2);
  const indices = new Set(few.map((s) => s.index));
  if (baseline && ranked.includes(baseline)) indices.add(baseline.index);
  return indices;
}

// Those that lead look unlike each other, however many there are.
function giveStyles(strategies, first) {
  const rest = strategies.filter((s) => !first.has(s.index));
  const ordered = [...strategies.filter((s) => first.has(s.index)), ...rest];
  ordered.forEach((s, place) => {
    s.style = strategyStyle(place);
  });
}

const MOST_ROWS = 12; // that are shown at once

// row() of every strategy; of many, of those that lead, and of the others on demand.
function leadingRows(view, strategies, row) {
  if (strategies.length <= MOST_ROWS) return strategies.map(row);
  const first = leading(view.ranked, view.baseline);
  const rest = strategies.filter((s) => !first.has(s.index));
  const others = el("details.others", el("summary", `${rest.length} more strategies`));
  others.addEventListener("toggle", () => others.append(...rest.map(row)), { once: true });
  return [strategies.filter((s) => first.has(s.index)).map(row), others];
}

// The strategies that do on this scene exactly what `strategy` does.
function twinsOf(view, strategy) {
  return view.strategies.filter((s) => s.same_as === strategy.index);
}

function rankOrder(scene, ran) {
  const place = new Map((scene.ranking || []).map((index, i) => [index, i]));
  const order = (s) => (place.has(s.index) ? place.get(s.index) : 1e6 + s.index);
  return [...ran].sort((a, b) => order(a) - order(b));
}

function confidenceText() {
  const confidence = study.settings ? study.settings.confidence : null;
  return known(confidence) ? fmtShortPercent(confidence) : null;
}
