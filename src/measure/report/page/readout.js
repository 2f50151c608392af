"use strict";
// What the comparator says below its controls: the scale of its colours, and the values
// under the pointer.

// The legend of what the panes' colours mean, when they are not the scene's own.
function comparatorScale(comparison) {
  const box = el("div.scale-box");
  const update = () => {
    const { curve, exposure } = comparison.view.tone.value;
    box.replaceChildren();
    if (comparison.mode === "difference") {
      box.append(differenceLegend(comparison));
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
  const inside = x >= 0 && y >= 0 && x < width && y < height;
  const a = findImage(comparison.names.a),
    b = findImage(comparison.names.b);
  const kind = comparison.kind;
  const values = inside ? differenceValues(comparison) : null;
  const format = kind.percent ? (kind.signed ? fmtSignedPercent : fmtPercent) : fmt;
  const cells = [
    ["Pixel", inside ? `${x}, ${y}` : UNKNOWN],
    ["A", inside ? pixelText(a, x, y) : UNKNOWN],
    ["B", inside ? pixelText(b, x, y) : UNKNOWN],
    [
      kind.signed ? "(A − B) / B" : kind.label,
      values ? format(values.at(y * width + x)) : UNKNOWN,
    ],
  ];
  readout.replaceChildren(
    ...cells.map(([name, text]) => el("span", el("b", name), ` ${text}`)),
  );
}
