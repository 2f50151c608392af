"use strict";
// The page of images beside a reference.

// A map that the program made of an image and the reference, in full precision.
function programMap(key, a, b) {
  if (!a || !b || b.name !== study.reference.image) return null;
  const comparison = study.comparisons.find((c) => c.image === a.name);
  return comparison ? findImage(comparison.maps[key]) : null;
}

function mapKind(key, label, title, options = {}) {
  return {
    key,
    label,
    title,
    signed: false,
    percent: false,
    ...options,
    values: (a, b) => {
      const map = programMap(key, a, b);
      return map
        ? { width: map.width, height: map.height, at: (i) => channelAt(map, i, 0) }
        : options.otherwise
          ? options.otherwise(a, b)
          : null;
    },
  };
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
    mapKind("absolute", "Squared error, its root", "√ of mean (A − B)²"),
    mapKind("flip-hdr", "FLIP, all exposures", "FLIP at all exposures", { most: 1 }),
    mapKind("flip-ldr", "FLIP, on screen", "FLIP as the screen shows them", { most: 1 }),
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
    fact("Beyond noise?", { agree: "no", differ: "yes" }[verdict] || "cannot tell",
      known(p) ? `p ${p < 1e-12 ? "" : "= "}${pText(p)}` : why),
  );
}

function verdictSection() {
  return firstSection(`Against ${study.reference.name}`,
    study.comparisons.map((c) => [
      el("p.verdict", `${c.verdict}.`),
      c.invalid_test + c.invalid_reference > 0 &&
        warningBox(null, [
          `${fmtCount(c.invalid_test)} values of the image and ` +
            `${fmtCount(c.invalid_reference)} of the reference are no numbers; they are ` +
            "left out of all means, and shown in magenta.",
        ]),
      verdictFacts(c),
    ]),
    study.report_scale > 1 &&
      el("p.hint",
        `The pictures of this page are smaller by ${study.report_scale}, so that a browser ` +
          "can hold them; the numbers are of all pixels.",
      ),
  );
}

function histogramSection() {
  const all = study.comparisons.map((c, i) => ({
    name: c.test,
    color: `var(${strategyStyle(i).variable})`,
    image: findImage(c.image),
    map: findImage(c.maps.difference),
  }));
  const reference = {
    name: `${study.reference.name} (reference)`,
    color: "var(--text)",
    image: findImage(study.reference.image),
  };
  const key = ({ name, color }) =>
    el("span", el("i.swatch-line", { style: { background: color } }), name);
  const figure = (drawing, caption) =>
    el("figure.paper", drawing, el("figcaption", caption));
  return section("histograms", "Histograms",
    el("div.histogram-key", [reference, ...all].map(key)),
    el("div.histograms",
      figure(
        luminanceHistogram([reference, ...all]),
        "Luminance of the pixels; black ones are in the first bin.",
      ),
      figure(
        differenceHistogram(all.map((one) => ({ ...one, image: one.map }))),
        "Signed relative difference of the pixels; beyond the ends in the last bins.",
      ),
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
