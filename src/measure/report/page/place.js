"use strict";
// What part of an image a pane shows.
//
// place: {zoom, x, y}; zoom 1 fits the image into the pane; (x, y) is the image point in
// the middle of the pane, in pixels. pane: {left, top, width, height} where points are
// measured; size: {width, height} of the image.

const MAX_ZOOM = 64;

function boxOf(node) {
  return node.getBoundingClientRect();
}

function fitScale(pane, size) {
  return Math.min(pane.width / size.width, pane.height / size.height) || 1;
}

function paneScale(pane, size, place) {
  return fitScale(pane, size) * place.zoom;
}

// The image point below a point of the pane, both fractional.
function imagePoint(pane, size, place, x, y) {
  const scale = paneScale(pane, size, place);
  return {
    x: place.x + (x - pane.left - pane.width / 2) / scale,
    y: place.y + (y - pane.top - pane.height / 2) / scale,
  };
}

function heldZoom(zoom) {
  return Math.max(1, Math.min(MAX_ZOOM, zoom));
}

// The image stays in the pane.
function clampPlace(pane, size, place) {
  const zoom = heldZoom(place.zoom);
  const scale = fitScale(pane, size) * zoom;
  const clampAxis = (centre, extent, available) => {
    const half = Math.min(extent / 2, available / scale / 2);
    return Math.max(half, Math.min(extent - half, centre));
  };
  return {
    zoom,
    x: clampAxis(place.x, size.width, pane.width),
    y: clampAxis(place.y, size.height, pane.height),
  };
}

// The place after zooming by `factor` about a point of the pane, which stays where it is.
function zoomAbout(pane, size, place, factor, x, y) {
  const before = imagePoint(pane, size, place, x, y);
  const zoom = heldZoom(place.zoom * factor);
  const after = imagePoint(pane, size, { ...place, zoom }, x, y);
  return { zoom, x: place.x + before.x - after.x, y: place.y + before.y - after.y };
}
