"use strict";
// Headline: the most efficient strategy, as far as the intervals support it.

// "at 64 spp", of the values that vary beside scene and strategy.
function whereText(values) {
  const axes = varyingAxes.filter((axis) => axis.name !== "scene" && values[axis.name]);
  return axes.map((axis) => valueLabel(axis, values[axis.name])).join(", ");
}

function certaintyText({ equals, seeds, strategies, stopped, within }) {
  if (seeds < 4 && !known(within)) {
    const are = seeds === 1 ? "1 seed is" : `${seeds} seeds are`;
    return `${are} too few to rank strategies; use 4 or more`;
  }
  if (strategies === 1) return `the other ${stopped} strategies stopped early (--race)`;
  if (!known(equals)) return "too many strategies to test which others may be equally efficient";
  if (equals > 0) return `${equals} of the other ${strategies - 1} strategies may be equally efficient`;
  return "all other strategies are significantly less efficient";
}

function nextText({ next, next_efficiency }) {
  if (!next) return "";
  const ratio = joined(intervalTexts(next_efficiency, 1, "×"));
  return `; the next, ${next}, has ${ratio} its efficiency`;
}

function leaderText(leader) {
  const { best, baseline, efficiency, values } = leader;
  const where = whereText(values);
  const on = `on ${values.scene}${where && ` (${where})`}`;
  const head =
    best === baseline
      ? `${baseline}, the baseline, is the most efficient ${on}${nextText(leader)}`
      : `${best} is the most efficient ${on}: ` +
        `${joined(intervalTexts(efficiency, 1, "×"))} the efficiency of ${baseline}`;
  return `${head}; ${certaintyText(leader)}.`;
}

function leadersText(leaders) {
  const wins = new Map();
  for (const { best } of leaders) wins.set(best, (wins.get(best) || 0) + 1);
  const order = [...wins].sort((a, b) => b[1] - a[1]);
  const parts = order.slice(0, 3).map(([name, n]) => `${name} on ${n}`);
  const more = order.length > 3 ? ", other strategies on the rest" : "";
  const head = `Most efficient on ${leaders.length} scenes: ${parts.join(", ")}${more}`;
  const few = leaders.filter((l) => l.seeds < 4 && !known(l.within));
  if (few.length === leaders.length) return `${head}; ${certaintyText(few[0])}.`;
  const alone = leaders.filter((l) => l.seeds >= 4 && l.equals === 0).length;
  const better = leaders.filter((l) => l.best !== l.baseline && l.efficiency.low > 1);
  const without = few.length === 0 ? ""
    : ` ${few.length === 1 ? "1 scene has" : `${few.length} scenes have`} too few seeds to be ranked.`;
  return (
    `${head}. The most efficient strategy is significantly better than ${study.baseline} on ` +
    `${better.length || "none"} of the scenes, and than every other strategy on ` +
    `${alone || "none"}.${without}`
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
    `Highest throughput: ${joined(rateTexts(rate(best)))} samples per second` +
    `${at.length > 0 ? ` (${at.join(", ")})` : ""}.`
  );
}

function headlineText() {
  const { leaders } = study;
  if (leaders.length === 0) return fastestText();
  return leaders.length === 1 ? leaderText(leaders[0]) : leadersText(leaders);
}
