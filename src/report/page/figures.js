"use strict";
// The founding paper's figures for this scene.

const FIGURE_TITLES = {
  2: ["Uniform sampling", "Directions are drawn uniformly over the hemisphere."],
  3: ["Importance sampling", "Directions follow the scattering function."],
  4: ["Stratified sampling", "The samples of a pixel are spread over strata."],
  5: ["Antithetic variates", "Samples come in pairs that err in opposite directions."],
  6: ["Control variates", "A similar integrand whose integral is known is subtracted."],
  7: ["Russian roulette", "Paths that carry little are ended at random, without bias."],
};

function figureBox(number, title, body, caption) {
  return el(
    "figure",
    { class: "paper", id: `figure-${number}`, "data-figure": number },
    body,
    el("figcaption", {}, el("b", {}, `Figure ${number}. ${title}. `), caption),
  );
}

function tonedPicture(view, image, label, options = {}) {
  return picture(view, {
    label,
    width: image.width,
    height: image.height,
    ...options,
    makePixels: () => tonedPixels(image, view.tone.value),
    redrawOn: view.tone,
  });
}

function diffuseFigure(view) {
  const models = view.scene.diffuse || [];
  if (models.length === 0) {
    return figureBox(
      1,
      "Diffuse models",
      missingPicture("This scene has no diffuse surfaces."),
      null,
    );
  }
  const cells = models.map((model) => {
    const image = findImage(model.image);
    const mean = (model.mean || []).map((x) => fmt(x, 3)).join(", ");
    return el(
      "div",
      {},
      image
        ? tonedPicture(view, image, `The scene with the diffuse model ${model.model}`)
        : missingPicture("This image is not in the report."),
      el(
        "div",
        { class: "under" },
        el("b", {}, model.model),
        ` ${model.meaning || ""}`,
        mean && el("span", { class: "bounds" }, `mean ${mean}`),
      ),
    );
  });
  return figureBox(
    1,
    "Diffuse models",
    el("div", { class: "models" }, cells),
    "The same scene with each model of diffuse scattering.",
  );
}

// The strategy's image with a magnified part, beside that of the baseline and reference.
function strategyFigure(view, number, strategy, inset, compare) {
  const [title, meaning] = FIGURE_TITLES[number];
  const image = findImage(strategy.images && strategy.images.one);
  if (!image) {
    const why = statusWord(strategy)
      ? whyMissing(strategy)
      : "This image is not in the report.";
    return figureBox(number, title, missingPicture(why), [strategy.name, ". ", meaning]);
  }
  const main = tonedPicture(view, image, `${strategy.name}, one repetition`, {
    frame: inset,
  });
  const insets = inset ? insetColumn(view, strategy, image, inset) : null;
  // Widths that make the square insets together as high as the image.
  const parts = insets ? insets.childElementCount : 1;
  main.style.flexGrow = (parts * image.width) / image.height;
  const body = el("div", { class: "with-insets" }, main, insets);
  return figureBox(number, title, body, figureCaption(view, strategy, meaning, compare));
}

function insetColumn(view, strategy, image, inset) {
  const { baseline, scene } = view;
  const sources = [["this", image]];
  if (baseline && baseline.index !== strategy.index && baseline.images) {
    sources.push(["baseline", findImage(baseline.images.one)]);
  }
  sources.push(["reference", findImage(scene.reference && scene.reference.image)]);
  return el(
    "div",
    { class: "insets" },
    sources
      .filter(
        ([, source]) =>
          source && source.width === image.width && source.height === image.height,
      )
      .map(([name, source]) =>
        el(
          "div",
          {},
          tonedPicture(view, source, `Magnified part: ${name}`, { crop: inset }),
          el("div", { class: "inset-name" }, name),
        ),
      ),
  );
}

function figureCaption(view, strategy, meaning, compare) {
  const level = strategy.level;
  const numbers = [
    level && `${fmtCount(level.spp)} spp`,
    level &&
      valueOf(level.relmse) !== null &&
      `relative MSE ${joined(intervalTexts(level.relmse))}`,
    valueOf(strategy.efficiency) !== null &&
      `efficiency ${joined(intervalTexts(strategy.efficiency))}`,
  ]
    .filter(Boolean)
    .join("; ");
  const reference = view.scene.reference && view.scene.reference.image;
  return [
    meaning,
    ` ${strategy.name}: ${numbers || "no numbers"}. `,
    hasImage(reference) &&
      el(
        "button",
        {
          type: "button",
          class: "link",
          onclick: () => compare(strategy.images.one, reference),
        },
        "Compare",
      ),
  ];
}

function orderFigure(view) {
  const rows = view.ranked.filter((s) => valueOf(s.order) !== null);
  const scale = whiskerScale(
    rows.map((s) => s.order),
    false,
    [-0.5],
  );
  if (rows.length === 0) {
    return figureBox(
      8,
      "Convergence rate",
      missingPicture("An order needs at least two sample counts."),
      null,
    );
  }
  const axis = { width: 360, format: fmtShort, most: 6 };
  const body = el(
    "div",
    { class: "orders" },
    el("div", {}),
    el("div", {}, whiskerAxis(scale, axis)),
    el("div", {}),
    rows.map((s) => [
      el("div", { class: "order-name" }, strategyLabel(s)),
      el(
        "div",
        {},
        whisker(s.order, scale, {
          style: s.style,
          width: 360,
          marks: [-0.5],
          label: `Order of ${s.name}`,
        }),
      ),
      el("div", { class: "order-value" }, joined(intervalTexts(s.order))),
    ]),
  );
  return figureBox(
    8,
    "Convergence rate",
    body,
    "Fitted slope of log RMSE over log samples. " +
      "The line at −½ is where independent samples fall; further left converges faster.",
  );
}

function figuresSection(view, compare) {
  const inset = insetWindow(view);
  const numbers = Object.keys(FIGURE_TITLES).map(Number);
  const ofFigure = (number) => {
    const found = view.strategies.find((s) => s.figure === number);
    const twin = found && found.status === "same" && view.strategies[found.same_as];
    return twin ? { ...twin, name: found.name } : found;
  };
  const figures = numbers
    .filter(ofFigure)
    .map((number) => strategyFigure(view, number, ofFigure(number), inset, compare));
  const absent = numbers.filter((number) => !ofFigure(number));
  return section(
    "figures",
    "The paper's figures on this scene",
    diffuseFigure(view),
    el("div", { class: "paper-grid" }, figures),
    orderFigure(view),
    absent.length > 0 &&
      el(
        "p",
        { class: "hint" },
        "Not among the strategies of this study: ",
        absent
          .map((number) => `figure ${number} (${FIGURE_TITLES[number][0].toLowerCase()})`)
          .join(", "),
        ".",
      ),
  );
}
