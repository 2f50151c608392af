"use strict";
// The canvas, and what mouse, fingers and keys do to it.

// Shares of the viewer's width that turn the camera by half a circle, and step by keys.
const KEY_TURN = Math.PI / 24;

class Viewer {
  // page: {screen, look, size, hello, onEye(eye), onPoint(point or null), eye}
  constructor(page, canvas) {
    Object.assign(this, { page, canvas, pointers: new Map(), asked: false, after: [] });
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, (event) => this.pointers.delete(event.pointerId));
    }
    canvas.addEventListener("pointerleave", () => page.onPoint(null));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    new ResizeObserver(() => this.redraw()).observe(canvas);
    document.addEventListener("themechange", () => this.redraw());
  }

  box() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return { width, height };
  }

  // then: called when it has been drawn.
  redraw(then) {
    if (then) this.after.push(then);
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.draw();
      for (const call of this.after.splice(0)) call();
    });
  }

  draw() {
    const { look, screen, size } = this.page;
    const box = this.box(),
      ratio = devicePixelRatio;
    if (!size || box.width === 0) return;
    for (const name of ["width", "height"]) {
      const pixels = Math.round(box[name] * ratio);
      if (this.canvas[name] !== pixels) this.canvas[name] = pixels;
    }
    const panes = panesOf(look, box);
    look.place = clampPlace(panes[0], size, look.place);
    const height = box.height * ratio;
    const zoom = paneScale(panes[0], size, look.place) * ratio;
    const parts = panes.map((p) => ({
      slot: p.slot,
      pane: [p.left * ratio, 0, p.width * ratio, height],
      clip: [p.from * ratio, 0, (p.to - p.from) * ratio, height],
    }));
    const place = { ...look.place, zoom };
    screen.draw({ ...look, place, range: this.page.range() || [1, 2] }, parts);
    this.canvas.dataset.zoom = look.place.zoom.toFixed(3);
    this.page.drawPanes(panes, box.width);
  }

  pointOf(event) {
    const { left, top } = this.canvas.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  }

  below(event) {
    const { x, y } = this.pointOf(event);
    const { look, size } = this.page;
    return imagePoint(paneBelow(look, this.box(), x), size, look.place, x, y);
  }

  // The line between two pictures is dragged, too.
  holdsSplit(x) {
    const { look } = this.page;
    return look.view === "slider" && Math.abs(x - look.split * this.box().width) < 10;
  }

  down(event) {
    this.splits = this.holdsSplit(this.pointOf(event).x);
    this.pointers.set(event.pointerId, this.pointOf(event));
    this.canvas.setPointerCapture(event.pointerId);
  }

  move(event) {
    const now = this.pointOf(event);
    this.page.onPoint(this.below(event));
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    if (this.splits) return this.page.onSplit(now.x / this.box().width);
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId);
    this.pointers.set(event.pointerId, now);
    if (others.length > 0) return this.pinch(before, now, others[0][1]);
    const track = event.shiftKey || (event.buttons & 6) !== 0;
    this.drag(now.x - before.x, now.y - before.y, track);
  }

  pinch(before, now, other) {
    const apart = (p) => Math.max(8, Math.hypot(p.x - other.x, p.y - other.y));
    this.zoom(apart(now) / apart(before), (now.x + other.x) / 2, (now.y + other.y) / 2);
  }

  drag(dx, dy, track) {
    const { page } = this;
    const { width, height } = this.box();
    if (page.tool === "pan") {
      const { place } = page.look;
      const zoom = paneScale(panesOf(page.look, this.box())[0], page.size, place);
      page.look.place = { ...place, x: place.x - dx / zoom, y: place.y - dy / zoom };
      return this.redraw();
    }
    const mirrored = page.hello.mirrored;
    const eye = track
      ? tracked(page.eye, mirrored, -dx / height, dy / height)
      : orbited(page.eye, mirrored, (dx / width) * Math.PI, (dy / height) * Math.PI);
    page.onEye(eye);
  }

  zoom(factor, x, y) {
    const { page } = this;
    if (page.tool === "pan") {
      const pane = paneBelow(page.look, this.box(), x);
      page.look.place = zoomAbout(pane, page.size, page.look.place, factor, x, y);
      this.redraw();
    } else {
      page.onEye(dollied(page.eye, 1 / factor));
    }
  }

  // At the edge of what it can do, the wheel scrolls the page.
  wheel(event) {
    const { page } = this;
    const out = event.deltaY > 0;
    if (page.tool === "pan" && out && page.look.place.zoom <= 1) return;
    event.preventDefault();
    const step = event.deltaMode === 1 ? event.deltaY * 30 : event.deltaY;
    const { x, y } = this.pointOf(event);
    this.zoom(2 ** Math.max(-1, Math.min(1, -step / 400)), x, y);
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { width, height } = this.box();
    const turn = KEY_TURN / Math.PI;
    const steps = {
      ArrowLeft: [-turn * width, 0],
      ArrowRight: [turn * width, 0],
      ArrowUp: [0, -turn * height],
      ArrowDown: [0, turn * height],
    };
    const zooms = { "+": 1.25, "=": 1.25, "-": 0.8 };
    if (steps[event.key]) {
      const sign = this.page.tool === "pan" ? -1 : 1;
      this.drag(...steps[event.key].map((x) => sign * x), event.shiftKey);
    } else if (zooms[event.key]) {
      this.zoom(zooms[event.key], width / 2, height / 2);
    } else if (event.key === "0" || event.key === "Home") {
      this.page.onHome();
    } else {
      return;
    }
    event.preventDefault();
  }
}
