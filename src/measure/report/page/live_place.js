"use strict";
// What of the image is seen, and where: panes, zoom, the slider between two pictures.

const VIEWS = [["a", "A"], ["b", "B"], ["slider", "Slider"], ["side", "Side by side"]];
const MOST_ZOOM = 64;

// Panes in pixels of style from the upper left corner: [{slot, x, width, from, to}], of
// which [from, to) is seen.
function panesOf(look, width) {
  if (look.view === "side") {
    const half = (width - 2) / 2;
    return [
      { slot: 0, x: 0, width: half, from: 0, to: half },
      { slot: 1, x: half + 2, width: half, from: half + 2, to: width },
    ];
  }
  const whole = (slot, from, to) => ({ slot, x: 0, width, from, to });
  if (look.view === "slider") {
    const at = look.split * width;
    return [whole(0, 0, at), whole(1, at, width)];
  }
  return [whole(look.view === "b" ? 1 : 0, 0, width)];
}

// Pixels of style per pixel of the image at zoom 1: all of it is seen.
function fitOf(pane, height, size) {
  return Math.min(pane.width / size.width, height / size.height) || 1;
}

// The point of the image below one of the viewer, {x, y}; both may be fractions.
function pointBelow(look, box, size, x, y) {
  const panes = panesOf(look, box.width);
  const pane = panes.find((p) => x >= p.from && x < p.to) || panes[panes.length - 1];
  const zoom = fitOf(pane, box.height, size) * look.place.zoom;
  return {
    x: look.place.x + (x - pane.x - pane.width / 2) / zoom,
    y: look.place.y + (y - box.height / 2) / zoom,
    zoom,
  };
}

// The image stays in the pane.
function heldPlace(look, box, size) {
  const pane = panesOf(look, box.width)[0];
  const zoom = Math.max(1, Math.min(MOST_ZOOM, look.place.zoom));
  const scale = fitOf(pane, box.height, size) * zoom;
  const hold = (middle, extent, room) => {
    const half = Math.min(extent / 2, room / scale / 2);
    return Math.max(half, Math.min(extent - half, middle));
  };
  return {
    zoom,
    x: hold(look.place.x, size.width, pane.width),
    y: hold(look.place.y, size.height, box.height),
  };
}

// Zoomed by `factor` about a point of the viewer, which stays where it is.
function zoomedPlace(look, box, size, factor, x, y) {
  const before = pointBelow(look, box, size, x, y);
  const zoom = Math.max(1, Math.min(MOST_ZOOM, look.place.zoom * factor));
  const after = pointBelow({ ...look, place: { ...look.place, zoom } }, box, size, x, y);
  return {
    zoom,
    x: look.place.x + before.x - after.x,
    y: look.place.y + before.y - after.y,
  };
}
