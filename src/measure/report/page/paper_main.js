"use strict";
// The founding paper on one page: its figures on one scene, each with its equation, what that
// says, and what was found.

function paperNumber(view, number, strategies) {
  if (number === 8) {
    const steepest = [...strategies].sort(
      (a, b) => (valueOf(a.order) ?? 0) - (valueOf(b.order) ?? 0))[0];
    if (!steepest || valueOf(steepest.order) === null) return null;
    const { value, bounds } = intervalTexts(steepest.order);
    return heroNumber(value, bounds, ["is the steepest convergence slope, of ", el("b", steepest.name)]);
  }
  const s = strategyOfFigure(view, number);
  if (!s || valueOf(s.efficiency) === null) return null;
  const { value, bounds } = intervalTexts(s.efficiency);
  return heroNumber(`${value}×`, bounds, ["the efficiency of ", el("b", view.baseline.name), " (baseline)"]);
}

function paperPart(number, title, big, found, figure) {
  const [equation, says] = PAPER_EQUATIONS[number];
  return section(`part-${number}`, title,
    el("div.paper-part",
      el("div",
        el("p.equation", equation),
        el("p", says),
        el("p.found", found || "This study did not measure it."),
        big,
      ),
      figure,
    ),
  );
}

// The most efficient strategy of the paper, and its gain over the baseline.
function paperHeadline(view) {
  const { baseline } = view;
  const measured = paperStrategies(view).filter((s) => valueOf(s.efficiency) !== null);
  if (!baseline || measured.length === 0) return "No strategy of the paper has been measured.";
  const best = measured.reduce((a, b) => (b.efficiency.value > a.efficiency.value ? b : a));
  if (best === baseline) return [el("b", best.name), " is the most efficient strategy."];
  return [
    "Of the paper's strategies, ", el("b", best.name), " is the most efficient: ",
    `${joined(intervalTexts(best.efficiency, 1, "×"))} lower relative MSE than `,
    el("b", baseline.name), ` at equal processor time (${confidenceText()} interval).`,
  ];
}

function paperIntroduction(view) {
  const { bias } = view.scene;
  return firstSection("Figures of the founding paper, rendered and measured again",
    el("p.verdict",
      paperHeadline(view)),
    el("p.lead",
      "S. Maughan, Path Tracing Renderer Using Monte Carlo Methods. All figures show the scene ", el("b", view.scene.name), "."),
    el("p.equation", "L(x, ω) = Lₑ(x, ω) + ∫ f(x, ω, ω′) L(x′, −ω′) cos θ′ dω′"),
    el("p.lead",
      "The radiance that leaves a point is the emitted radiance plus the scattered part of the " +
       "incoming radiance (Kajiya 1986). A path is one sample of this nested integral. Each " +
       "figure changes one sampling choice of the same baseline."),
    bias && known(bias.tests) &&
      el("p.lead",
        `Bias: ${bias.failed} of ${bias.tests} strategies have a mean image that differs ` +
         `significantly from the reference (false-alarm rate ${fmtShort(bias.level)}).`),
    factsList(view),
  );
}

function paperSections(view) {
  const strategies = paperStrategies(view);
  const { hosts, controls } = sampledFigures(view, null);
  const titles = { 1: ["Diffuse models"], ...FIGURE_TITLES, 8: ["Convergence"] };
  const figureOf = (number) => {
    if (number === 1) return diffuseFigure(view);
    if (number === 8) return convergenceFigure(view, strategies);
    return hosts.get(number) || missingPicture("This study did not measure the strategy of this figure.");
  };
  const found = (number) =>
    number === 1 ? foundOfModels(view)
      : number === 8 ? foundOfOrders(strategies)
      : foundOfStrategy(view, strategyOfFigure(view, number));
  return Object.keys(PAPER_EQUATIONS).map(Number).map((number) => [
    number === 2 && controls,
    paperPart(number, titles[number][0], paperNumber(view, number, strategies), found(number),
              figureOf(number)),
  ]);
}

function start() {
  const scene = study.scenes[0];
  const numbers = Object.keys(PAPER_EQUATIONS);
  startPage({
    title: `${scene.name} – Lanelight paper`,
    footer:
      "Written by lanelight study --paper. This page holds all its numbers and images and " +
      "needs no network; report.html in the same directory has more.",
    sections: numbers.map((key) => [`part-${key}`, `Figure ${key}`]),
  });
  const view = makeView(scene);
  showContent(paperIntroduction(view), paperSections(view));
}

start();
