"use strict";
// Shows the run; what depends on the SIMD target or the chosen map is drawn anew.

const state = { target: targets[0], map: null, view: null };

function fillTargets(onTarget) {
  if (targets.length < 2) return;
  document.getElementById("scenes").replaceChildren(
    ...targets.map((target) =>
      el("a.tab",
        {
          href: "#summary", "data-target": target,
          "aria-current": target === state.target ? "true" : null,
          onclick: (event) => {
            event.preventDefault();
            onTarget(target);
          },
        },
        target,
      ),
    ),
  );
}

// The map to begin with: one that fails, or breaks, or the first.
function firstMap() {
  const fails = maps.find((m) => m.outcome === "failed");
  return fails || maps.find((m) => m.breaks.length > 0) || maps[0] || null;
}

function markTile() {
  for (const node of document.querySelectorAll(".tile")) {
    const mine = state.map && node.dataset.case === state.map.name;
    node.setAttribute("aria-current", String(Boolean(mine)));
  }
}

function start() {
  startPage({
    title: "Lanelight stress",
    footer: `Written by ${study.version}. This page holds all its numbers and needs no network.`,
    sections: [
      ["summary", "Verdict"],
      maps.length > 0 && ["map", "Map"],
      compared.length > 0 && ["strategies", "Strategies"],
      ["cases", "Cases"],
      ["reading", "How to read this"],
    ],
  });
  const top = el("div"),
    detail = el("div"),
    strategies = el("div");
  const showMap = () => {
    tip.hide();
    if (state.view) state.view.close();
    const { map, target } = state;
    if (map) {
      state.view = linesView(seriesOf(map, target));
      detail.replaceChildren(detailSection(state.view, map, target, choose));
    }
    markTile();
  };
  const choose = (name) => {
    state.map = maps.find((m) => m.name === name);
    showMap();
    document.getElementById("map").scrollIntoView();
  };
  const showTarget = (target) => {
    state.target = target;
    fillTargets(showTarget);
    top.replaceChildren(stressSummary(target, choose));
    strategies.replaceChildren(strategiesSection(target) || "");
    showMap();
  };
  state.map = firstMap();
  showContent(top, detail, strategies, tableSection(choose), readingSection(STRESS_TERMS));
  showTarget(state.target);
}

start();
