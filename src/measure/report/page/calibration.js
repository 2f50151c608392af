"use strict";
// Errors that renders estimate against their true errors.

function calibrationLines(view, ratio) {
  return levelLines(view, (level) => calibrationPoint(level, ratio));
}

function calibrationPoint(level, ratio) {
  const estimate = level.self && level.self.relmse;
  const x = valueOf(level.relmse),
    y = valueOf(estimate);
  if (!known(x) || x <= 0 || !known(y) || y <= 0) return null;
  const unit = ratio ? x : 1;
  const scaled = (bound) => (known(bound) ? bound / unit : null);
  const { low, high } = estimate;
  const hollow = Boolean(level.reference_limited);
  return { x, y: y / unit, low: scaled(low), high: scaled(high), level, hollow };
}

// Where the estimate is right.
function truthGuide(frame, ratio) {
  const { from, to } = frame.scales.x;
  const [first, last] = [from, to].map((x) => frame.y(ratio ? 1 : x));
  return svg("path.truth", { d: `M${frame.left} ${first}L${frame.right} ${last}` });
}

function describeCalibration(line, { level }) {
  return noteOf(
    line.name,
    `${fmtCount(level.spp)} spp`,
    `true relative MSE ${joined(intervalTexts(level.relmse))}`,
    `estimated relative MSE ${joined(intervalTexts(level.self.relmse))}`,
    `interval contains the true error in ${level.self.inside} of ${level.self.total} renders`,
    level.self.refused > 0 && `${level.self.refused} renders without an interval`,
  );
}

// Renders whose samples are too few for an interval.
function refusedText({ refused, total }) {
  if (!(refused > 0)) return "No render printed a confidence interval for its own error.";
  return (
    `${fmtCount(refused)} of ${fmtCount(refused + total)} renders printed no interval, ` +
    "because they may have missed rare bright samples."
  );
}

function calibrationNumber(calibration) {
  if (!calibration) {
    return el("p", "No render estimated its own error.");
  }
  if (!known(valueOf(calibration.share))) return el("p", refusedText(calibration));
  const stated = known(calibration.stated)
    ? fmtShortPercent(calibration.stated)
    : UNKNOWN;
  const { value, bounds } = percentTexts(calibration.share);
  return el("div.big-number",
    el("div.number", value),
    bounds && el("div.bounds", bounds),
    el("p",
      `of ${fmtCount(calibration.total)} renders (${fmtCount(calibration.inside)}) have ` +
        `their true relative MSE inside their own ${stated} confidence interval.`,
    ),
    calibration.refused > 0 && el("p", refusedText(calibration)),
    whiskerRow(calibration),
  );
}

function whiskerRow(calibration) {
  const scale = whiskerScale(
    [calibration.share],
    false,
    [calibration.stated, 1].filter(known),
  );
  const options = { width: 220, format: fmtShortPercent, most: 4 };
  const marks = known(calibration.stated) ? [calibration.stated] : [];
  return el("div.axis-block",
    whiskerAxis(scale, options),
    whisker(calibration.share, scale, { width: 220, marks, label: "Coverage" }),
  );
}

function calibrationPlot(view, host, ratio) {
  const x = { label: "true relative MSE (against the reference)", ticks: decadeTicks, format: errorTick };
  const y = {
    ...x,
    label: ratio ? "estimated / true relative MSE" : "estimated relative MSE",
  };
  return logPlot(view, host, {
    lines: calibrationLines(view, ratio),
    square: !ratio,
    include: ratio ? [1] : [],
    describe: describeCalibration,
    guides: (frame) => truthGuide(frame, ratio),
    xAxis: x,
    yAxis: y,
    label: "Relative MSE estimated by the renders against the true relative MSE",
  });
}

function calibrationSection(view) {
  const title = "Accuracy of the renders' own error estimates";
  const number = calibrationNumber(view.scene.calibration);
  if (calibrationLines(view, false).length === 0)
    return section("calibration", title, number);
  const { host, figure } = plotFigure("calibration", "Estimated against true relative MSE");
  let end = () => {};
  const draw = (kind) => {
    end();
    end = calibrationPlot(view, host, kind === "ratio");
  };
  whenVisible(view, figure, () => draw("values"));
  figure.firstChild.append(
    choiceButtons("Scale", [["values", "Values"], ["ratio", "Ratio"]], "values", draw),
  );
  return section("calibration", title,
    el("div.calibration",
      figure,
      el("div.calibration-text",
        number,
        el("p.hint",
          "On the line, the estimate equals the true error; below it, the render " +
            "underestimates its error. The plot shows the strategies selected above.",
        ),
      ),
    ),
  );
}
