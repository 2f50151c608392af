"use strict";
// The founding paper's figures for this scene.

const FIGURE_TITLES = {
  2: ["Uniform sampling", "Scattered directions are uniform over the hemisphere."],
  3: ["Importance sampling", "Scattered directions follow the BSDF."],
  4: ["Stratified sampling", "Each stratum of the sample space gets one sample."],
  5: ["Antithetic variates", "Samples come in pairs with negatively correlated errors."],
  6: ["Control variates", "A similar function with a known integral is subtracted from the integrand."],
  7: ["Russian roulette", "Paths with a low throughput end at random; the estimate stays unbiased."],
};

function figureBox(number, title, body, caption) {
  return el("figure.paper", { id: `figure-${number}`, "data-figure": number },
    body,
    el("figcaption", el("b", `Figure ${number}. ${title}. `), caption),
  );
}

function diffuseFigure(view) {
  const models = view.scene.diffuse || [];
  if (models.length === 0) {
    const why = "Not rendered, because the scene has no diffuse surface.";
    return figureBox(1, "Diffuse models", missingPicture(why), null);
  }
  const cells = models.map((model) => {
    const image = findImage(model.image);
    const mean = (model.mean || []).map((x) => fmt(x, 3)).join(", ");
    return el("div",
      image
        ? tonedPicture(view, image, `The scene with the diffuse model ${model.model}`)
        : missingPicture("This report does not contain the image."),
      el("div.under",
        el("b", model.model),
        ` ${model.meaning || ""}`,
        mean && el("span.bounds", `mean ${mean}`),
      ),
    );
  });
  const caption = "The scene rendered with each diffuse scattering model.";
  return figureBox(1, "Diffuse models", el("div.models", cells), caption);
}

// The strategy's image at `level` with a magnified part, beside the same of the baseline,
// `shown` (its image), and the reference.
function strategyFigure(view, number, { strategy, level, image }, shown, inset, compare) {
  const [title, meaning] = FIGURE_TITLES[number];
  if (!image) {
    const why = statusWord(strategy)
      ? whyMissing(strategy)
      : "This report does not contain the image.";
    return figureBox(number, title, missingPicture(why), [strategy.name, ". ", meaning]);
  }
  const main = tonedPicture(view, image, `${strategy.name}, one repetition`, {
    frame: inset,
  });
  const insets = inset ? insetColumn(view, image, shown, inset) : null;
  // Widths that make the square insets together as high as the image.
  const parts = insets ? insets.childElementCount : 1;
  main.style.flexGrow = (parts * image.width) / image.height;
  const body = el("div.with-insets", main, insets);
  const caption = figureCaption(view, strategy, level, meaning, compare);
  return figureBox(number, title, body, caption);
}

function insetColumn(view, image, shown, inset) {
  const { scene } = view;
  const sources = [["this", image]];
  if (shown !== image) sources.push(["baseline", shown]);
  sources.push(["reference", findImage(scene.reference?.image)]);
  return el("div.insets",
    sources
      .filter(([, source]) => sizesEqual(source, image))
      .map(([name, source]) =>
        el("div",
          tonedPicture(view, source, `Magnified region: ${name}`, { crop: inset }),
          el("div.inset-name", name),
        ),
      ),
  );
}

function figureCaption(view, strategy, level, meaning, compare) {
  const of = (interval, text) => valueOf(interval) !== null && text(interval);
  const numbers = [
    level && `${fmtCount(level.spp)} spp`,
    level && of(level.cpu_seconds, ({ value }) => fmtSeconds(value)),
    level && of(level.relmse, (x) => `relative MSE ${joined(intervalTexts(x))}`),
    of(strategy.efficiency, (x) =>
      `efficiency at ${fmtCount(strategy.at_spp)} spp ${joined(intervalTexts(x))}`),
  ]
    .filter(Boolean)
    .join("; ");
  const reference = view.scene.reference?.image;
  return [
    meaning,
    ` ${strategy.name}: ${numbers || "not measured"}. `,
    compare && hasImage(reference) &&
      el("button.link", { onclick: () => compare(strategy.images.one, reference) },
        "Compare",
      ),
  ];
}

// The curves of the paper's strategies, and the slopes beside.
function convergenceFigure(view, strategies) {
  const measured = strategies.filter((s) => valueOf(s.order) !== null);
  const title = "Convergence";
  if (measured.length === 0) {
    return figureBox(8, title,
                     missingPicture("A convergence order needs at least two sample counts."), null);
  }
  const shown = makeSignal(new Set(measured.map((s) => s.index)));
  const own = { ...view, ran: measured, shown, focus: makeSignal(null) };
  const { host, figure } = plotFigure("convergence", "RMSE against samples per pixel");
  const counts = { label: "samples per pixel", ticks: binaryTicks, format: fmtCount };
  const byIndex = new Map(measured.map((s) => [s.index, s]));
  const beside = {
    label: "slope",
    marks: [-0.5],
    of: (line) => byIndex.get(line.index).order,
  };
  whenVisible(view, figure, () =>
    curvePlot(own, host, "rmse", counts, (level) => level.spp, { ghosts: false, beside }),
  );
  return figureBox(
    8, title,
    el("div.convergence", figure, orderRows(measured)),
    "Right: the fitted slope of log RMSE over log samples. Independent samples have a slope " +
      "of −½ (line); a more negative slope converges faster.",
  );
}

function orderRows(strategies) {
  const scale = whiskerScale(strategies.map((s) => s.order), false, [-0.5]);
  const size = { width: 200 };
  return el("div.orders",
    el("div"),
    el("div", whiskerAxis(scale, { ...size, format: fmtShort, most: 4 })),
    el("div"),
    strategies.map((s) => [
      el("div.order-name", strategyLabel(s)),
      el("div",
        whisker(s.order, scale, {
          ...size,
          style: s.style,
          marks: [-0.5],
          label: `Convergence order of ${s.name}`,
        }),
      ),
      el("div.order-value", twoLines(intervalTexts(s.order))),
    ]),
  );
}

// The strategy that is a figure of the paper; where it does what another does, that one
// under its name.
function strategyOfFigure(view, number) {
  const found = view.strategies.find((s) => s.figure === number);
  const twin = found && found.status === "same" && view.strategies[found.same_as];
  return twin ? { ...twin, name: found.name } : found;
}

// {controls, hosts: Map from the numbers 2 to 7, as far as there are, to elements}. The
// controls choose of which sample count the figures are.
function sampledFigures(view, compare) {
  const figures = Object.keys(FIGURE_TITLES)
    .map((key) => ({ number: Number(key), strategy: strategyOfFigure(view, Number(key)) }))
    .filter(({ strategy }) => strategy);
  const hosts = new Map(figures.map(({ number }) => [number, el("div")]));
  const candidates = [view.baseline, ...figures.map(({ strategy }) => strategy)];
  const baseline = candidates.find((s) => s && picturedLevels(s).length > 0);
  const reference = findImage(view.scene.reference?.image);
  const draw = (base, equal) => {
    const chosen = figures.map(({ number, strategy }) => {
      const level = base && levelBeside(strategy, base, equal);
      return { number, strategy, level, image: level && imageOf(strategy, level) };
    });
    const shown = base && imageOf(baseline, base);
    const images = [shown, ...chosen.map(({ image }) => image)].filter(Boolean);
    const inset = reference && insetWindow(images, reference);
    for (const figure of chosen) {
      hosts.get(figure.number).replaceChildren(
        strategyFigure(view, figure.number, figure, shown, inset, compare),
      );
    }
  };
  if (!baseline) draw(null);
  return { hosts, controls: baseline && levelControls(picturedLevels(baseline), draw) };
}

function paperStrategies(view) {
  const of = view.ranked.filter((s) => s.figure || s === view.baseline);
  if (of.some((s) => s.figure)) return of;
  return view.ranked.filter((s) => view.shown.value.has(s.index));
}

function figuresSection(view, compare) {
  const { hosts, controls } = sampledFigures(view, compare);
  const absent = Object.keys(FIGURE_TITLES).filter((key) => !hosts.has(Number(key)));
  return section("figures", "Figures of the founding paper, on this scene",
    (view.scene.diffuse || []).length > 0 && diffuseFigure(view),
    controls,
    el("div.paper-grid", [...hosts.values()]),
    convergenceFigure(view, paperStrategies(view)),
    absent.length > 0 &&
      el("p.hint",
        "This study did not measure the strategies of: ",
        absent
          .map((number) => `figure ${number} (${FIGURE_TITLES[number][0].toLowerCase()})`)
          .join(", "),
        ".",
      ),
  );
}
