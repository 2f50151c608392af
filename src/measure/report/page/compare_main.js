"use strict";
// The page of images beside a reference.

// A map that the program made of an image and the reference, in full precision.
function programMap(key, a, b) {
  if (!a || !b || b.name !== study.reference.image) return null;
  const comparison = study.comparisons.find((c) => c.image === a.name);
  return comparison ? findImage(comparison.maps[key]) : null;
}

function mapKind(key, label, title, { otherwise = () => null, ...more } = {}) {
  const values = (a, b) => {
    const map = programMap(key, a, b);
    if (!map) return otherwise(a, b);
    return { width: map.width, height: map.height, at: (i) => channelAt(map, i, 0) };
  };
  return { key, label, title, signed: false, percent: false, ...more, values };
}

function differenceKinds() {
  const kinds = [
    mapKind("difference", SIGNED_DIFFERENCE.label, SIGNED_DIFFERENCE.title, {
      signed: true,
      percent: true,
      otherwise: SIGNED_DIFFERENCE.values,
    }),
    mapKind("relative", "Relative error", "√ of mean (A − B)² / (B² + 0.01)", {
      percent: true,
    }),
    mapKind("absolute", "RMSE", "√ of mean (A − B)²"),
    mapKind("flip-hdr", "FLIP, all exposures", "FLIP at all exposures", { most: 1 }),
    mapKind("flip-ldr", "FLIP, displayed range", "FLIP of the displayed (clamped) images", { most: 1 }),
  ];
  return kinds.filter((kind) => study.comparisons.some((c) => c.maps[kind.key]));
}

function imagesToChoose() {
  const there = (group, label, name) => ({ group, label, name, there: hasImage(name) });
  return [
    there("", `${study.reference.name} (reference)`, study.reference.image),
    ...study.comparisons.map((c) => there("Images", c.test, c.image)),
  ];
}

function verdictFacts(c) {
  const { verdict, p, why } = c.agreement;
  const flip = c.flip && (c.flip.hdr || c.flip.ldr);
  return el("dl.facts",
    fact("Relative error", fmtPercent(Math.sqrt(c.relmse)), `relative MSE ${fmt(c.relmse)}`),
    flip && fact("FLIP", fmt(flip.mean), `largest ${fmt(flip.max)}`),
    fact("PSNR", known(c.psnr) ? `${fmt(c.psnr)} dB` : "no difference"),
    fact("Significant difference", { agree: "no", differ: "yes" }[verdict] || "unknown",
      known(p) ? `p ${p < 1e-12 ? "" : "= "}${pText(p)}` : why),
  );
}

function verdictSection() {
  return firstSection(`Difference from ${study.reference.name}`,
    study.comparisons.map((c) => [
      el("p.verdict", `${c.verdict}.`),
      c.invalid_test + c.invalid_reference > 0 &&
        warningBox(null, [
          `${fmtCount(c.invalid_test)} values of the image and ` +
            `${fmtCount(c.invalid_reference)} of the reference are not finite numbers. All ` +
            "means exclude them; the images show them in magenta.",
        ]),
      verdictFacts(c),
    ]),
    study.report_scale > 1 &&
      el("p.hint",
        `The images on this page are scaled down by a factor of ${study.report_scale}. The ` +
          "numbers use all pixels.",
      ),
  );
}

function histogramSection() {
  const { comparisons, reference } = study;
  const lines = comparisons.map((c, index) => ({
    index, name: c.test, style: strategyStyle(index), status: "ok",
    image: findImage(c.image), map: findImage(c.maps.difference),
  }));
  const own = {
    index: lines.length, name: `${reference.name} (reference)`, status: "ok",
    style: { variable: "--text", dash: [], marker: "plus" },
    image: findImage(reference.image),
  };
  const view = linesView([...lines, own]);
  return section("histograms", "Histograms",
    strategyLegend(view, "Images shown"),
    el("div.plots.many",
      luminanceHistogram(view, [own, ...lines]),
      differenceHistogram(view, lines.map((line) => ({ ...line, image: line.map }))),
    ),
  );
}

function start() {
  startPage({
    title: `${study.reference.name} – Lanelight compare`,
    footer:
      "Written by lanelight compare. This page holds all its numbers and images and needs " +
      "no network.",
    sections: [
      ["summary", "Verdict"],
      ["compare", "Images"],
      ["tiles", "Tiles"],
      ["histograms", "Histograms"],
      ["numbers", "Numbers"],
    ],
  });
  const view = makeView({ report_scale: study.report_scale });
  const comparator = comparatorSection(view, imagesToChoose(), differenceKinds());
  const show = (a, b, place) => {
    view.compare.set({ a, b, place });
    comparator.scrollIntoView();
  };
  showContent(
    verdictSection(),
    comparator,
    tilesSection(view, show),
    histogramSection(),
    numbersSection(),
  );
}

start();
