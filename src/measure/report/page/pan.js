"use strict";
// Zoom and pan for panes that show the same part of images of one size.
//
// place: {zoom, x, y}; zoom 1 fits the image into the pane; (x, y) is the image point in
// the middle of the pane, in pixels.

const MAX_ZOOM = 64;

function fitScale(pane, size) {
  return Math.min(pane.clientWidth / size.width, pane.clientHeight / size.height) || 1;
}

function paneScale(pane, size, place) {
  return fitScale(pane, size) * place.zoom;
}

// The image point below a point of the pane, both fractional.
function imagePoint(pane, size, place, clientX, clientY) {
  const box = pane.getBoundingClientRect();
  const scale = paneScale(pane, size, place);
  return {
    x: place.x + (clientX - box.left - box.width / 2) / scale,
    y: place.y + (clientY - box.top - box.height / 2) / scale,
  };
}

function clampPlace(pane, size, place) {
  const zoom = Math.max(1, Math.min(MAX_ZOOM, place.zoom));
  const scale = fitScale(pane, size) * zoom;
  const clampAxis = (centre, extent, available) => {
    const half = Math.min(extent / 2, available / scale / 2);
    return Math.max(half, Math.min(extent - half, centre));
  };
  return {
    zoom,
    x: clampAxis(place.x, size.width, pane.clientWidth),
    y: clampAxis(place.y, size.height, pane.clientHeight),
  };
}

// The place after zooming by `factor` about a point of the pane, which stays where it is.
function zoomAbout(pane, size, place, factor, clientX, clientY) {
  const before = imagePoint(pane, size, place, clientX, clientY);
  const zoomed = { ...place, zoom: Math.max(1, Math.min(MAX_ZOOM, place.zoom * factor)) };
  const after = imagePoint(pane, size, zoomed, clientX, clientY);
  return {
    zoom: zoomed.zoom,
    x: place.x + before.x - after.x,
    y: place.y + before.y - after.y,
  };
}

// handlers: {size(), place(), move(place), hover(point or null), key(name) -> bool}.
function bindPane(view, pane, handlers) {
  bindWheel(pane, handlers);
  bindPointers(pane, handlers);
  bindKeys(pane, handlers);
}

let lastScroll = -1e9;
addEventListener(
  "scroll",
  () => {
    lastScroll = performance.now();
  },
  { passive: true },
);

// A wheel that is scrolling the page goes on doing so over an image, and one that cannot
// zoom out further scrolls: the image is no trap.
function bindWheel(pane, { size, place, move }) {
  pane.addEventListener(
    "wheel",
    (event) => {
      const scrolling = performance.now() - lastScroll < 350;
      if (!event.ctrlKey && (scrolling || (event.deltaY > 0 && place().zoom <= 1)))
        return;
      event.preventDefault();
      const step = event.deltaMode === 1 ? event.deltaY * 30 : event.deltaY;
      const factor = 2 ** Math.max(-1, Math.min(1, -step / 250));
      move(zoomAbout(pane, size(), place(), factor, event.clientX, event.clientY));
    },
    { passive: false },
  );
}

// One pointer drags, two pinch.
function bindPointers(pane, { size, place, move, hover }) {
  const down = new Map();
  const drop = (event) => down.delete(event.pointerId);
  pane.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    pane.setPointerCapture(event.pointerId);
  });
  pane.addEventListener("pointermove", (event) => {
    hover(imagePoint(pane, size(), place(), event.clientX, event.clientY));
    if (!down.has(event.pointerId)) return;
    const before = [...down.values()].map((p) => ({ ...p }));
    Object.assign(down.get(event.pointerId), { x: event.clientX, y: event.clientY });
    move(dragged(pane, size(), place(), before, [...down.values()]));
  });
  pane.addEventListener("pointerup", drop);
  pane.addEventListener("pointercancel", drop);
  pane.addEventListener("pointerleave", () => hover(null));
}

function dragged(pane, size, place, before, after) {
  const middle = (points) => ({
    x: points.reduce((sum, p) => sum + p.x, 0) / points.length,
    y: points.reduce((sum, p) => sum + p.y, 0) / points.length,
  });
  const spread = (points) =>
    points.length < 2
      ? 1
      : Math.max(8, Math.hypot(points[0].x - points[1].x, points[0].y - points[1].y));
  const from = middle(before),
    to = middle(after);
  const scale = paneScale(pane, size, place);
  const moved = {
    ...place,
    x: place.x - (to.x - from.x) / scale,
    y: place.y - (to.y - from.y) / scale,
  };
  return zoomAbout(pane, size, moved, spread(after) / spread(before), to.x, to.y);
}

function bindKeys(pane, { size, place, move, key }) {
  pane.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = 40 / paneScale(pane, size(), place());
    const p = place();
    const moves = {
      ArrowLeft: { x: p.x - step },
      ArrowRight: { x: p.x + step },
      ArrowUp: { y: p.y - step },
      ArrowDown: { y: p.y + step },
      "+": { zoom: p.zoom * 1.5 },
      "=": { zoom: p.zoom * 1.5 },
      "-": { zoom: p.zoom / 1.5 },
      0: { zoom: 1 },
      Home: { zoom: 1 },
    };
    if (moves[event.key]) {
      move({ ...p, ...moves[event.key] });
    } else if (!key(event.key)) {
      return;
    }
    event.preventDefault();
  });
}
