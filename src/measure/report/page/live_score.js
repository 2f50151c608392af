"use strict";
// Which of the two is ahead, in words.

function verdictText({ ahead, since }, pace) {
  const at = pace === "time" ? "at equal processor time" : "at equal samples";
  if (!ahead) return `No significant difference yet ${at}`;
  const other = ahead === "A" ? "B" : "A";
  return `${ahead} is more efficient than ${other} ${at} (significant since ` +
    `${fmtCount(since)} samples per pixel)`;
}

function drawScore(node, state) {
  const { ratio } = state;
  node.hidden = !ratio;
  if (!ratio) return;
  if (ratio.value === undefined || ratio.value === null) {
    node.replaceChildren(el("p.note", `No comparison yet: ${ratio.why}.`));
    return;
  }
  const cost = state.pace === "time" ? "processor time" : "samples";
  const bounds = `[${known(ratio.low) ? fmt(ratio.low) : "0"}, ${
    known(ratio.high) ? fmt(ratio.high) : "∞"}]`;
  node.replaceChildren(
    el("div.number", `${fmt(ratio.value)}×`, el("span.bounds", ` ${bounds}`)),
    el("p", el("b", `${verdictText(ratio, state.pace)}. `),
      `Efficiency of B over A, where efficiency is 1 / (relative MSE × ${cost}). The 95 % `,
      "interval uses the error estimates of both renders and remains valid while they continue."),
    ratio.why && el("p.note", `The interval is open: ${ratio.why}.`),
  );
}
