"use strict";
// The paper's figures in their order, one button each, and how to compare: at equal time
// or at equal samples.

const FIGURES = {
  "paper-uniform": "Uniform",
  "paper-importance": "Importance",
  "paper-stratified": "Stratified",
  "paper-antithetic": "Antithetic",
  "paper-control": "Control variate",
  "paper-roulette": "Roulette",
};

function presetButtons(page, cards) {
  const both = (a, b) => {
    cards[0].choose(a);
    cards[1].choose(b);
    if (page.look.view === "a" || page.look.view === "b") page.showView("slider");
  };
  const button = (label, title, a, b) =>
    el("button.button",
      { title, "data-preset": `${a} ${b}`, onclick: () => both(a, b) }, label);
  const figures = page.hello.strategies.presets.filter((p) => FIGURES[p.name]);
  return el("div.presets",
    el("p.note", "Importance sampling of directions:"),
    el("div.choices",
      button("Uniform | importance", "A: directions uniform over the hemisphere; B: directions follow the BSDF",
        "paper-uniform", "paper-importance"),
      button("Importance | default", "A: BSDF sampling only; B: default strategy of lanelight",
        "paper-importance", "default")),
    el("p.note",
      "Figures of the paper: A is the baseline (paper-plain), B changes one choice:"),
    el("div.choices",
      figures.map((p, i) =>
        button(`${i + 1}. ${FIGURES[p.name]}`, p.meaning, "paper-plain", p.name))),
  );
}

function paceButtons(page) {
  const node = choiceButtons(
    "Compared at", [["time", "Equal time"], ["samples", "Equal samples"]], "time",
    (pace) => {
      page.pace = pace;
      page.socket.send({ do: "pace", by: pace });
    },
  );
  node.id = "pace";
  return node;
}
