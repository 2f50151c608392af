"use strict";
// Maps of noise, bias and test results over the image, for each strategy.

function relativeDeviation(variance, reference, i) {
  let sum = 0;
  for (let c = 0; c < 3; ++c) {
    const base = reference ? channelAt(reference, i, c) : 1;
    sum += Math.max(0, channelAt(variance, i, c)) / (base * base + 0.01);
  }
  return Math.sqrt(sum / 3);
}

function relativeBias(bias, reference, i) {
  const base = reference ? channelMean(reference, i) : 1;
  return channelMean(bias, i) / Math.sqrt(base * base + 0.01);
}

function sameSize(image, reference) {
  return reference && reference.width === image.width && reference.height === image.height
    ? reference
    : null;
}

// One kind of map for all strategies: {title, legend, cell(strategy)}.
function imageMap(view, { title, key, table, signed, valueAt }) {
  const reference = findImage(view.scene.reference?.image);
  const imageOf = (s) => findImage(s.images?.[key]);
  const at = (image, i) => valueAt(image, sameSize(image, reference), i);
  const top = scaleTop(view.ran.map(imageOf).filter(Boolean), at);
  const toShare = signed ? (x) => 0.5 + (0.5 * x) / top : (x) => x / top;
  const cell = (s) => {
    const image = imageOf(s);
    if (!image) return missingPicture(noMapText(s));
    const { width, height } = image;
    return picture(view, `${title} of ${s.name}`, image, () =>
      rampPixels(width, height, table, (i) => toShare(at(image, i))),
    );
  };
  const ends = signed
    ? [`${MINUS}${fmtShortPercent(top)}`, "0", `+${fmtShortPercent(top)}`]
    : ["0", "", fmtShortPercent(top)];
  return { title, legend: rampLegend(table, ends), cell };
}

function noMapText(strategy) {
  return strategy.level && strategy.level.repetitions < 2
    ? "Needs 2 repetitions or more."
    : "This report does not contain the image.";
}

const TILE_TOP = 5; // |z| at the ends of the colour scale

function tileMap(view) {
  const reference = findImage(view.scene.reference?.image);
  const cell = (s) => {
    if (!s.tiles) return missingPicture("Needs 2 repetitions or more.");
    return tilePicture(view, s, reference);
  };
  return {
    title: "Test of the mean, by tile",
    legend: rampLegend(DIVERGING_TABLE, [`z ${MINUS}${TILE_TOP}`, "0", `+${TILE_TOP}`]),
    cell,
  };
}

function tilePicture(view, s, reference) {
  const { columns, rows, z } = s.tiles;
  // Images of a large study are smaller in the page than in the tiles' pixels.
  const side = s.tiles.side / (view.scene.report_scale || 1);
  const failed = new Set(s.tiles.failed || []);
  // As large as the images, so that the maps lie side by side; the last tiles may be cut.
  const width = reference ? reference.width : columns * side;
  const height = reference ? reference.height : rows * side;
  const zAt = (i) => {
    const column = Math.min(columns - 1, Math.floor((i % width) / side));
    const row = Math.min(rows - 1, Math.floor(i / width / side));
    const value = z[row] ? z[row][column] : null;
    return known(value) ? value : 0;
  };
  const overlay = (context, ratio) => {
    for (const index of failed) {
      const x = (index % columns) * side,
        y = Math.floor(index / columns) * side;
      strokeFrame(
        context,
        { x, y, width: Math.min(side, width - x), height: Math.min(side, height - y) },
        ratio,
      );
    }
  };
  const pixels = () =>
    rampPixels(width, height, DIVERGING_TABLE, (i) => 0.5 + (0.5 * zAt(i)) / TILE_TOP);
  const label = `Test of the mean of ${s.name} by tile: ${failed.size} failed`;
  return el("div",
    picture(view, label, { width, height }, pixels, { overlay }),
    el("div.inset-name",
      failed.size === 0
        ? "no tile differs"
        : `${failed.size} of ${columns * rows} tiles differ`,
    ),
  );
}

function mapsSection(view) {
  if (view.ran.length === 0) return section("maps", "Error maps", el("p", "No strategy ran."));
  const maps = [
    imageMap(view, {
      title: "Standard deviation",
      key: "variance",
      table: SEQUENTIAL_TABLE,
      signed: false,
      valueAt: relativeDeviation,
    }),
    imageMap(view, {
      title: "Bias",
      key: "bias",
      table: DIVERGING_TABLE,
      signed: true,
      valueAt: relativeBias,
    }),
    tileMap(view),
  ];
  const rows = leadingRows(view, view.ranked, (s) =>
    el("div.map-row", { role: "group", "aria-label": s.name },
      el("h3.map-name", strategyLabel(s)),
      maps.map((map) => el("div.map-cell", map.cell(s))),
    ),
  );
  return section("maps", "Error maps",
    el("p.lead",
      "Per pixel and relative to the reference: standard deviation of one render, and bias " +
        "of the mean of all repetitions. All strategies share one colour scale. By tile: " +
        "z-score of the mean against the reference; significantly different tiles are outlined.",
    ),
    el("div.maps",
      el("div.map-row.map-head",
        el("div.map-name"),
        maps.map((map) => el("div.map-cell", el("div.map-title", map.title), map.legend)),
      ),
      rows,
    ),
  );
}
