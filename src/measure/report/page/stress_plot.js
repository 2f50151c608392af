"use strict";
// A plot of curves against the parameter of a map: the promised range shaded, breaks and
// refusals marked.

// With more curves, bands and limits are those of the one that the legend points at.
const MOST_BANDS = 4;

function promiseShade(frame, aCase) {
  const [from, to] = promisedShare(aCase, frame.scales.x).map(
    (share) => frame.left + share * (frame.right - frame.left),
  );
  return svg("rect.promise", {
    x: from, width: Math.max(1, to - from), y: frame.top, height: frame.bottom - frame.top,
  });
}

function breakLines(frame, aCase, target) {
  return nearestBreaks(aCase, target).map((place) => {
    const x = frame.x(place.parameter);
    return withTip(
      svg("line.break.told", { x1: x, x2: x, y1: frame.top, y2: frame.bottom }),
      () => noteOf("First failure", breakText(aCase, place)),
    );
  });
}

// Values that are not there: a cross at the bottom, with the message.
function refusals(frame, lines, describe) {
  const seen = new Map();
  for (const line of lines) {
    for (const point of line.all) {
      if (hasNumber(point) || point.not_measured) continue;
      seen.set(point.parameter, { line, point });
    }
  }
  return [...seen.values()].map(({ line, point }) =>
    withTip(
      svg("path.refused.told", {
        class: point.crash && "bad",
        d: markerPath("cross", frame.x(point.parameter), frame.bottom - 8, 4),
      }),
      () => describe(line, { point }),
    ),
  );
}

function mapPoints(line, plot, choice) {
  return line.points
    .filter(hasNumber)
    .map((point) => {
      const { value: y, ...bounds } = plot.value(point, choice);
      const bad = !point.verdict.good;
      return { x: point.parameter, y, ...bounds, bad, hollow: plot.log && y <= 0, point };
    })
    .filter((p) => known(p.y));
}

// What drawPlot() takes. plot: one of PLOTS; choice: of its choices, or null.
function mapOptions(aCase, target, lines, plot, choice) {
  const { name } = aCase.axis;
  const label = choice ? `${plot.choices[choice][0]} per sample` : plot.title;
  const x = parameterScale(aCase);
  const zero = x.log && aCase.points.some((p) => p.parameter === 0) ? [0] : [];
  const describe = describePoint(aCase);
  return {
    lines: lines.map((line) => ({
      ...line, all: line.points, points: mapPoints(line, plot, choice),
    })),
    kind: lines.length > MOST_BANDS ? "many" : null,
    label: `${label} against ${name}`,
    xAxis: {
      label: axisTitle(aCase),
      ticks: (scale, most) => [...zero, ...decadeTicks(scale, most)],
      format: parameterTick,
    },
    yAxis: {
      label, ticks: decadeTicks,
      format: choice ? plot.choices[choice][1] : plot.tick,
    },
    scales: (some) => {
      const points = some.flatMap((line) => line.points);
      const values = points.flatMap((p) => [p.y, p.high, p.limit]);
      return { x, y: makeScale([...values, ...(plot.include || [])], plot.log, 0.06) };
    },
    under: (frame) => promiseShade(frame, aCase),
    over: (frame, shown) => [
      breakLines(frame, aCase, target),
      refusals(frame, shown, describe),
    ],
    describe,
  };
}
