"use strict";
// The first screen: the verdict in one sentence, and all maps in one picture.

function verdictKind() {
  if (study.outcomes.failed > 0) return "failed";
  return study.outcomes.unfinished > 0 ? "unfinished" : "good";
}

function summaryFacts() {
  const { full, seed, threads } = study.settings;
  const parts = [
    `${fmtCount(study.promised)} promised points`,
    `${full ? "full" : "quick"} run of ${fmtSeconds(study.seconds)}`,
    `${fmtSeconds(study.cpu_seconds)} of processor time`,
    `${threads} thread${threads === 1 ? "" : "s"}, seed ${seed}`,
    `a correct renderer fails one run in ${fmtCount(1 / study.false_alarm)}`,
  ];
  return el("p.lead", parts.join(" · "), el("br"), machinesText([study.machine]));
}

function tileLegend() {
  const key = (name, text) =>
    el("span.key", el("span", { class: `key-mark ${name}` }), text);
  return el("p.tile-legend",
    el("b", "Error against the parameter, "),
    `from ${powerOfTen(TILE.from)} to 10, relative. `,
    key("promise", "promised range"),
    key("allowed", "noise and tolerance"),
    key("break", "first breaks"),
    key("bad", "wrong"),
  );
}

// Cases without a map: a chip each.
function chips() {
  const single = study.cases.filter((c) => !maps.includes(c));
  if (single.length === 0) return null;
  return el("div.chips",
    el("span.note", "Of a single point each:"),
    single.map((c) =>
      withTip(el("span.chip", { "data-outcome": c.outcome, tabindex: 0 }, c.name), () => noteOf(
        `${c.name}: ${WORDS[c.outcome]}`,
        c.extreme,
        `must: ${c.must}`,
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
  Promised:
    "The range in which the documentation says that results are right. A point in it " +
      "that is not right, or is refused, fails its case; outside, the map shows what happens.",
  Noise:
    "Standard errors times the quantile of Student's t at the level of a single point. " +
      "The levels of all promised points together make the false-alarm probability.",
  Weak:
    "A promised point could not have seen an error of 10 %. It passed, but that says " +
      "little; a full run has more samples.",
  Finds:
    "The relative error that the worst promised point would have found with a " +
      "probability of 90 %; of a rate, the rate.",
  "First breaks":
    "On the way out of the promised range, the first value at which a point is not " +
      "good: wrong, or refused with a message.",
  "Time and rays":
    "Processor time of all points of a case, building their scenes included; rays per " +
      "camera sample. Lanes: how full the vectors of all stages were.",
};
