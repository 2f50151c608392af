"use strict";
// The bars above and below the picture: which one, how bright, what lies over it, the
// camera's numbers.

function viewBar(page) {
  const { look } = page;
  const split = slider("Slider", {
    id: "split", min: 0, max: 1, step: 0.005, value: look.split,
    text: (x) => `${Math.round(100 * x)} %`,
    onInput: (x) => {
      look.split = x;
      page.viewer.redraw();
    },
  });
  page.onSplit = (x) => {
    look.split = Math.max(0, Math.min(1, x));
    split.set(look.split);
    page.viewer.redraw();
  };
  const follow = () => {
    split.node.hidden = look.view !== "slider";
    page.viewer.redraw();
  };
  split.node.hidden = true;
  const views = choiceButtons("Image shown", VIEWS, look.view, (view) => {
    look.view = view;
    follow();
  });
  page.showView = (view) => {
    look.view = view;
    for (const button of views.children) {
      button.setAttribute("aria-pressed", String(button.dataset.value === view));
    }
    follow();
  };
  const tools = choiceButtons("Drag moves",
    [["camera", "Move camera"], ["pan", "Pan image"]],
    page.tool,
    (tool) => {
      page.tool = tool;
      page.viewer.canvas.dataset.tool = tool;
    },
  );
  tools.id = "tools";
  views.id = "views";
  const pause = el("button#pause.button", "Pause");
  pause.addEventListener("click", () => {
    page.paused = !page.paused;
    pause.textContent = page.paused ? "Resume" : "Pause";
    page.socket.send({ do: "pause", on: page.paused });
  });
  return el("div.live-bar", views, tools, pause, split.node);
}

// The canvas with a line between two pictures, and what they are called.
function pictureBox(page, canvas) {
  const line = el("div.split-line", { hidden: true });
  const labels = [0, 1].map((slot) => el("span.pane-label", "AB"[slot]));
  page.drawPanes = (panes, width) => {
    line.hidden = page.look.view !== "slider";
    line.style.left = `${100 * page.look.split}%`;
    labels.forEach((label, slot) => {
      const pane = panes.find((p) => p.slot === slot && p.to - p.from > 24);
      label.hidden = !pane;
      if (!pane) return;
      const right = page.look.view === "slider" && slot === 1;
      label.style.left = right ? "auto" : `${pane.from + 8}px`;
      label.style.right = right ? `${width - pane.to + 8}px` : "auto";
    });
  };
  return el("div.picture-box", canvas, line, labels);
}

function layerMenu(page) {
  const layers = page.hello.layers.map(({ name, meaning }) => [name, meaning]);
  layers.splice(3, 0, [SAMPLES, "samples per pixel"]);
  const names = {
    colour: "Image", error: "Standard error", relative: "Relative error",
    samples: "Samples per pixel", rays: "Rays per sample", depth: "Path length",
  };
  const legend = el("div#legend", { hidden: true });
  page.drawLegend = () => drawLegend(page, legend, layers);
  const choose = menu(
    "Show", { id: "layer" }, layers.map(([name]) => [name, names[name]]), COLOUR,
    (name) => {
      page.look.layer = name;
      page.socket.send({ do: "layer", name: name === SAMPLES ? COLOUR : name });
      page.viewer.redraw(page.drawLegend);
    },
  );
  return [choose, legend];
}

function drawLegend(page, legend, layers) {
  const { layer } = page.look;
  legend.hidden = layer === COLOUR;
  if (legend.hidden) return;
  const meaning = layers.find(([name]) => name === layer)[1];
  const note = (text) => el("span.note", `${meaning}${text}`);
  const range = page.range();
  if (!range) return legend.replaceChildren(note(": no data yet"));
  const format = layer === RELATIVE ? (x) => `${fmt(100 * x, 2)} %` : (x) => fmt(x, 2);
  const [low, high] = range.map(format);
  const whole = layer === SAMPLES;
  legend.replaceChildren(
    el("span", whole ? low : `≤ ${low}`),
    el("span.ramp", { "aria-hidden": "true" }),
    el("span", whole ? high : `≥ ${high}`),
    note(whole
      ? "; logarithmic scale; grey: no data yet"
      : `; logarithmic scale from the ${LOW_PERCENTILE}th to the ${HIGH_PERCENTILE}th ` +
        "percentile of the pixels; grey: no data yet"),
  );
}

function toneBar(page) {
  const exposure = slider("Exposure", {
    id: "exposure", min: -8, max: 8, step: 0.25, value: 0,
    text: (x) => `${fmtSigned(x, 3)} stops`,
    onInput: (x) => {
      page.look.exposure = x;
      page.viewer.redraw();
    },
  });
  const curve = menu("Tone", { id: "curve" }, TONE_OPTIONS, page.look.curve, (name) => {
    page.look.curve = name;
    page.viewer.redraw();
  });
  return el("div.live-bar", exposure.node, curve, layerMenu(page));
}

// Sliders of the lens; the mouse does the rest.
function cameraBar(page) {
  const { eye } = page.hello;
  const change = (part) => page.onEye({ ...page.eye, ...part });
  const size = vec.length(vec.sub(eye.target, eye.position));
  const stops = (x) => Math.log2(x / size);
  const fov = slider("Field of view", {
    id: "fov", min: 5, max: 150, step: 0.5, value: eye.fov,
    text: (x) => `${fmtShort(x)}°`, onInput: (x) => change({ fov: x }),
  });
  const lens = slider("Lens radius", {
    id: "lens", min: 0, max: 0.2, step: 0.001, value: eye.lens / size,
    text: (x) => fmt(x * size), onInput: (x) => change({ lens: x * size }),
  });
  const focus = slider("Focus distance", {
    id: "focus", min: -4, max: 4, step: 0.02, value: stops(eye.focus),
    text: (x) => fmt(size * 2 ** x), onInput: (x) => change({ focus: size * 2 ** x }),
  });
  const home = el("button#home.button", "Reset camera");
  home.addEventListener("click", () => page.onHome());
  page.showEye = (now) => {
    fov.set(now.fov);
    lens.set(now.lens / size);
    focus.set(stops(now.focus));
  };
  const has = { fov: page.hello.camera === "perspective" };
  const thin = has.fov || page.hello.camera === "orthographic";
  return el(
    "div.live-bar", has.fov && fov.node, thin && lens.node, thin && focus.node, home,
  );
}
