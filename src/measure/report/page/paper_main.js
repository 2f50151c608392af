"use strict";
// The founding paper on one page: its figures on one scene, each with its equation, what that
// says, and what was found.

function paperNumber(view, number, strategies) {
  if (number === 8) {
    const steepest = [...strategies].sort(
      (a, b) => (valueOf(a.order) ?? 0) - (valueOf(b.order) ?? 0))[0];
    if (!steepest || valueOf(steepest.order) === null) return null;
    const { value, bounds } = intervalTexts(steepest.order);
    return heroNumber(value, bounds, ["is the steepest slope, of ", el("b", steepest.name)]);
  }
  const s = strategyOfFigure(view, number);
  if (!s || valueOf(s.efficiency) === null) return null;
  const { value, bounds } = intervalTexts(s.efficiency);
  return heroNumber(`${value}×`, bounds, ["as efficient as ", el("b", view.baseline.name)]);
}

function paperPart(number, title, big, found, figure) {
  const [equation, says] = PAPER_EQUATIONS[number];
  return section(`part-${number}`, title,
    el("div.paper-part",
      el("div",
        el("p.equation", equation),
        el("p", says),
        el("p.found", found || "Nothing was found of it in this study."),
        big,
      ),
      figure,
    ),
  );
}

function paperIntroduction(view) {
  const { bias } = view.scene;
  return firstSection("A paper on path tracing, on one page",
    el("p.verdict",
      "S. Maughan's Path Tracing Renderer Using Monte Carlo Methods, each figure rendered anew ",
       "and measured, on the scene ", el("b", view.scene.name), "."),
    el("p.equation", "L(x, ω) = Lₑ(x, ω) + ∫ f(x, ω, ω′) L(x′, −ω′) cos θ′ dω′"),
    el("p.lead",
      "Light that leaves a point is what it emits and what it scatters of all that arrives " +
       "(Kajiya 1986). A path is one sample of that integral, nested; the figures are ways to " +
       "draw it. All are compared with one baseline, which changes nothing but the one thing " +
       "that a figure is about."),
    bias && known(bias.tests) &&
      el("p.lead",
        `Bias: of ${bias.tests} tests that a strategy's mean image is the reference's, ` +
         `${bias.failed} failed (probability of any false alarm: ${fmtShort(bias.level)}).`),
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
    return hosts.get(number) || missingPicture("This study does not have its strategy.");
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
      "needs no network; report.html beside it has more.",
    sections: numbers.map((key) => [`part-${key}`, `Figure ${key}`]),
  });
  const view = makeView(scene);
  showContent(paperIntroduction(view), paperSections(view));
}

start();
