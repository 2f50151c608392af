"use strict";
// What the comparator says below its controls: the scale of its colours, and the values
// under the pointer.

// The legend of what the panes' colours mean, when they are not the scene's own.
function comparatorScale(comparison) {
  const box = el("div", { class: "scale-box" });
  const update = () => {
    const { curve, exposure } = comparison.view.tone.value;
    box.replaceChildren();
    if (comparison.mode === "difference") {
      const range = fmtShortPercent(Number((2 ** -exposure).toPrecision(2)));
      box.append(
        rampLegend(DIVERGING_TABLE, [
          `${MINUS}${range}: A darker`,
          "0",
          `A brighter: +${range}`,
        ]),
      );
    } else if (curve === "false") {
      const at = (stops) => fmtShort(2 ** (stops - exposure), 2);
      box.append(
        rampLegend(SEQUENTIAL_TABLE, [
          at(-FALSE_STOPS),
          `${at(0)} luminance`,
          at(FALSE_STOPS),
        ]),
      );
    }
  };
  comparison.changed.listen(update);
  comparison.view.tone.listen(update);
  return box;
}

function pixelText(image, x, y) {
  if (!image || x >= image.width || y >= image.height) return UNKNOWN;
  const i = y * image.width + x;
  return [0, 1, 2]
    .map((c) => {
      const value = channelAt(image, i, c);
      return Number.isNaN(value) ? "not a number" : fmt(value, 3);
    })
    .join("  ");
}

function showPixel(comparison, readout, point) {
  const { width, height } = comparison.size;
  const x = point ? Math.floor(point.x) : -1,
    y = point ? Math.floor(point.y) : -1;
  const cells = [
    ["Pixel", UNKNOWN],
    ["A", UNKNOWN],
    ["B", UNKNOWN],
    ["(A − B) / B", UNKNOWN],
  ];
  if (x >= 0 && y >= 0 && x < width && y < height) {
    const a = findImage(comparison.names.a),
      b = findImage(comparison.names.b);
    cells[0][1] = `${x}, ${y}`;
    cells[1][1] = pixelText(a, x, y);
    cells[2][1] = pixelText(b, x, y);
    if (a && b && a.width === b.width && a.height === b.height) {
      cells[3][1] = fmtSignedPercent(relativeDifference(a, b, y * width + x));
    }
  }
  readout.replaceChildren(
    ...cells.map(([name, text]) => el("span", {}, el("b", {}, name), ` ${text}`)),
  );
}
