"use strict";
// The numbers of the pixel below the pointer: asked for, since half floats are rounded.

class Readout {
  constructor(page, node) {
    Object.assign(this, { page, node, point: null, asked: false });
    this.clear();
  }

  clear() {
    this.node.replaceChildren(
      el("span.note", "Point at the image to see the values of a pixel."),
    );
  }

  // point: of the image, or null.
  follow(point) {
    const { size, hello } = this.page;
    const inside =
      point && point.x >= 0 && point.y >= 0 && point.x < size.width && point.y < size.height;
    this.point = inside
      ? { x: Math.floor(point.x) + hello.x0, y: Math.floor(point.y) + hello.y0 }
      : null;
    if (!this.point) return this.clear();
    this.ask();
  }

  // One question at a time, and no more than some a second.
  ask() {
    if (this.asked || !this.point) return;
    this.asked = true;
    this.page.socket.send({ do: "ask", ...this.point });
  }

  take(answer) {
    if (this.point) this.show(answer);
    setTimeout(() => {
      this.asked = false;
      const { point } = this;
      if (point && (point.x !== answer.x || point.y !== answer.y)) this.ask();
    }, 80);
  }

  // While the picture refines, so do the numbers.
  refresh() {
    this.ask();
  }

  show({ x, y, slots }) {
    const rows = slots.map((pixel, i) => pixel && this.row("AB"[i], pixel));
    this.node.replaceChildren(
      el("span.where", `pixel ${x}, ${y}`),
      ...rows.filter(Boolean),
    );
  }

  row(name, { value, error, samples }) {
    const parts = value.map((v, c) =>
      el(
        "span", { class: `channel channel-${c}` },
        fmt(v, 4), error && el("span.note", `± ${fmt(error[c], 2)}`),
      ),
    );
    return el(
      "span.readout-row", { "data-slot": name },
      el("b", name), parts,
      el("span.note", `${fmtCount(samples)} samples`,
        !error && ", too few for a standard error"),
    );
  }
}
