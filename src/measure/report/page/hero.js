"use strict";
// Headline: the most efficient strategy, its gain, and a plot of both strategies.

const MOST_RIVALS = 3; // that the headline names

// The winner, and what it is compared with: the baseline, or, where that wins, the next.
function contest(view) {
  const [winner, next] = view.ranked;
  const { baseline } = view;
  if (!winner || !winner.level || !(valueOf(winner.level.relmse) > 0)) return null;
  if (valueOf(winner.efficiency) === null) return null;
  return { winner, other: winner === baseline ? next || null : baseline };
}

function inverted({ value, low, high }) {
  return {
    value: 1 / value,
    low: known(high) && high > 0 ? 1 / high : null,
    high: known(low) && low > 0 ? 1 / low : null,
  };
}

// Efficiencies are relative to the baseline.
function gainOver(view, { winner, other }) {
  if (!other || valueOf(other.efficiency) === null) return null;
  if (other === view.baseline) return winner.efficiency;
  return other.efficiency.value > 0 ? inverted(other.efficiency) : null;
}

// Strategies whose intervals allow them to be the most efficient.
function rivalsOf(view, winner) {
  return view.ranked.filter((s) => s !== winner && s.rank && s.rank[0] === 1);
}

// "1.4× [1.3, 1.5] lower relative MSE than NAME at equal processor time".
function gainText(view, pair) {
  const gain = gainOver(view, pair);
  if (!gain) return null;
  return [
    `${joined(intervalTexts(gain, 1, "×"))} lower relative MSE than `,
    el("b", { title: fullName(pair.other) }, shortName(pair.other.name)),
    " at equal processor time",
  ];
}

function heroSentence(view, pair) {
  const { winner } = pair;
  const gain = gainText(view, pair);
  const amount = gain ? [": ", gain] : "";
  const name = el("b", { title: fullName(winner) }, shortName(winner.name));
  const level = winner.level.repetitions;
  if (!winner.rank || level < 3) {
    const times = level === 1 ? "1 repetition" : `${level} repetitions`;
    const advice = "use 3 or more repetitions for intervals.";
    return [name, ` was the most efficient in ${times}`, amount, `; ${advice}`];
  }
  const rivals = rivalsOf(view, winner);
  if (rivals.length === 0) return [name, " is the most efficient", amount, "."];
  const who =
    rivals.length > MOST_RIVALS ? `${rivals.length} others` : someNames(rivals);
  return [
    name, " has the highest efficiency", amount,
    `; ${who} may be equally efficient (all pairs tested together).`,
  ];
}

function heroNumber(value, bounds, caption) {
  return el("div.hero-number",
    el("div.number", value),
    bounds && el("div.bounds", bounds),
    el("div.hero-caption", caption),
  );
}

function gainNumber(view, pair) {
  const gain = gainOver(view, pair);
  if (!gain) return null;
  const { value, bounds } = intervalTexts(gain);
  return heroNumber(`${value}×`, bounds, [
    "the efficiency of ",
    el("b", shortName(pair.other.name)),
    pair.other === view.baseline ? " (baseline)" : " (second)",
  ]);
}

function targetNumber(view, { winner, other }) {
  const mine = winner.to_target,
    theirs = other && other.to_target;
  if (!mine || valueOf(mine.seconds) === null) return null;
  const { value, bounds } = secondsTexts(mine.seconds);
  const target = fmtShort(view.scene.target_relmse);
  const guess = (t) => (t.extrapolated ? " (extrapolated)" : "");
  return heroNumber(value, bounds, [
    `of processor time to reach a relative MSE of ${target}${guess(mine)}`,
    theirs && valueOf(theirs.seconds) !== null &&
      `; ${shortName(other.name)} needs ${joined(secondsTexts(theirs.seconds))}` +
        guess(theirs),
  ]);
}

// A plot of its own: what is chosen further down does not change it.
function heroPlot(view, { winner, other }) {
  const rivals = rivalsOf(view, winner);
  const named = rivals.length > MOST_RIVALS ? [] : rivals;
  const strong = [...new Set([winner, other, ...named])].filter(Boolean);
  const own = {
    ...view,
    shown: makeSignal(new Set(strong.map((s) => s.index))),
    focus: makeSignal(null),
  };
  const { host, figure } = plotFigure("hero", "Relative MSE against processor time");
  figure.firstChild.append(
    el("span.hero-legend", strong.map((s) => strategyLabel(s)),
      view.ran.length > strong.length && el("span.bounds", "grey: other strategies"),
    ),
  );
  const axis = {
    label: "processor time of one render",
    ticks: decadeTicks,
    format: secondsTick,
  };
  whenVisible(view, figure, () =>
    curvePlot(own, host, "relmse", axis, (level) => valueOf(level.cpu_seconds)),
  );
  return figure;
}

function hero(view) {
  const { scene } = view;
  const pair = contest(view);
  if (!pair) {
    return el("p.verdict", scene.verdict || "No strategy has been measured.");
  }
  return [
    el("p.verdict", heroSentence(view, pair)),
    el("div.hero",
      el("div.hero-numbers", gainNumber(view, pair), targetNumber(view, pair)),
      heroPlot(view, pair),
    ),
    scene.verdict &&
      el("details.notes",
        el("summary", "Full result as text, with all intervals"),
        el("p.lead", scene.verdict),
      ),
  ];
}
