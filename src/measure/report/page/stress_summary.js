"use strict";
// First screen: the verdict in one sentence, and small plots of all maps.

function verdictKind() {
  if (study.outcomes.failed > 0) return "failed";
  return study.outcomes.unfinished > 0 ? "unfinished" : "good";
}

function summaryFacts() {
  const { full, seed, threads } = study.settings;
  const parts = [
    `${fmtCount(study.promised)} points in supported ranges`,
    `${full ? "full" : "quick"} run of ${fmtSeconds(study.seconds)}`,
    `${fmtSeconds(study.cpu_seconds)} of processor time`,
    `${threads} thread${threads === 1 ? "" : "s"}, seed ${seed}`,
    `false-alarm rate: 1 in ${fmtCount(1 / study.false_alarm)} runs`,
  ];
  return el("p.lead", parts.join(" · "), el("br"), machinesText([study.machine]));
}

function tileLegend() {
  const key = (name, text) =>
    el("span.key", el("span", { class: `key-mark ${name}` }), text);
  return el("p.tile-legend",
    el("b", "Relative error against the parameter of each case"),
    ` (error axis: ${powerOfTen(TILE.from)} to 10, logarithmic). `,
    key("promise", "supported range"),
    key("allowed", "noise and tolerance"),
    key("break", "first failure"),
    key("bad", "wrong"),
  );
}

// Cases without a map: a chip each.
function chips() {
  const single = study.cases.filter((c) => !maps.includes(c));
  if (single.length === 0) return null;
  return el("div.chips",
    el("span.note", "Cases with a single point:"),
    single.map((c) =>
      withTip(el("span.chip", { "data-outcome": c.outcome, tabindex: 0 }, c.name), () => noteOf(
        `${c.name}: ${WORDS[c.outcome]}`,
        c.extreme,
        `expected: ${c.must}`,
        c.why && c.why,
      )),
    ),
  );
}

function stressSummary(target, onChoose) {
  const first = firstSection(study.sentence,
    summaryFacts(),
    maps.length > 0 && tileLegend(),
    tileGrid(target, onChoose),
    chips(),
  );
  first.querySelector("h1").dataset.outcome = verdictKind();
  return first;
}

const STRESS_TERMS = {
  "Supported range":
    "The parameter range in which the documentation states that results are correct. A " +
      "wrong or refused point in it fails the case. Points outside are shown for information.",
  Noise:
    "Standard errors times the quantile of Student's t at the level of a single point. " +
      "The levels of all points in supported ranges together give the false-alarm rate.",
  Weak:
    "The case passed, but one of its points cannot detect an error of 10 %. Use --full for " +
      "more samples.",
  Detectable:
    "Relative error (or rate) that the least sensitive point of the supported range detects " +
      "with a probability of 90 %.",
  "First failures":
    "The failing points nearest to the supported range, and inside it: wrong or " +
      "refused with a message.",
  "Time and rays":
    "Processor time of all points of a case, including the build of their scenes; rays per " +
      "camera sample. Lanes: percentage of SIMD lanes in use, over all stages.",
};
