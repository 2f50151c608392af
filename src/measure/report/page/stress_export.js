"use strict";
// The plot of a map as a file for a paper: as it is shown, with the names of its curves.

const ABOVE = 48, BELOW = 34, NAMES = 24; // pixels beside the plot; of a name
const COPIED = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray",
                "stroke-opacity", "opacity", "display", "font-size", "font-weight"];

// A copy that does not need the page's styles.
function standalone(shown) {
  const copy = shown.cloneNode(true);
  const nodes = [shown, ...shown.querySelectorAll("*")];
  [copy, ...copy.querySelectorAll("*")].forEach((node, i) => {
    const style = getComputedStyle(nodes[i]);
    for (const name of COPIED) node.setAttribute(name, style.getPropertyValue(name));
    node.removeAttribute("style");
  });
  return copy;
}

function mapSvgText({ lines }, host, title) {
  return inLight(() => {
    const plot = standalone(host.querySelector("svg"));
    const width = Number(plot.getAttribute("width")), height = Number(plot.getAttribute("height"));
    setAttributes(plot, { y: ABOVE });
    const names = lines.map((line, i) => {
      const mark = swatch(line.style);
      setAttributes(mark, { x: 20, y: ABOVE + height + NAMES * (i + 0.5) - 6 });
      return [mark, paperText(62, ABOVE + height + NAMES * (i + 0.5) + 4, line.name)];
    });
    const size = { width: Math.max(width, 560),
                   height: ABOVE + height + NAMES * lines.length + BELOW };
    return paperSvg(size, title, [plot, names]);
  });
}

function mapCsvText({ drawn, label, aCase }) {
  return csvText(drawn.flatMap(({ line, points }) => points.map((p) =>
    [line.name, label, p.value, p.low, p.high, p.point.parameter, aCase.axis.name])));
}

function mapSaveButtons(host, title) {
  return saveButtons(host, title, {
    svg: (title) => mapSvgText(host.drawn, host, title),
    csv: () => mapCsvText(host.drawn),
  });
}
