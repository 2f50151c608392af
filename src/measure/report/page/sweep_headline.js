"use strict";
// One sentence on what the sweep has found, no stronger than its intervals.

// "at 64 spp", of the values that vary beside scene and strategy.
function whereText(values) {
  const axes = varyingAxes.filter((axis) => axis.name !== "scene" && values[axis.name]);
  return axes.map((axis) => valueLabel(axis, values[axis.name])).join(", ");
}

function certaintyText({ equals, seeds, strategies }) {
  if (seeds < 3) {
    const are = seeds === 1 ? "1 seed is" : `${seeds} seeds are`;
    return `${are} too few for intervals; use 3 or more`;
  }
  if (!known(equals)) return "too many strategies to say how many are as good";
  if (equals > 0) return `${equals} of the other ${strategies - 1} may be as good`;
  return "each of the others is certainly worse";
}

function leaderText(leader) {
  const { best, baseline, efficiency, values } = leader;
  const where = whereText(values);
  const on = `on ${values.scene}${where && ` (${where})`}`;
  const head =
    best === baseline
      ? `Nothing is more efficient than ${baseline} ${on}`
      : `${best} is the most efficient ${on}: ` +
        `${joined(intervalTexts(efficiency))} times ${baseline}`;
  return `${head}; ${certaintyText(leader)}.`;
}

function leadersText(leaders) {
  const wins = new Map();
  for (const { best } of leaders) wins.set(best, (wins.get(best) || 0) + 1);
  const order = [...wins].sort((a, b) => b[1] - a[1]);
  const parts = order.slice(0, 3).map(([name, n]) => `${name} on ${n}`);
  const more = order.length > 3 ? ", others elsewhere" : "";
  const head = `Most efficient on ${leaders.length} scenes: ${parts.join(", ")}${more}`;
  const few = leaders.filter((l) => l.seeds < 3);
  if (few.length === leaders.length) return `${head}; ${certaintyText(few[0])}.`;
  const alone = leaders.filter((l) => l.seeds >= 3 && l.equals === 0).length;
  const better = leaders.filter((l) => l.best !== l.baseline && l.efficiency.low > 1);
  const without = few.length > 0 ? ` ${few.length} have fewer than three seeds.` : "";
  return (
    `${head}. On ${better.length || "none"} it is certainly better than ${study.baseline}, ` +
    `on ${alone || "none"} than every other strategy.${without}`
  );
}

function fastestText() {
  const rate = (group) => intervalOf(group, "samples_per_second");
  const groups = study.groups.filter((group) => known(rate(group).value));
  if (groups.length === 0) return null;
  const best = groups.reduce((a, b) => (rate(b).value > rate(a).value ? b : a));
  const at = varyingAxes
    .filter((axis) => best.values[axis.name])
    .map((axis) => valueLabel(axis, best.values[axis.name]));
  return (
    `The highest rate${at.length > 0 ? ` (${at.join(", ")})` : ""}: ` +
    `${joined(rateTexts(rate(best)))} samples per second.`
  );
}

function headlineText() {
  const { leaders } = study;
  if (leaders.length === 0) return fastestText();
  return leaders.length === 1 ? leaderText(leaders[0]) : leadersText(leaders);
}
