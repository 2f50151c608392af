"use strict";
// One map with all that was measured along it.

function pointRows(point) {
  if (point.refused) return [["refused", point.refused]];
  if (point.not_measured) return [["not measured", point.not_measured]];
  if (point.crash) return [["crashed", point.crash]];
  const half = known(point.verdict.allowance)
    ? point.verdict.allowance - point.tolerance
    : null;
  return [
    ["expected", fmt(point.expected, 6)],
    ["measured", fmt(point.measured, 6)],
    half > 0 && ["noise", `± ${fmt(half, 2)}`],
    point.tolerance > 0 && ["tolerance", `± ${fmt(point.tolerance, 2)}`],
    ["z", point.verdict.z === null ? "infinite" : fmt(point.verdict.z, 2)],
    point.invalid > 0 && ["invalid samples", fmtCount(point.invalid)],
    [
      "smallest detectable error",
      known(point.verdict.detectable) ? fmtFound(point.verdict.detectable) : "none",
    ],
    !point.verdict.good && ["fault", point.verdict.why],
  ].filter(Boolean);
}

function describePoint(aCase) {
  return (line, { point }) => noteOf(
    line.name === "all" ? aCase.name : line.name,
    `${aCase.axis.name} ${fmtParameter(aCase, point.parameter)}`,
    ...pointRows(point).map(([name, text]) => `${name}: ${text}`),
  );
}

const perSample = (point, key) =>
  point.samples > 0 && point[key] > 0 ? point[key] / point.samples : null;

const PLOTS = [
  {
    key: "error",
    title: "Relative error",
    log: true,
    tick: errorTick,
    value(point) {
      const { value, noise, limit } = errorOf(point);
      const band = noise > 0 ? { low: value - noise, high: value + noise } : {};
      return { value, limit, ...band };
    },
  },
  {
    key: "noise",
    title: "Relative standard error",
    log: true,
    tick: errorTick,
    value: (point) => ({
      value:
        point.standard_error > 0
          ? point.standard_error / (point.scale > 0 ? point.scale : 1)
          : null,
    }),
  },
  {
    key: "cost",
    title: "Cost per sample",
    log: true,
    choices: {
      seconds: ["Processor time", secondsTick],
      rays: ["Rays", (x) => fmtShort(x)],
    },
    value: (point, choice) => ({ value: perSample(point, choice) }),
  },
  {
    key: "lanes",
    title: "SIMD lanes used",
    log: false,
    tick: (x) => fmtShortPercent(x),
    include: [0, 1],
    value: (point) => ({
      value: point.lane_slots > 0 ? point.lanes_used / point.lane_slots : null,
    }),
  },
];

// The choices of a plot that some point has a value for; [null] where there are none.
function choicesOf(lines, plot) {
  const has = (choice) =>
    lines.some((line) =>
      line.points.some((p) => hasNumber(p) && known(plot.value(p, choice).value)),
    );
  return (plot.choices ? Object.keys(plot.choices) : [null]).filter(has);
}

function detailPlot(view, aCase, target, plot) {
  const choices = choicesOf(view.ran, plot);
  if (choices.length === 0) return null;
  const { title } = plot;
  const { host, figure } = plotFigure(plot.key, title, `${title}, ${aCase.name}`);
  let end = () => {};
  const draw = (choice) => {
    end();
    end = showPlot(view, host, mapOptions(aCase, target, view.ran, plot, choice));
  };
  draw(choices[0]);
  if (choices.length > 1) {
    const options = choices.map((key) => [key, plot.choices[key][0]]);
    figure.firstChild.append(choiceButtons(title, options, choices[0], draw));
  }
  return figure;
}

function detailSection(view, aCase, target, onChoose) {
  const figures = PLOTS.map((plot) => detailPlot(view, aCase, target, plot)).filter(Boolean);
  return section("map", el("span", aCase.name, el("span.on-target", ` on ${target}`)),
    mapMenu(aCase, onChoose),
    factList(aCase, target),
    view.ran.length > MOST_BANDS && showAllButtons(view),
    view.ran.length > 1 && strategyLegend(view, "Curves shown"),
    el("div.map-plots", { style: { "--plots": Math.max(1, figures.length) } }, figures),
    el("p.hint",
      "Green: supported range. Bands: noise at the confidence level of the verdict. Thin dashed " +
        "lines: largest accepted error. Red rings: failed points. Crosses: refused with a " +
        "message. Hollow markers: no error at all. Drag to zoom, double-click to reset the zoom.",
    ),
  );
}
