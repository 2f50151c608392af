"use strict";
// Zoom and pan for panes that show the same part of images of one size, by wheel, pointers
// and keys.

// handlers: {size(), place(), move(place), hover(point or null), key(name) -> bool}.
function bindPane(pane, handlers) {
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
      const { clientX, clientY } = event;
      move(zoomAbout(boxOf(pane), size(), place(), factor, clientX, clientY));
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
    hover(imagePoint(boxOf(pane), size(), place(), event.clientX, event.clientY));
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
  const scale = paneScale(boxOf(pane), size, place);
  const moved = {
    ...place,
    x: place.x - (to.x - from.x) / scale,
    y: place.y - (to.y - from.y) / scale,
  };
  const factor = spread(after) / spread(before);
  return zoomAbout(boxOf(pane), size, moved, factor, to.x, to.y);
}

function bindKeys(pane, { size, place, move, key }) {
  pane.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = 40 / paneScale(boxOf(pane), size(), place());
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
