"use strict";
// What a plot shows, as a file for a paper: SVG, PNG and CSV, with title, legend and source,
// always in light colours. `lanelight plot` draws the same numbers without a browser.

const PAPER = { width: 960, height: 540 },
  DRAWING = { width: 640, height: 452, top: 46 };
const COPIED = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray",
                "opacity", "display", "overflow", "font-size", "font-weight"];

// Where the numbers are from.
function sourceLine() {
  const { machine = {}, program } = study;
  const { lanelight, commit } = machine.versions || {};
  const version = lanelight && `lanelight ${lanelight}, commit ${commit}`;
  return [document.title, version, program, machine.text].filter(Boolean).join("; ");
}

// The names, and beside them the intervals that the plot has for its lines, if any.
function paperLegend(lines, beside) {
  const left = DRAWING.width + 16,
    top = DRAWING.top + 10;
  const pitch = Math.min(24, 400 / Math.max(1, lines.length));
  const place = (i) => top + pitch * (i + 0.5);
  const scale = beside && whiskerScale(lines.map(beside.of), false, beside.marks);
  const interval = (line) =>
    whisker(beside.of(line), scale, { ...beside, style: line.style, width: 130 });
  return [
    lines.map((line, i) => [
      setAttributes(swatch(line.style), { x: left, y: place(i) - 6 }),
      svg("text", { x: left + 40, y: place(i) + 4 }, shortName(line.name)),
      scale && setAttributes(interval(line), { x: left + 164, y: place(i) - 13 }),
    ]),
    scale &&
      setAttributes(whiskerAxis(scale, { width: 130, most: 3 }), { x: left + 164, y: top - 26 }),
  ];
}

function paperSvg({ options, lines, frame }, title) {
  const { width, height } = PAPER;
  const { node } = drawPlot(DRAWING, options, lines, frame.scales);
  return svg("svg.on-paper", { width, height, viewBox: `0 0 ${width} ${height}` },
    svg("title", title),
    svg("rect", { width, height, style: { fill: "#ffffff" } }),
    svg("text.paper-title", { x: 20, y: 30 }, title),
    setAttributes(node, { y: DRAWING.top }),
    paperLegend(lines, options.beside),
    svg("text.note", { x: 20, y: height - 14 }, sourceLine()),
  );
}

// Styles of the page do not go along: each element gets its own, in light colours.
function standaloneText(root) {
  const { dataset } = document.documentElement;
  const before = dataset.theme;
  dataset.theme = "light";
  document.body.append(root);
  for (const node of [root, ...root.querySelectorAll("*")]) {
    const style = getComputedStyle(node);
    for (const name of COPIED) node.setAttribute(name, style.getPropertyValue(name));
    node.removeAttribute("style");
  }
  root.remove();
  dataset.theme = before;
  root.setAttribute("font-family", "system-ui, 'DejaVu Sans', sans-serif");
  return new XMLSerializer().serializeToString(root);
}

// The columns of `lanelight plot`.
function csvText({ options, lines }) {
  const { xAxis, yAxis, beside } = options;
  const rows = lines.flatMap(({ name, points }) =>
    points.map(({ x, y, low, high }) => [name, yAxis.label, y, low, high, x, xAxis.label]));
  const besides = (beside ? lines : []).map((line) => {
    const { value, low, high } = beside.of(line) || {};
    return [line.name, beside.label, value, low, high, "", ""];
  });
  const field = (x) => (/[",\n]/.test(x) ? `"${x.replaceAll('"', '""')}"` : x);
  const text = (cells) => cells.map((x) => (known(x) ? x : field(x || ""))).join(",");
  return `series,quantity,value,low,high,at,at_quantity
${[...rows, ...besides].map(text).join("\n")}
`;
}

function savePng(name, text) {
  const image = new Image();
  image.onload = () => {
    const canvas = el("canvas", { width: 2 * image.width, height: 2 * image.height });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => saveFile(name, blob));
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
}

// Buttons for the plot that host shows; hidden while it shows none (plots.css).
function exportButtons(host, title) {
  const name = () => `${document.title} ${host.dataset.plot}`.replace(/[^a-z0-9]+/gi, "-");
  const drawing = () =>
    standaloneText(paperSvg(host.plot, `${title}: ${document.title.split(" – ")[0]}`));
  const actions = {
    SVG: () => saveFile(`${name()}.svg`, new Blob([drawing()], { type: "image/svg+xml" })),
    PNG: () => savePng(`${name()}.png`, drawing()),
    CSV: () => saveFile(`${name()}.csv`, new Blob([csvText(host.plot)], { type: "text/csv" })),
  };
  return el("span.export", { role: "group", "aria-label": `Save: ${title}` },
    Object.entries(actions).map(([text, act]) =>
      el("button.link", { "data-export": text.toLowerCase(), onclick: act }, text)),
  );
}
