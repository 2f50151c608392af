"use strict";
// Where the two pictures are in the viewer: panes, and the slider between them.

const VIEWS = [["a", "A"], ["b", "B"], ["slider", "Slider"], ["side", "Side by side"]];

// Panes in pixels of style from the upper left corner, of which [from, to) is seen: [{slot,
// left, top, width, height, from, to}]
function panesOf(look, { width, height }) {
  const pane = (slot, left, right, from = left, to = right) => ({
    slot, left, top: 0, width: right - left, height, from, to,
  });
  if (look.view === "side") {
    const half = (width - 2) / 2;
    return [pane(0, 0, half), pane(1, half + 2, width)];
  }
  if (look.view === "slider") {
    const at = look.split * width;
    return [pane(0, 0, width, 0, at), pane(1, 0, width, at, width)];
  }
  return [pane(look.view === "b" ? 1 : 0, 0, width)];
}

function paneBelow(look, box, x) {
  const panes = panesOf(look, box);
  return panes.find((p) => x >= p.from && x < p.to) || panes[panes.length - 1];
}
