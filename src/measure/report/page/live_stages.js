"use strict";
// Where the processor time goes, stage by stage, as it renders; and what is left out.

const MOST_BARS = 12;

function stageRow(stage, total, most) {
  const share = stage.seconds / total;
  return el(
    "div.live-stage", el("span.live-stage-name", stage.name.replaceAll("_", " ")),
    el("span.live-stage-bar", el("span", { style: { width: `${(100 * share) / most}%` } })),
    el("span.live-stage-share", fmtPercent(share, 2)),
    el("span.live-stage-filled",
      stage.filled !== null && `${fmtPercent(stage.filled, 2)} of lanes`),
  );
}

function drawStages(node, slot) {
  const stages = [...slot.stages].sort((a, b) => b.seconds - a.seconds);
  const total = stages.reduce((sum, s) => sum + s.seconds, 0);
  if (!(total > 0)) return node.replaceChildren();
  const most = stages[0].seconds / total;
  const rest = stages.slice(MOST_BARS).reduce((sum, s) => sum + s.seconds, 0);
  node.replaceChildren();
  appendAll(node, [
    el("p", el("b", `${fmt(slot.rays / slot.seconds / 1e6)} Mray/s`),
      ` and ${fmt(slot.samples / slot.seconds / 1e6)} Msamples/s, per second of processor `,
      "time (sum over all threads)"),
    stages.slice(0, MOST_BARS).map((stage) => stageRow(stage, total, most)),
    rest > 0 &&
      el("p.note",
        `${stages.length - MOST_BARS} more stages: ${fmtPercent(rest / total, 2)}`),
  ]);
}

function drawOmitted(node, slot) {
  node.replaceChildren(
    ...slot.omitted.map(({ name, reason }) =>
      el("div", el("b", name.replaceAll("_", " ")), ` ${reason}`)),
  );
}

class Stages {
  constructor() {
    this.bars = [0, 1].map((slot) => el("div", { "data-stages": slot }));
    this.omitted = [0, 1].map(() => el("div.omitted"));
    this.columns = [0, 1].map((slot) =>
      el("div.live-stages-column",
        el("h3", swatch(STYLES[slot]), ` ${"AB"[slot]}`), this.bars[slot],
        el("details", el("summary", "Omitted stages, with reasons"), this.omitted[slot])));
    this.node = el("div.live-stages", this.columns);
    this.plans = ["", ""];
  }

  show(state) {
    state.slots.forEach((slot, i) => {
      this.columns[i].hidden = !slot.stages;
      if (!slot.stages) return;
      drawStages(this.bars[i], slot);
      const plan = JSON.stringify(slot.omitted);
      if (plan !== this.plans[i]) drawOmitted(this.omitted[i], slot);
      this.plans[i] = plan;
    });
  }
}
