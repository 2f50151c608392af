"use strict";
// What renders say of their own error against what it is.

function calibrationLines(view) {
  return view.ran.map((s) => ({
    index: s.index, name: s.name, style: s.style,
    points: (s.levels || []).map(calibrationPoint).filter(Boolean).sort((a, b) => a.x - b.x),
  })).filter((line) => line.points.length > 0);
}

function calibrationPoint(level) {
  const estimate = level.self && level.self.relmse;
  const x = valueOf(level.relmse), y = valueOf(estimate);
  if (!known(x) || x <= 0 || !known(y) || y <= 0) return null;
  return { x, y, low: estimate.low, high: estimate.high, level,
           hollow: Boolean(level.reference_limited) };
}

function drawDiagonal(u) {
  const { min, max } = u.scales.x;
  u.ctx.strokeStyle = theme.color("--muted");
  u.ctx.lineWidth = 1.5 * devicePixelRatio;
  u.ctx.beginPath();
  u.ctx.moveTo(u.valToPos(min, "x", true), u.valToPos(min, "y", true));
  u.ctx.lineTo(u.valToPos(max, "x", true), u.valToPos(max, "y", true));
  u.ctx.stroke();
}

function describeCalibration(line, { level }) {
  return [el("b", {}, line.name), el("div", {}, `${fmtCount(level.spp)} spp`),
          el("div", {}, `true ${joined(intervalTexts(level.relmse))}`),
          el("div", {}, `estimated ${joined(intervalTexts(level.self.relmse))}`),
          el("div", {}, `interval held in ${level.self.inside} of ${level.self.total} renders`)];
}

function calibrationNumber(calibration) {
  if (!calibration || !known(valueOf(calibration.share))) {
    return el("p", {}, "No render had an estimate of its own error.");
  }
  const stated = known(calibration.stated) ? fmtPercent(calibration.stated) : UNKNOWN;
  const { value, bounds } = percentTexts(calibration.share);
  return el("div", { class: "big-number" },
    el("div", { class: "number" }, value),
    bounds && el("div", { class: "bounds" }, bounds),
    el("p", {}, `of ${fmtCount(calibration.total)} renders stated an interval that holds ` +
                `their true relative MSE (${fmtCount(calibration.inside)} renders). ` +
                `Stated confidence: ${stated}.`),
    whiskerRow(calibration));
}

function whiskerRow(calibration) {
  const scale = whiskerScale([calibration.share], false,
                             [calibration.stated, 1].filter(known));
  const options = { width: 220, format: (x) => fmtPercent(x, 2), most: 4 };
  const marks = known(calibration.stated) ? [calibration.stated] : [];
  return el("div", { class: "axis-block" }, whiskerAxis(scale, options),
            whisker(calibration.share, scale, { width: 220, marks, label: "Coverage" }));
}

function calibrationSection(view) {
  const lines = calibrationLines(view);
  const { host, figure } = plotFigure("calibration", "Stated against true error");
  const axis = (label) => ({ label, ticks: decadeTicks, format: errorTick });
  if (lines.length > 0) {
    whenVisible(view, figure, () => logPlot(view, host, {
      lines, square: true, guides: drawDiagonal, describe: describeCalibration,
      label: "Relative MSE that renders estimate of themselves against the true one",
      xAxis: axis("true relative MSE"), yAxis: axis("estimated by the render itself"),
    }));
  }
  return section("calibration", "Does a render know its own error?",
    el("div", { class: "calibration" },
      lines.length > 0 ? figure : null,
      el("div", { class: "calibration-text" }, calibrationNumber(view.scene.calibration),
        lines.length > 0 && el("p", { class: "hint" }, "On the diagonal the estimate is right; " +
          "below it, the render thinks itself better than it is. The legend above chooses " +
          "the strategies here as well."))));
}
