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
    listen(listener) {
      listeners.add(listener);
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
    style: strategyStyle(index),
    level: levelOf(strategy),
  }));
  const ran = strategies.filter((s) => s.status === "ok" || (s.levels || []).length > 0);
  const ranked = rankOrder(scene, ran);
  const baseline = strategies[scene.baseline] || null;
  return {
    scene,
    strategies,
    ran,
    ranked,
    baseline,
    shown: makeSignal(leading(ranked, baseline)), // in colour in the plots
    focus: makeSignal(null), // index of a strategy, or null
    compare: makeSignal(null), // {a, b}: names that the comparator is asked to show
    tone: makeSignal({ curve: "srgb", exposure: 0 }),
    signal: abort.signal, // aborted when another scene is shown
    close: () => abort.abort(),
  };
}

const MOST_CURVES = 8; // that an eye can tell apart

// Indices of all, or of the first and the baseline where all would be too many.
function leading(ranked, baseline) {
  const few = ranked.length <= MOST_CURVES ? ranked : ranked.slice(0, MOST_CURVES - 2);
  const indices = new Set(few.map((s) => s.index));
  if (baseline && ranked.includes(baseline)) indices.add(baseline.index);
  return indices;
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

// Calls draw now and whenever the colours change.
function drawThemed(view, draw) {
  document.addEventListener("themechange", draw, { signal: view.signal });
  draw();
}

function confidenceText() {
  const confidence = study.settings ? study.settings.confidence : null;
  return known(confidence) ? fmtShortPercent(confidence) : null;
}
