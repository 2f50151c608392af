"use strict";
// Explanations of the equations of the founding paper, and the measured results. S. Maughan,
// "Path Tracing Renderer Using Monte Carlo Methods"; the sentences are our own.

// By figure: [equation, what it says].
const PAPER_EQUATIONS = {
  1: [
    "p(ω) = 1 / 2π,  cos θ / π,  2 cos³θ / π",
    "The density of the directions scattered by a diffuse surface. The three models differ in " +
      "how strongly they favour the normal.",
  ],
  2: [
    "I ≈ 2π / N · Σ f(ωᵢ) L(ωᵢ) cos θᵢ",
    "The mean of the integrand at uniform directions, times the solid angle of the " +
      "hemisphere, is unbiased. Its variance is that of the whole integrand.",
  ],
  3: [
    "I ≈ 1 / N · Σ f(ωᵢ) L(ωᵢ) cos θᵢ / p(ωᵢ),  p ∝ f cos θ",
    "Dividing by the density keeps the estimate unbiased. A density proportional to a factor " +
      "of the integrand removes the variance of that factor.",
  ],
  4: [
    "Var = 1 / N² · Σⱼ nⱼ σⱼ²  ≤  σ² / N",
    "With samples in proportion to the size of each stratum, only the variance within strata " +
      "remains. It never exceeds the variance of independent samples.",
  ],
  5: [
    "I ≈ 1 / 2N · Σ f(u) + f(1 − u),  Var = σ² (1 + ρ) / 2N",
    "Variance falls where the two values of a pair are negatively correlated, as for a " +
      "monotone integrand. It rises where the integrand is symmetric.",
  ],
  6: [
    "I ≈ 1 / N · Σ f − c (h − E[h]),  Var = σ² (1 − ρ²) / N",
    "Subtracting a function with a known integral keeps the estimate unbiased. At the " +
      "optimal c the variance falls by the squared correlation.",
  ],
  7: [
    "f / (1 − q) with probability 1 − q,  else 0",
    "Ending paths at random and weighting the survivors keeps the estimate unbiased. Paths " +
      "get shorter and the variance increases.",
  ],
  8: [
    "RMSE ∝ 1 / √N",
    "Independent samples halve the error at four times the cost, in any dimension. Better " +
      "sample sequences can converge faster.",
  ],
};

// Whether an interval is on one side of `middle`.
function sideOf(interval, middle, more, less) {
  if (!hasBounds(interval)) return "without an interval";
  if (interval.low > middle) return more;
  return interval.high < middle ? less : "not a significant difference";
}

function foundOfModels(view) {
  const models = view.scene.diffuse || [];
  const brightness = ({ mean }) => mean.reduce((sum, x) => sum + x, 0) / mean.length;
  const cosine = models.find(({ model }) => model === "lambertian");
  if (!cosine) return null;
  const others = models.filter((model) => model !== cosine);
  return `Mean image brightness relative to lambertian: ${others
    .map((m) => `${fmt(brightness(m) / brightness(cosine))}× with ${m.model}`)
    .join(", ")} (one render each, so without intervals).`;
}

function foundOfStrategy(view, s) {
  const { baseline } = view;
  if (!s || !s.level || !baseline || !baseline.level) return null;
  const error = (of) => joined(intervalTexts(of.level.relmse));
  const time = (of) => fmtSeconds(valueOf(of.level.cpu_seconds));
  return (
    `At ${fmtCount(s.at_spp)} samples per pixel ${s.name} has a relative MSE of ${error(s)} ` +
    `after ${time(s)}; ${baseline.name} has ${error(baseline)} after ${time(baseline)}. ` +
    `Its efficiency is ${joined(intervalTexts(s.efficiency, 1, "×"))} that of ${baseline.name}: ` +
    `${sideOf(s.efficiency, 1, "a significant gain", "a significant loss")}.`
  );
}

function foundOfOrders(strategies) {
  const measured = strategies.filter((s) => valueOf(s.order) !== null);
  if (measured.length === 0) return null;
  const steeper = measured.filter((s) => hasBounds(s.order) && s.order.high < -0.5);
  const names = steeper.map((s) => `${s.name} (${joined(intervalTexts(s.order))})`);
  const rest = measured.length - steeper.length;
  return steeper.length === 0
    ? "No strategy has an order of convergence significantly below −½."
    : `Order of convergence significantly below −½: ${names.join(", ")}; not so for the ` +
        `other ${rest}.`;
}
