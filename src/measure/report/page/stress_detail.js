"use strict";
// One map with all that was measured along it.

function pointRows(aCase, point) {
  if (point.refused) return [["refused", point.refused]];
  if (point.not_measured) return [["not measured", point.not_measured]];
  if (point.crash) return [["crashed", point.crash]];
  const half = known(point.verdict.allowance)
    ? point.verdict.allowance - point.tolerance
    : null;
  const rate = aCase.truth === "rate";
  return [
    ["expected", fmt(point.expected, 6)],
    ["measured", rate ? `${point.failures} of ${point.trials}` : fmt(point.measured, 6)],
    !rate && half > 0 && ["noise", `± ${fmt(half, 2)}`],
    point.tolerance > 0 && ["tolerance", `± ${fmt(point.tolerance, 2)}`],
    ["z", point.verdict.z === null ? "beyond any noise" : fmt(point.verdict.z, 2)],
    point.invalid > 0 && ["invalid samples", fmtCount(point.invalid)],
    [
      "finds errors from",
      known(point.verdict.detectable) ? fmtFound(point.verdict.detectable) : "no size on",
    ],
    !point.verdict.good && ["fault", point.verdict.why],
  ].filter(Boolean);
}

function describePoint(aCase) {
  return (line, point) => [
    el("b", line.name === "all" ? aCase.name : line.name),
    el("div", `${aCase.axis.name} ${fmtParameter(aCase, point.parameter)}`),
    pointRows(aCase, point).map(([name, text]) => el("div", `${name}: ${text}`)),
  ];
}

const perSample = (point, key) =>
  point.samples > 0 && point[key] > 0 ? point[key] / point.samples : null;

const PLOTS = [
  {
    key: "error",
    title: measureOf,
    log: true,
    tick: errorTick,
    value(aCase, point) {
      const { value, noise, limit } = errorOf(aCase, point);
      const band = noise > 0 ? { low: value - noise, high: value + noise } : {};
      return { value, limit, ...band };
    },
  },
  {
    key: "noise",
    title: () => "Standard error, relative",
    log: true,
    tick: errorTick,
    value: (aCase, point) => ({
      value:
        point.standard_error > 0
          ? point.standard_error / (point.scale > 0 ? point.scale : 1)
          : null,
    }),
  },
  {
    key: "cost",
    title: () => "Cost per sample",
    log: true,
    choices: {
      seconds: ["Processor time", secondsTick],
      rays: ["Rays", (x) => fmtShort(x)],
    },
    value: (aCase, point, choice) => ({ value: perSample(point, choice) }),
  },
  {
    key: "lanes",
    title: () => "Lanes filled",
    log: false,
    tick: (x) => fmtShortPercent(x),
    include: [0, 1],
    value: (aCase, point) => ({
      value: point.lane_slots > 0 ? point.lanes_used / point.lane_slots : null,
    }),
  },
];

// The choices of a plot that some point has a value for; [null] where there are none.
function choicesOf(aCase, lines, plot) {
  const has = (choice) =>
    lines.some((line) =>
      line.points.some((p) => hasNumber(p) && known(plot.value(aCase, p, choice).value)),
    );
  return (plot.choices ? Object.keys(plot.choices) : [null]).filter(has);
}

function detailPlot(aCase, target, lines, plot) {
  const choices = choicesOf(aCase, lines, plot);
  if (choices.length === 0) return null;
  let choice = choices[0];
  const host = el("div.map-host", { "data-plot": plot.key });
  const title = plot.title(aCase);
  const draw = () =>
    host.isConnected &&
    mapPlot(host, {
      aCase,
      target,
      lines,
      quantity: title,
      label: `${title} against ${aCase.axis.name}`,
      yLog: plot.log,
      yTick: choice ? plot.choices[choice][1] : plot.tick,
      include: plot.include,
      value: (point) => plot.value(aCase, point, choice),
      describe: describePoint(aCase),
    });
  new ResizeObserver(() => requestAnimationFrame(draw)).observe(host);
  const buttons =
    choices.length > 1 &&
    choiceButtons(title, choices.map((key) => [key, plot.choices[key][0]]),
      choice,
      (key) => {
        choice = key;
        draw();
      },
    );
  const caption = el("figcaption", title, buttons);
  const saving = mapSaveButtons(host, `${title}, ${aCase.name}`);
  return el("figure.plot-figure", caption, host, saving);
}

function detailSection(aCase, target, onChoose) {
  const lines = seriesOf(aCase, target);
  const shown = new Set(lines.map((line) => line.index));
  const plots = el("div.map-plots");
  const draw = () => {
    tip.hide();
    const some = lines.filter((line) => shown.has(line.index));
    const figures = PLOTS.map((plot) => detailPlot(aCase, target, some, plot));
    plots.replaceChildren(...figures.filter(Boolean));
    plots.style.setProperty("--plots", Math.max(1, plots.childElementCount));
  };
  draw();
  return section("map", el("span", aCase.name, el("span.on-target", ` on ${target}`)),
    mapMenu(aCase, onChoose),
    factList(aCase, target),
    seriesLegend(lines, shown, draw),
    plots,
    el("p.hint",
      "Green: the promised range. Bands: noise at the level of the verdict; thin dashed " +
        "lines: where a point would fail. Red rings: points that are not good; " +
        "crosses: refused, with the message. A hollow marker has no error at all.",
    ),
  );
}
