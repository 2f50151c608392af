"use strict";
// What the equations of the founding paper say, and what was found of it here. S. Maughan,
// "Path Tracing Renderer Using Monte Carlo Methods"; the sentences are our own.

// By figure: [equation, what it says].
const PAPER_EQUATIONS = {
  1: [
    "p(ω) = 1 / 2π,  cos θ / π,  2 cos³θ / π",
    "A diffuse surface scatters by a density over the hemisphere; the three that are compared " +
      "differ in how much they prefer the normal.",
  ],
  2: [
    "I ≈ 2π / N · Σ f(ωᵢ) L(ωᵢ) cos θᵢ",
    "The mean of the integrand at uniform directions, times the solid angle of the " +
      "hemisphere, is right on average; its variance is that of the whole integrand.",
  ],
  3: [
    "I ≈ 1 / N · Σ f(ωᵢ) L(ωᵢ) cos θᵢ / p(ωᵢ),  p ∝ f cos θ",
    "Dividing by the density keeps the mean, and a density in proportion to a factor of the " +
      "integrand takes that factor's variance away.",
  ],
  4: [
    "Var = 1 / N² · Σⱼ nⱼ σⱼ²  ≤  σ² / N",
    "With as many samples in each stratum as its share, only the variance within strata " +
      "remains, so that it is never more than that of independent samples.",
  ],
  5: [
    "I ≈ 1 / 2N · Σ f(u) + f(1 − u),  Var = σ² (1 + ρ) / 2N",
    "The variance of pairs falls as their two values are negatively correlated, which they " +
      "are where the integrand is monotone, and rises where it is symmetric.",
  ],
  6: [
    "I ≈ 1 / N · Σ f − c (h − E[h]),  Var = σ² (1 − ρ²) / N",
    "Subtracting a function whose integral is known changes no mean; at the best c the " +
      "variance falls by the square of the correlation.",
  ],
  7: [
    "f / (1 − q) with probability 1 − q,  else 0",
    "Ending a path by chance and weighting those that go on keeps the mean: it buys shorter " +
      "paths with more variance.",
  ],
  8: [
    "RMSE ∝ 1 / √N",
    "Independent samples halve the error for four times the work, whatever the dimension; a " +
      "steeper curve is what better points can give.",
  ],
};

// Whether an interval is on one side of `middle`.
function sideOf(interval, middle, more, less) {
  if (!hasBounds(interval)) return "and how sure that is cannot be said";
  if (interval.low > middle) return more;
  return interval.high < middle ? less : "which noise explains";
}

function foundOfModels(view) {
  const models = view.scene.diffuse || [];
  const brightness = ({ mean }) => mean.reduce((sum, x) => sum + x, 0) / mean.length;
  const cosine = models.find(({ model }) => model === "lambertian");
  if (!cosine) return null;
  const others = models.filter((model) => model !== cosine);
  return `Relative to the cosine's, images are ${others
    .map((m) => `${fmt(brightness(m) / brightness(cosine))} times as bright with ${m.model}`)
    .join(" and ")} (one render each, so without intervals).`;
}

function foundOfStrategy(view, s) {
  const { baseline } = view;
  if (!s || !s.level || !baseline || !baseline.level) return null;
  const error = (of) => joined(intervalTexts(of.level.relmse));
  const time = (of) => fmtSeconds(valueOf(of.level.cpu_seconds));
  return (
    `At ${fmtCount(s.at_spp)} samples its relative MSE is ${error(s)} in ${time(s)}, that of ` +
    `${baseline.name} ${error(baseline)} in ${time(baseline)}: ` +
    `${joined(intervalTexts(s.efficiency))} times the efficiency, ` +
    `${sideOf(s.efficiency, 1, "certainly a gain", "certainly a loss")}.`
  );
}

function foundOfOrders(strategies) {
  const measured = strategies.filter((s) => valueOf(s.order) !== null);
  if (measured.length === 0) return null;
  const steeper = measured.filter((s) => hasBounds(s.order) && s.order.high < -0.5);
  const names = steeper.map((s) => `${s.name} (${joined(intervalTexts(s.order))})`);
  const rest = measured.length - steeper.length;
  return steeper.length === 0
    ? "No strategy certainly converges faster than that."
    : `Certainly faster than −½: ${names.join(", ")}; the other ${rest} not.`;
}
