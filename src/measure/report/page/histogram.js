"use strict";
// How often values occur: steps over bins, several sorts in one plot.

// Steps of the shares of values in equal bins of {from, to}, with those beyond in the bins at
// the ends; what is not a number is left out. at(i): value of the pixel i of an image.
function histogramPoints(image, at, { from, to }, bins) {
  const counts = new Float64Array(bins);
  for (let i = 0; i < image.width * image.height; ++i) {
    const x = at(image, i);
    if (Number.isNaN(x)) continue;
    const bin = Math.floor(((x - from) / (to - from)) * bins);
    counts[Math.max(0, Math.min(bins - 1, bin))] += 1;
  }
  const total = Math.max(1, counts.reduce((sum, count) => sum + count));
  const edge = (i) => from + (i / bins) * (to - from);
  return [...counts].flatMap((count, i) => {
    const [low, high] = [edge(i), edge(i + 1)];
    return [low, high].map((x) => ({ x, y: count / total, low, high }));
  });
}

// lines: {index, name, style, image}. axis: of x.
function histogramFigure(view, name, title, lines, { at, range, bins, axis }) {
  const { host, figure } = plotFigure(name, title);
  const points = ({ image }) => histogramPoints(image, at, range, bins);
  whenVisible(view, figure, () =>
    showPlot(view, host, {
      lines: lines.map((line) => ({ ...line, steps: true, points: points(line) })),
      label: title,
      xAxis: axis,
      yAxis: { label: "fraction of pixels", ticks: decadeTicks, format: fmtShortPercent },
      scales: (some) => {
        const shares = some.flatMap((line) => line.points.map((p) => p.y));
        const y = { from: 0, to: 1.05 * Math.max(...shares, 1e-9), log: false };
        return { x: range, y };
      },
      describe: (line, { y, low, high }) => noteOf(
        line.name,
        `${fmtPercent(y)} of the pixels from ${axis.format(low)} to ${axis.format(high)}`,
      ),
    }),
  );
  return figure;
}

function luminanceHistogram(view, lines) {
  const stops = (x) => `2${x < 0 ? "⁻" : ""}${superscript(Math.round(x))}`;
  return histogramFigure(view, "luminance",
    "Distribution of luminance (black pixels are in the first bin)", lines, {
      at: (image, i) => Math.log2(luminanceAt(image, i)),
      range: { from: -12, to: 12, log: false },
      bins: 96,
      axis: { label: "luminance (image units)", ticks: () => [-12, -8, -4, 0, 4, 8, 12], format: stops },
    });
}

// Of signed relative differences, to the end of the scale that fits them all.
function differenceHistogram(view, lines) {
  const at = (image, i) => channelAt(image, i, 0);
  const top = scaleTop(lines.map(({ image }) => image), at);
  return histogramFigure(view, "difference",
    "Distribution of the signed relative difference (outliers are in the end bins)", lines, {
      at,
      range: { from: -top, to: top, log: false },
      bins: 81,
      axis: {
        label: "signed relative difference", ticks: roundTicks,
        format: (x) => (x > 0 ? "+" : "") + fmtShortPercent(x),
      },
    });
}
