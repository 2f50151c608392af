"use strict";
// The tiles that differ most, magnified; and those that differ by more than noise.

// Returns the tile with a margin of half its size, in pixels of the page.
function cropAround(tile, image) {
  const scale = study.report_scale || 1;
  const side = Math.max(tile.width, tile.height) / scale;
  const half = side / 2;
  const extent = (start, size, most) => {
    const from = Math.max(0, Math.floor(start / scale - half));
    return [from, Math.min(most, Math.ceil(start / scale + size / scale + half)) - from];
  };
  const [x, width] = extent(tile.x, tile.width, image.width);
  const [y, height] = extent(tile.y, tile.height, image.height);
  return { x, y, width, height };
}

function worstTile(view, comparison, tile, show) {
  const image = findImage(comparison.image),
    reference = findImage(study.reference.image),
    map = findImage(comparison.maps.difference);
  const crop = cropAround(tile, image);
  const place = {
    zoom: Math.min(image.width / crop.width, image.height / crop.height),
    x: crop.x + crop.width / 2,
    y: crop.y + crop.height / 2,
  };
  const at = `${tile.x}, ${tile.y}`;
  const top = scaleTop([map], (m, i) => channelAt(m, i, 0));
  const difference = () =>
    rampPixels(
      map.width,
      map.height,
      DIVERGING_TABLE,
      (i) => 0.5 + (0.5 * channelAt(map, i, 0) * 2 ** view.tone.value.exposure) / top,
    );
  return el("figure.worst-tile",
    el("div.worst-crops",
      tonedPicture(view, image, `${comparison.test} at ${at}`, { crop }),
      tonedPicture(view, reference, `Reference at ${at}`, { crop }),
      picture(view, `Difference at ${at}`, map, difference, { crop, redrawOn: view.tone }),
    ),
    el("figcaption",
      el("b", fmtPercent(tile.share)),
      ` of the total error, at pixel ${at} (${tile.width} × ${tile.height} pixels). `,
      el("button.link",
        { onclick: () => show(comparison.image, study.reference.image, place) },
        "Show in the viewer above",
      ),
    ),
  );
}

// One comparison's worst tiles, and the map of its test.
function tilesOf(view, comparison, show) {
  const { agreement } = comparison;
  return el("div.tiles-of", { role: "group", "aria-label": comparison.test },
    study.comparisons.length > 1 && el("h3", comparison.test),
    el("div.tiles-columns",
      el("div.worst-tiles",
        comparison.worst_tiles.length === 0
          ? el("p", "No pixel differs.")
          : comparison.worst_tiles.map((tile) => worstTile(view, comparison, tile, show)),
      ),
      agreement.verdict === "cannot tell"
        ? missingPicture(`No test: ${agreement.text}.`)
        : el("div.tile-test",
            tilePicture(
              view,
              { name: comparison.test, tiles: agreement.tiles },
              findImage(study.reference.image),
            ),
            rampLegend(DIVERGING_TABLE, [`z ${MINUS}${TILE_TOP}`, "0", `+${TILE_TOP}`]),
            el("p.hint", `${capitalised(agreement.text)}.`),
            agreement.doubt && el("p.hint", `${capitalised(agreement.doubt)}.`),
          ),
    ),
  );
}

function tilesSection(view, show) {
  return section("tiles", "Tiles with the largest error",
    el("p.lead",
      "Left: the tiles with the largest share of the relative MSE, as image, reference and " +
        "signed relative difference. Right: z-score of each tile's mean against the " +
        "reference; tiles that differ by more than noise are outlined.",
    ),
    study.comparisons.map((comparison) => tilesOf(view, comparison, show)),
  );
}
