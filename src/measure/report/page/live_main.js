"use strict";
// The page: what it knows, and what comes in by the socket.

const page = {
  look: { view: "a", split: 0.5, exposure: 0, curve: "srgb", layer: COLOUR,
          place: { x: 0, y: 0, zoom: 1 } },
  tool: "camera",
  paused: false,
  pace: "time",

  // [low, high] of the layer's colours, the same for both slots; null while it is not known.
  range() {
    const { slots } = this.screen;
    if (this.look.layer === SAMPLES) return [1, Math.max(2, ...slots.map((s) => s.most))];
    return layerRange(slots.map((s) => s.values));
  },

  onPoint(point) {
    this.readout.follow(point);
  },
  onEye(eye) {
    this.eye = eye;
    this.showEye(eye);
    this.sender.move(eye);
  },
  onHome() {
    this.look.place = { x: 0, y: 0, zoom: 1 };
    this.viewer.redraw();
    if (this.tool === "camera") this.onEye(this.hello.eye);
  },
  onStrategy(slot, name) {
    this.screen.forget(slot);
    this.socket.send({ do: "strategy", slot, name });
    if (slot === 1 && name === "") this.showView("a");
    this.viewer.redraw();
  },
};

function build(hello) {
  const canvas = el("canvas#picture", { tabindex: 0, "data-tool": "camera", "aria-label":
      "Rendered image. Arrow keys turn the camera, with shift they move it, plus and minus " +
      "zoom, 0 resets" });
  const readout = el("div#readout");
  page.screen = new Screen(canvas);
  page.screen.reset(page.size);
  page.viewer = new Viewer(page, canvas);
  page.readout = new Readout(page, readout);
  page.cards = [new StrategyCard(page, 0, "default"), new StrategyCard(page, 1, "")];
  page.stages = new Stages();
  page.score = el("div#score", { hidden: true });
  page.plot = el("div#error-plot", { hidden: true });
  const viewer = el("section#viewer", { "aria-label": "Image" },
    viewBar(page), pictureBox(page, canvas), readout, toneBar(page), cameraBar(page));
  const side = el("div.live-side",
    section("compare", "Compare strategies A and B", page.cards.map((card) => card.node), paceButtons(page),
      page.score, page.plot),
    section("figures", "Comparisons from the founding paper", presetButtons(page, page.cards)),
    section("take", "Save and copy", saveBar(page)));
  const stages = section("stages", "Processor time by stage", page.stages.node);
  document.getElementById("content").replaceChildren(el("div.live", viewer, side, stages));
  canvas.style.aspectRatio = `${page.size.width} / ${page.size.height}`;
  linkSections([["viewer", "Image"], ["compare", "Compare"],
    ["figures", "Figures"], ["take", "Files"], ["stages", "Stages"]]);
  const name = hello.scene.split("/").slice(-2).join("/");
  document.getElementById("scenes").append(el("span.tab", name));
  document.title = `${name} – Lanelight live`;
  document.getElementById("bottom").textContent =
    `${hello.version}, ${hello.threads} thread${hello.threads === 1 ? "" : "s"}, ${hello.target}. ` +
    `Scene loading took ${fmtSeconds(hello.load_seconds)}, the BVH build ${fmtSeconds(hello.build_seconds)}.`;
}

function explain(message) {
  document.getElementById("content").replaceChildren(el("p.wait", message));
}

const handlers = {
  hello(hello) {
    page.hello = hello;
    page.eye = hello.eye;
    page.size = { width: hello.width, height: hello.height };
    page.look.place = { x: hello.width / 2, y: hello.height / 2, zoom: 1 };
    page.stem = hello.scene.split("/").pop().replace(/\.pbrt$/, "");
    page.sender = new EyeSender(page.socket);
    try {
      build(hello);
    } catch (error) {
      explain(`The image cannot be shown: ${error.message}. This page needs WebGL 2.`);
      page.socket.end();
      return;
    }
    page.socket.send({ do: "strategy", slot: 0, name: "default" });
  },
  picture(head, buffer, at) {
    page.screen.take(head, buffer, at);
    page.viewer.redraw(() => {
      page.socket.send({ do: "seen", what: head.slot });
      page.drawLegend();
      page.sender.arrived();
      page.readout.refresh();
      document.body.dataset.pictures = Number(document.body.dataset.pictures || 0) + 1;
    });
  },
  state(state) {
    page.state = state;
    page.socket.send({ do: "seen", what: 2 });
    state.slots.forEach((slot, i) => page.cards[i].show(slot));
    drawScore(page.score, state);
    drawErrorPlot(page.plot, state);
    page.stages.show(state);
  },
  pixel: (answer) => page.readout.take(answer),
  refused: ({ text }) => page.say(`Refused: ${text}`),
  "camera-text": (message) => page.takeCameraText(message),
  file: (head, buffer, at) => page.takeFile(head, buffer, at),
  goodbye() {},
  closed(said) {
    document.body.classList.add("closed");
    const text = said
      ? "lanelight has exited. The last image stays here until you close the page."
      : "The connection was lost. Check that `lanelight live` is running, then reload the page.";
    document.body.append(el("div#closed", { role: "alert" }, text));
  },
};

page.socket = openSocket(handlers);
