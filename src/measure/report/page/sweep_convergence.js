"use strict";
// How errors fall with samples: a table of the curves, those with a cause first.

const curves = study.convergence || [];

// The values of a curve that differ between the cells.
function curveName({ values }) {
  const texts = varyingAxes
    .filter((axis) => axis.name !== "spp" && values[axis.name] !== undefined)
    .map((axis) => valueLabel(axis, values[axis.name]));
  return texts.join(", ") || values.scene;
}

function pixelTexts({ pixels }) {
  return pixels.map(({ x, y, share }) => `(${x}, ${y}) ${fmtPercent(share, 2)}`).join(", ");
}

function convergenceColumns() {
  return [
    textColumn("curve", "Curve", curveName),
    intervalColumn("order", "Order", (c) => c.order, intervalTexts,
      { hint: "The relative MSE falls as N to the power of minus this; 1: independent samples" }),
    numberColumn("from", "1/N until", (c) => c.from, fmtCount,
      { unit: "spp", hint: "From this count on, the error falls more slowly than 1/N" }),
    textColumn("cause", "Cause", (c) => c.cause || (c.fall === "undecided" ? c.fall : "")),
    numberColumn("rounding", "Rounding", (c) => c.rounding, fmtShort,
      { unit: "relative MSE", hint: "What the precision of the image file costs" }),
    numberColumn("worst", "Worst 0.1 %", (c) => c.worst_share, fmtPercent,
      { unit: "of the error", descendingFirst: true }),
    numberColumn("percent", "Worst 1 %", (c) => c.percent_share, fmtPercent,
      { unit: "of the error", descendingFirst: true }),
    numberColumn("repeated", "Repeated", (c) => c.repeated, fmtPercent,
      { hint: "Fraction of the error of the worst 1 % of the pixels that both halves of the seeds have in common" }),
    textColumn("pixels", "Worst pixels (x, y)", pixelTexts),
  ];
}

function convergenceSection() {
  if (curves.length === 0) return null;
  const blamed = curves.filter((c) => c.cause);
  const rows = [...blamed, ...curves.filter((c) => !c.cause)];
  return section("convergence", "Error against samples",
    el("p.lead",
      blamed.length === 0
        ? "No error falls significantly more slowly than 1/N. "
        : `Of ${curves.length} errors, ${blamed.length} fall more slowly than 1/N, or may because of heavy tails. `,
      "Errors are distances between the images of different seeds; shares are those at the " +
        "largest count.",
    ),
    el("ul", blamed.slice(0, 10).map((c) => el("li", `${curveName(c)}: ${c.text}.`))),
    sortableTable({
      columns: convergenceColumns(), rows, caption: "Errors against samples", most: 200,
    }),
  );
}
