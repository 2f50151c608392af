"use strict";
// Shows one scene at a time. The address ends in #scene or #scene/section.

const SECTIONS = [
  ["ranking", "Ranking"],
  ["curves", "Curves"],
  ["calibration", "Calibration"],
  ["compare", "Images"],
  ["figures", "Figures"],
  ["maps", "Maps"],
  ["stages", "Time"],
  ["data", "Numbers"],
  ["reading", "Reading"],
];

let current = { view: null, index: -1 };

function sceneHash(scene, part) {
  return `#${encodeURIComponent(scene.name)}${part ? `/${part}` : ""}`;
}

// {index, part} of the address; the first scene where it names none.
function parseHash() {
  const [name, part] = location.hash.slice(1).split("/");
  let wanted = "";
  try {
    wanted = decodeURIComponent(name);
  } catch {
    // Malformed address: shows the first scene.
  }
  const index = study.scenes.findIndex((scene) => scene.name === wanted);
  return { index: Math.max(0, index), part };
}

function fillNavigation(scene) {
  document.getElementById("scenes").replaceChildren(
    ...(study.scenes.length < 2
      ? []
      : study.scenes.map((other) =>
          el("a.tab",
            { href: sceneHash(other), "aria-current": other === scene ? "page" : null },
            other.name,
          ),
        )),
  );
  linkSections(scene.error ? [] : SECTIONS, (id) => sceneHash(scene, id));
}

function errorScene({ name, error, path }) {
  return firstSection(name,
    warningBox("The study of this scene failed", [error]),
    path && el("p.full-text", path),
  );
}

function sceneSections(view) {
  const comparator = comparatorSection(view, imageChoices(view), [SIGNED_DIFFERENCE]);
  const compare = (a, b) => {
    view.compare.set({ a, b });
    comparator.scrollIntoView();
  };
  return [
    summarySection(view),
    rankingSection(view),
    curvesSection(view),
    calibrationSection(view),
    comparator,
    figuresSection(view, compare),
    mapsSection(view),
    stagesSection(view),
    levelsSection(view),
    readingSection(TERMS),
  ];
}

function showScene(index) {
  if (current.view) current.view.close();
  const scene = study.scenes[index];
  const view = makeView(scene);
  current = { view, index };
  document.title = `${scene.name} – Lanelight study`;
  fillNavigation(scene);
  tip.hide();
  showContent(scene.error ? errorScene(scene) : sceneSections(view));
  document.getElementById("content").dataset.scene = scene.name;
}

function followHash() {
  const { index, part } = parseHash();
  const changed = index !== current.index;
  if (changed) showScene(index);
  const target = part && document.getElementById(part);
  if (target) target.scrollIntoView();
  else if (changed) scrollTo(0, 0);
}

function start() {
  const { versions } = study.machine || {};
  const by = versions ? ` (${versionsText(versions)})` : "";
  const footer =
    `Written by lanelight study${by}. This page holds all its numbers and images and ` +
    "needs no network.";
  startPage({ title: "Lanelight study", footer });
  document.getElementById("skip").addEventListener("click", (event) => {
    event.preventDefault(); // the address belongs to the scenes
    document.getElementById("content").focus();
  });
  if (!study.scenes || study.scenes.length === 0) {
    return showContent(el("p.wait", "This study has no scenes."));
  }
  addEventListener("hashchange", followHash);
  followHash();
}

start();
