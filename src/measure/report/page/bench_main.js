"use strict";
// Page of a benchmark: how fast one machine renders.

const targetNames = [...new Set(study.rows.map((row) => row.target))];
const threadCounts = [...new Set(study.rows.map((row) => row.threads))];

// Of independent rates: half widths of their logarithms add as squares.
function geometricMean(rates) {
  const n = rates.length;
  const mean = (f) => rates.reduce((sum, rate) => sum + f(rate), 0) / n;
  const value = Math.exp(mean((rate) => Math.log(rate.value)));
  const width = (f) => Math.sqrt(mean((rate) => Math.log(f(rate)) ** 2) / n);
  return {
    value,
    low: value / Math.exp(width(({ value: x, low }) => x / (low ?? NaN))),
    high: value * Math.exp(width(({ value: x, high }) => (high ?? NaN) / x)),
  };
}

// Of the first target, on the fewest and the most threads.
function benchHeadline() {
  const [target] = targetNames;
  const rateOn = (threads) => {
    const rows = study.rows.filter((r) => r.target === target && r.threads === threads);
    const mean = geometricMean(rows.map((row) => row.samples_per_second));
    return `${joined(rateTexts(mean))} samples per wall second on ${threadsText(threads)}`;
  };
  const least = Math.min(...threadCounts),
    most = Math.max(...threadCounts);
  const scenes = new Set(study.rows.map((row) => row.scene)).size;
  const of = scenes > 1 ? ` (geometric mean of ${scenes} scenes)` : "";
  const more = most > least ? `, ${rateOn(most)}` : "";
  return `This machine renders ${rateOn(least)}${more}${of}, with ${instructionSet(target)}.`;
}

function benchTable() {
  const texts = (row) => rateTexts(row.samples_per_second);
  const efficiency = ({ parallel_efficiency: interval }) =>
    twoLines(intervalTexts(interval || { value: null }));
  return plainTable("All rows",
    ["Scene", "Target", "Threads", "Samples / wall s", "Samples / processor s",
      "Parallel efficiency", "Rays / wall s", "Bytes / path", "Samples per pixel", "Repeats"],
    study.rows.map((row) => [
      row.scene,
      row.target,
      fmtCount(row.threads),
      twoLines(texts(row)),
      twoLines(rateTexts(row.samples_per_cpu_second)),
      efficiency(row),
      rateTick(row.rays_per_second),
      fmtCount(row.bytes_per_path),
      fmtCount(row.spp),
      fmtCount(row.seconds.length),
    ]),
  );
}

function benchSections(lines) {
  const view = linesView(lines);
  const parallel =
    threadCounts.length > 1 && study.rows.some((row) => row.parallel_efficiency)
      ? [strategyLegend(view, "Lines shown"), efficiencyFigure(view, lines)]
      : el("p", "Needs rows with 1 thread and with more: use --threads 1,2,4,8.");
  return [
    section("rates", "Samples per wall second", rateRows(lines),
      el("p.hint", "Median of the repeats and its " +
        `${fmtShortPercent(study.confidence)} confidence interval (order statistics).`)),
    section("threads", "Parallel efficiency against thread count", parallel),
    section("groups", "Processor time per sample, by stage",
      el("p.lead", "Each bar shows the row with the fewest threads of a scene and target: " +
        "the sum over its threads in the last repeat. This is a single measurement, so it " +
        "has no interval."),
      groupBars(view)),
    section("rows", "All rows", benchTable()),
  ];
}

function startBench() {
  const lines = benchLines();
  startPage({
    title: "Lanelight bench",
    footer:
      "Written by lanelight bench. This page holds all its numbers and needs no network.",
    sections: lines.length > 0 && [
      ["rates", "Rates"], ["threads", "Threads"], ["groups", "Stages"], ["rows", "Rows"],
    ],
  });
  const wide = { class: "wide" };
  showContent(
    firstSection("Rendering speed of this machine",
      el("p.lead.headline", lines.length > 0 ? benchHeadline() : "No row was measured."),
      el("dl.facts",
        fact("Machine", study.machine.text, null, wide),
        fact("Program", study.program, null, wide)),
      warningBox(null, study.warnings), // the sentences that the terminal prints
    ),
    lines.length > 0 && benchSections(lines),
  );
}

startBench();
