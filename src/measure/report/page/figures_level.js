"use strict";
// Which sample count the paper's figures are of: equal time, or equal samples.

// Of one repetition; only of the paper's strategies there are images of all levels.
function imageOf(strategy, level) {
  const { one } = strategy.images || {};
  return findImage(level.image || (level.spp === strategy.at_spp ? one : null));
}

// The levels of a strategy that the report has an image of, ascending.
function picturedLevels(strategy) {
  return (strategy.levels || []).filter((level) => imageOf(strategy, level));
}

function nearestLevel(levels, wanted, of) {
  const distance = (level) => Math.abs(Math.log(of(level) / wanted));
  return [...levels].sort((a, b) => distance(a) - distance(b))[0] || null;
}

// The level of a strategy beside `base`, one of the strategy that is compared with.
function levelBeside(strategy, base, equal) {
  const of = (level) => (equal === "time" ? valueOf(level.cpu_seconds) : level.spp);
  const levels = picturedLevels(strategy).filter((level) => of(level) > 0);
  return nearestLevel(levels, of(base), of);
}

const VISIBLE_NOISE = 0.01; // a relative MSE that an eye sees, for the start

// A slider over the sample counts of the baseline. draw(base, equal): called now and
// whenever another is chosen.
function levelControls(levels, draw) {
  const start = nearestLevel(levels, VISIBLE_NOISE, (level) => valueOf(level.relmse) || 1e-9);
  const state = { base: start, equal: "time" };
  const show = () => draw(state.base, state.equal);
  const counts = slider("Samples of the baseline", {
    min: 0, max: levels.length - 1, value: levels.indexOf(start),
    "data-control": "figure-spp", text: (i) => `${fmtCount(levels[i].spp)} spp`,
    onInput: (i) => {
      state.base = levels[i];
      show();
    },
  });
  const choices = [["time", "Equal time"], ["samples", "Equal samples"]];
  show();
  return el("div.toolbar",
    counts.node,
    choiceButtons("Compared at", choices, "time", (equal) => {
      state.equal = equal;
      show();
    }),
  );
}
