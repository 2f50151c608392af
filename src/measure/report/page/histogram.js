"use strict";
// How often values occur: steps over bins, several sorts in one plot.

// Shares of the values of at(0 ... count - 1) in equal bins of [low, high], with those
// beyond in the bins at the ends; what is not a number is left out.
function histogramShares(at, count, { low, high, bins }) {
  const shares = new Float64Array(bins);
  let total = 0;
  for (let i = 0; i < count; ++i) {
    const x = at(i);
    if (Number.isNaN(x)) continue;
    const bin = Math.floor(((x - low) / (high - low)) * bins);
    shares[Math.max(0, Math.min(bins - 1, bin))] += 1;
    ++total;
  }
  return shares.map((x) => x / Math.max(1, total));
}

const HISTOGRAM_WIDTH = 560,
  HISTOGRAM_HEIGHT = 170,
  HISTOGRAM_FOOT = 22;

function histogramLine(shares, top) {
  const x = (i) => ((i / shares.length) * HISTOGRAM_WIDTH).toFixed(1);
  const y = (share) => (HISTOGRAM_HEIGHT * (1 - share / top)).toFixed(1);
  const steps = [...shares].map((share, i) => `V${y(share)}H${x(i + 1)}`);
  return `M0,${HISTOGRAM_HEIGHT}${steps.join("")}V${HISTOGRAM_HEIGHT}`;
}

// series: [{name, color, shares}]; marks: [[position from 0 to 1, text]].
function histogram(label, series, marks) {
  const top = Math.max(...series.flatMap((s) => [...s.shares]), 1e-9);
  const line = (at) =>
    svg("line.tick", { x1: at, x2: at, y1: 0, y2: HISTOGRAM_HEIGHT + 4 });
  const anchor = (at) => (at < 0.05 ? "start" : at > 0.95 ? "end" : "middle");
  return svg("svg.histogram",
    {
      role: "img", "aria-label": label,
      viewBox: `0 0 ${HISTOGRAM_WIDTH} ${HISTOGRAM_HEIGHT + HISTOGRAM_FOOT}`,
    },
    marks.map(([at]) => line(at * HISTOGRAM_WIDTH)),
    marks.map(([at, text]) =>
      svg("text",
        {
          x: at * HISTOGRAM_WIDTH, y: HISTOGRAM_HEIGHT + HISTOGRAM_FOOT - 4,
          "text-anchor": anchor(at),
        },
        text,
      ),
    ),
    series.map(({ color, shares }) =>
      svg("path", { d: histogramLine(shares, top), style: { stroke: color } }),
    ),
  );
}

const LOG_RANGE = { low: -12, high: 12, bins: 96 }; // stops of luminance

function luminanceHistogram(images) {
  const series = images.map(({ name, color, image }) => ({
    name,
    color,
    shares: histogramShares(
      (i) => Math.log2(luminanceAt(image, i)),
      image.width * image.height,
      LOG_RANGE,
    ),
  }));
  const { low, high } = LOG_RANGE;
  const marks = [-12, -8, -4, 0, 4, 8, 12].map((stops) => [
    (stops - low) / (high - low),
    stops === 0 ? "luminance 1" : `2${stops < 0 ? "⁻" : ""}${superscript(stops)}`,
  ]);
  return histogram("Luminance of all pixels", series, marks);
}

function superscript(whole) {
  return [...String(Math.abs(whole))].map((d) => SUPERSCRIPTS[d]).join("");
}

// Of signed relative differences, to the end of the scale that fits them all.
function differenceHistogram(maps) {
  const top = scaleTop(
    maps.map(({ image }) => image),
    (image, i) => channelAt(image, i, 0),
  );
  const range = { low: -top, high: top, bins: 81 };
  const series = maps.map(({ name, color, image }) => ({
    name,
    color,
    shares: histogramShares(
      (i) => channelAt(image, i, 0),
      image.width * image.height,
      range,
    ),
  }));
  const end = fmtShortPercent(top);
  return histogram("Signed relative differences of all pixels", series, [
    [0, `${MINUS}${end}`],
    [0.5, "0"],
    [1, `+${end}`],
  ]);
}
