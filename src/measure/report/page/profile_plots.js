"use strict";
// Memory, queues and the image of a profile.

const rowsOfStages = study.rows.filter((row) => row.kind === "stage" && row.seconds > 0);

function bytesOf(row) {
  return row.bytes_read_per_item + row.bytes_written_per_item;
}

// Stages by group, so that a colour is a group: path columns against speed.
function rooflineLines() {
  return groupNames
    .map((name, index) => ({
      index, name,
      status: "ok",
      style: strategyStyle(index),
      points: rowsOfStages
        .filter((row) => row.group === name && bytesOf(row) > 0)
        .map((row) => ({ x: bytesOf(row), y: row.items / row.seconds, row })),
    }))
    .filter((line) => line.points.length > 0);
}

// Speeds at which a level of memory would be busy with the columns alone.
function peakGuides(frame) {
  const { from, to } = frame.scales.x;
  return study.peaks.levels.map(({ name, bytes_per_second: peak }) => {
    const at = valueAt(frame.scales.x, 0.98);
    const [x0, x1] = [from, to].map(frame.x),
      [y0, y1] = [from, to].map((x) => frame.y(peak / x));
    const angle = (Math.atan2(y1 - y0, x1 - x0) * 180) / Math.PI;
    return [
      svg("path.guide", { d: `M${x0} ${y0}L${x1} ${y1}` }),
      svg("text.guide-name",
        { "text-anchor": "end", transform: `translate(${frame.x(at)} ${frame.y(peak / at)}) rotate(${angle})` },
        svg("tspan", { dy: -4 }, `${name} ${fmtShort(peak * 1e-9)} GB/s`),
      ),
    ];
  });
}

function describeRoofline(line, { x, y, row }) {
  return noteOf(row.name,
    `${fmtShort(x)} bytes per path`,
    `${rateTick(y)} paths per processor second`,
    `${fmtPercent(row.of_peak_bandwidth)} of the bandwidth of ${study.wavefront.level}`,
    `${fmtPercent(row.share)} of the time`,
    row.bound && `bound: ${row.bound}`);
}

function rooflineFigure(view, lines) {
  const { host, figure } = plotFigure("roofline", "Speed of stages against bytes per path");
  const { name: level, bytes_per_second: peak } = study.peaks.levels.find(
    ({ name }) => name === study.wavefront.level);
  const xs = lines.flatMap((line) => line.points.map((p) => p.x));
  whenVisible(view, figure, () =>
    logPlot(view, host, {
      lines,
      kind: "scatter",
      label: `Speed of stages against bytes per path, which are in ${level}`,
      xAxis: { label: "bytes of columns per path", ticks: binaryTicks, format: fmtShort },
      yAxis: { label: "paths per processor second", ticks: decadeTicks, format: rateTick },
      include: [peak / Math.min(...xs)],
      guides: peakGuides,
      describe: describeRoofline,
    }),
  );
  return figure;
}

function memorySection() {
  const lines = rooflineLines();
  if (lines.length === 0) return null;
  const view = linesView(lines);
  const moved = rowsOfStages
    .map((row) => ({ row, bytes: (bytesOf(row) * row.items) / study.samples }))
    .filter(({ bytes }) => bytes > 0)
    .sort((a, b) => b.bytes - a.bytes);
  const total = moved.reduce((sum, { bytes }) => sum + bytes, 0);
  const bar = ({ row, bytes }) => ({
    name: row.name, value: bytes, color: groupColor(row.group),
    texts: { value: `${fmtCount(bytes)} B`, bounds: fmtPercent(bytes / total) },
  });
  return section("memory", "Memory",
    el("p.lead",
      "Bytes are those of the path columns that a stage declares: an upper bound. They exclude " +
        "BVH, triangles, textures and tables. Lines show measured read bandwidths of one " +
        `thread. The paths of a wavefront fit in ${study.wavefront.level}: stages near its line ` +
        "are limited by memory."),
    strategyLegend(view, "Groups shown", false),
    el("div.plots.bar-columns",
      rooflineFigure(view, lines),
      el("div", el("h3", `Bytes of columns per sample: ${fmtCount(total)} B in all`),
        valueBars(moved.slice(0, MOST_STAGES).map(bar))),
    ),
  );
}

function queuesSection() {
  const { queues } = page;
  if (!queues) return null;
  const lines = queues.lines.map(({ name, paths }, index) => ({
    index, name,
    status: "ok",
    style: strategyStyle(index),
    steps: true,
    points: paths
      .map((y, i) => ({ x: ((i + 0.5) / paths.length) * queues.seconds, y }))
      .filter(({ y }) => known(y)),
  }));
  const view = linesView(lines);
  const { host, figure } = plotFigure("queues", "Paths in the queue of a stage call");
  const [unit, unitName] = timeUnit(queues.seconds);
  whenVisible(view, figure, () =>
    showPlot(view, host, {
      lines,
      label: "Queue lengths over time",
      xAxis: {
        label: `time since the first call (${unitName})`, ticks: roundTicks,
        format: (x) => fmtShort(x / unit),
      },
      yAxis: { label: "paths per call", ticks: roundTicks, format: fmtShort },
      scales: (some) => {
        const top = Math.max(...some.flatMap((line) => line.points.map((p) => p.y)), 1);
        return { x: { from: 0, to: queues.seconds }, y: { from: 0, to: 1.05 * top } };
      },
      describe: (line, { x, y }) => noteOf(line.name, `${fmt(y)} paths`, `at ${fmtSeconds(x)}`),
    }),
  );
  return section("queues", "Queue lengths over time",
    el("p.lead",
      "Mean over the calls of all threads in " +
        `${fmtSeconds(queues.seconds / queues.lines[0].paths.length)}, for the stages that take ` +
        "most of the time." +
        (queues.complete
          ? ""
          : ` Shows the first ${fmtSeconds(queues.seconds)}; --trace-events N records more.`)),
    strategyLegend(view, "Stages shown"),
    figure,
  );
}

function mapSection() {
  const cost = findImage("cost");
  const values = Array.from(cost.bits, (bits) => HALF_VALUES[bits]).filter(Number.isFinite);
  if (values.length === 0) return null;
  const top = niceStep(values.sort((a, b) => a - b)[Math.floor(0.99 * (values.length - 1))]);
  const view = linesView([]);
  const pixels = () =>
    rampPixels(cost.width, cost.height, SEQUENTIAL_TABLE, (i) => channelAt(cost, i, 0) / top);
  return section("map", "Processor time over the image",
    el("p.lead",
      "Time of a tile's tasks per sample. Tiles are as large as the scheduler makes them; " +
        "time within a tile is not measured."),
    el("div.plots.profile-images",
      el("figure", picture(view, "Processor time per sample, by tile", cost, pixels),
        el("figcaption", rampLegend(SEQUENTIAL_TABLE, ["0", "", `${fmtShort(top)} µs`]))),
      el("figure", tonedPicture(view, findImage("image"), "The rendered image"),
        el("figcaption.hint", "The rendered image")),
    ),
  );
}
