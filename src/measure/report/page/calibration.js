"use strict";
// What renders say of their own error against what it is.

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
    `true ${joined(intervalTexts(level.relmse))}`,
    `estimated ${joined(intervalTexts(level.self.relmse))}`,
    `interval held in ${level.self.inside} of ${level.self.total} renders`,
    level.self.refused > 0 && `${level.self.refused} renders stated none`,
  );
}

// Their samples could not tell how large it is.
function refusedText({ refused, total }) {
  if (!(refused > 0)) return "No render stated an interval of its own error.";
  return (
    `${fmtCount(refused)} of ${fmtCount(refused + total)} renders stated no interval: ` +
    "rare bright samples may be missing from them, and their own samples cannot tell."
  );
}

function calibrationNumber(calibration) {
  if (!calibration) {
    return el("p", "No render had an estimate of its own error.");
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
      `of the ${fmtCount(calibration.total)} renders that stated an interval have their ` +
        `true relative MSE in it (${fmtCount(calibration.inside)} renders). ` +
        `Stated confidence: ${stated}.`,
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
  const x = { label: "true relative MSE", ticks: decadeTicks, format: errorTick };
  const y = {
    ...x,
    label: ratio ? "estimated / true" : "estimated by the render itself",
  };
  return logPlot(view, host, {
    lines: calibrationLines(view, ratio),
    square: !ratio,
    include: ratio ? [1] : [],
    describe: describeCalibration,
    guides: (frame) => truthGuide(frame, ratio),
    xAxis: x,
    yAxis: y,
    label: "Relative MSE that renders estimate of themselves against the true one",
  });
}

function calibrationSection(view) {
  const title = "Does a render know its own error?";
  const number = calibrationNumber(view.scene.calibration);
  if (calibrationLines(view, false).length === 0)
    return section("calibration", title, number);
  const { host, figure } = plotFigure("calibration", "Estimated against true error");
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
          "On the line the estimate is right; below it, the render " +
            "thinks itself better than it is. The strategies shown are those chosen above.",
        ),
      ),
    ),
  );
}
