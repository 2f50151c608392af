"use strict";
// What files of plots have in common: paper in light colours with title and source, a table,
// and the buttons that save them.

function paperText(x, y, text, attributes = {}) {
  return svg("text", { x, y, fill: theme.color("--text"), ...attributes }, text);
}

// Where the numbers are from.
function sourceLine() {
  const { machine = {}, program } = study;
  const { lanelight, commit } = machine.versions || {};
  return [document.title, lanelight && `lanelight ${lanelight}, commit ${commit}`, program,
          machine.text].filter(Boolean).join("; ");
}

// Styles of the page do not go along: their colours are put into the elements.
function withOwnColors(root) {
  for (const node of root.querySelectorAll("*")) {
    for (const name of ["stroke", "fill"]) {
      const variable = /var\((--[^)]+)\)/.exec(node.style.getPropertyValue(name));
      if (variable) node.setAttribute(name, theme.color(variable[1]));
    }
    node.removeAttribute("style");
    if (node.tagName === "line" && !node.getAttribute("stroke")) {
      node.setAttribute("stroke", theme.color("--faint"));
    }
  }
  return root;
}

// What draw() returns, with theme.color() and styles in light colours meanwhile.
function inLight(draw) {
  const dark = document.documentElement.dataset.theme;
  document.documentElement.dataset.theme = "light";
  try {
    return draw();
  } finally {
    document.documentElement.dataset.theme = dark;
  }
}

function paperSvg({ width, height }, title, drawn) {
  const root = svg("svg",
    {
      width, height, "font-size": 12, viewBox: `0 0 ${width} ${height}`,
      "font-family": "system-ui, 'DejaVu Sans', sans-serif",
    },
    svg("title", title),
    svg("rect", { width, height, fill: "#ffffff" }),
    paperText(20, 30, title, { "font-size": 17, "font-weight": 600 }),
    drawn,
    paperText(20, height - 14, sourceLine(), { fill: theme.color("--muted"), "font-size": 10.5 }),
  );
  return new XMLSerializer().serializeToString(withOwnColors(root));
}

// The columns of `lanelight plot`.
function csvText(rows) {
  const field = (x) => (/[",\n]/.test(x) ? `"${x.replaceAll('"', '""')}"` : x);
  const row = (cells) => cells.map((x) => (known(x) ? x : field(x || ""))).join(",");
  return ["series,quantity,value,low,high,at,at_quantity", ...rows.map(row)].join("\n") + "\n";
}

function save(name, blob) {
  const link = el("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function savePng(name, text) {
  const image = new Image();
  image.onload = () => {
    const canvas = el("canvas", { width: 2 * image.width, height: 2 * image.height });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => save(name, blob));
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
}

// texts: {svg(title), csv()} of what host shows.
function saveButtons(host, title, texts) {
  const name = () => `${document.title} ${host.dataset.plot}`.replace(/[^a-z0-9]+/gi, "-");
  const of = () => `${title}: ${document.title.split(" – ")[0]}`;
  const actions = {
    SVG: () => save(`${name()}.svg`, new Blob([texts.svg(of())], { type: "image/svg+xml" })),
    PNG: () => savePng(`${name()}.png`, texts.svg(of())),
    CSV: () => save(`${name()}.csv`, new Blob([texts.csv()], { type: "text/csv" })),
  };
  return el("span.export", { role: "group", "aria-label": `Save: ${title}` },
    Object.entries(actions).map(([text, act]) =>
      el("button.link", { "data-export": text.toLowerCase(), onclick: act }, text)),
  );
}
