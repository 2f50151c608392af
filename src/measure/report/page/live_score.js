"use strict";
// Which of the two is ahead, in words.

function verdictText({ ahead, since }, pace) {
  const at = pace === "time" ? "at equal processor time" : "at equal samples";
  if (!ahead) return `No difference is certain yet ${at}`;
  const other = ahead === "A" ? "B" : "A";
  return `${ahead} is ahead of ${other} ${at}, certain since ${fmtCount(since)} ` +
    "samples per pixel";
}

function drawScore(node, state) {
  const { ratio } = state;
  node.hidden = !ratio;
  if (!ratio) return;
  if (ratio.value === undefined || ratio.value === null) {
    node.replaceChildren(el("p.note", `No ratio yet: ${ratio.why}.`));
    return;
  }
  const cost = state.pace === "time" ? "processor time" : "samples";
  const bounds = `[${known(ratio.low) ? fmt(ratio.low) : "0"}, ${
    known(ratio.high) ? fmt(ratio.high) : "∞"}]`;
  node.replaceChildren(
    el("div.number", fmt(ratio.value), el("span.bounds", ` ${bounds}`)),
    el("p", el("b", `${verdictText(ratio, state.pace)}. `),
      `Efficiency of B over A, 1 / (relative MSE × ${cost}), with a 95 % interval that `,
      "holds at all looks together, from what both estimate of their own errors."),
    ratio.why && el("p.note", `An end is open, ${ratio.why}`),
  );
}
