// control=regression: h is a polynomial in the numbers that drive the first scattered
// direction of a path, and linear in its first choices between lobes, fitted to samples
// of the neighbourhood.
//   estimator   f - c sum_j b_j phi_j(u), E[phi_j] = 0: the functions, the fit and what
//               makes it unbiased are in src/render/films/regression_film.h. Here the
//               numbers are kept: position in the pixel; direction and light point of the
//               first event that is not specular (mirrors and clear glass have no use for
//               them); the first two choices (choices.cc)
//   unbiased    a number is uniform whatever came before it in the path (a martingale),
//   and
//               so is one that the material has no use for
//   variance    f's share that is additive and quadratic in these numbers goes away:
//               (1 - R^2) of the variance. No light needs to be of a kind: light that a
//               point light sends by way of a second surface is as smooth in the first
//               scattered direction as that of an area light. Stratified and
//               low-discrepancy points integrate that share already (Hickernell, Lemieux
//               and Owen 2005): little is left to gain there, nor where rare bright
//               samples are most of the variance
//   cost        per sample six multiply-adds per function, and a fit at the end (and at
//               looks at the error): sums over blocks of 4 x 4 pixels; some 750 bytes per
//               pixel
//   source      Salaun et al. 2022, "Regression-based Monte Carlo Integration"; Lavenberg
//               and Welch 1981, "A Perspective on the Use of Control Variables" (optimal
//               c, what the fit costs); Nelson 1990, "Control Variate Remedies" (halves)
#include "kernels/simd/each_target-inl.h"

#include "kernels/queue/batch-inl.h"
#include "src/scene/compiled/materials.h"
#include "src/vocabulary/path/dimensions.h"

LANELIGHT_BEGIN_KERNELS

// As PairCode.
HWY_INLINE VI PairCodes(VF first, VF second) {
  const DI di;
  const VI high = hn::ConvertTo(di, hn::Mul(first, Splat(1 << kBitsOfFirst)));
  const VI low = hn::ConvertTo(di, hn::Mul(second, Splat(1 << kBitsOfSecond)));
  const VI has = hn::BitCast(di, hn::Set(DU(), kHasPair));
  return hn::Or(has, hn::Or(hn::ShiftLeft<kBitsOfSecond>(high), low));
}

void FirstFilm(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kCamera), [&](const Slots& slots, MF) HWY_ATTR {
    Scatter(PairCodes(Gather(p.u_film_0, slots), Gather(p.u_film_1, slots)), p.first_film,
            slots);
  });
}

// Returns whether the kind has delta directions only.
HWY_INLINE hn::Mask<DI> IsSpecular(VI kind) {
  const DI di;
  auto specular = hn::Lt(kind, hn::Zero(di));
  for (int k = 0; k < kNumShadeKinds; ++k) {
    if (!HasTrait(static_cast<ShadeKind>(k), kSpecularOnly)) continue;
    specular = hn::Or(specular, hn::Eq(kind, hn::Set(di, k)));
  }
  return specular;
}

void FirstBounce(Wave& wave) {
  const PathColumns& p = wave.path;
  const MaterialTable& m = *wave.materials;
  const Queue& first =
      FilterQueue(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots) HWY_ATTR {
        const auto open = hn::Eq(Gather(p.first_bsdf, slots), hn::Zero(DI()));
        const VI kind = Lookup(m.kind, Gather(p.material, slots));
        return hn::RebindMask(DF(), hn::AndNot(IsSpecular(kind), open));
      });
  ForEachBatch(wave, first, [&](const Slots& slots, MF) HWY_ATTR {
    Scatter(PairCodes(Gather(p.u_bsdf_0, slots), Gather(p.u_bsdf_1, slots)), p.first_bsdf,
            slots);
    if (p.u_light_0 == nullptr) return;
    Scatter(PairCodes(Gather(p.u_light_0, slots), Gather(p.u_light_1, slots)),
            p.first_light, slots);
  });
}

Stage FirstFilmStage() {
  return {.name = "control_first_film",
          .meaning = "keeps the position in the pixel",
          .input = QueueId::kCamera,
          .role = StageRole::kSampling,
          .needs = {Feature::kRegressionControl},
          .reads = {Field::u_film_0, Field::u_film_1},
          .writes = {Field::first_film},
          .resolve = Always<FirstFilm>};
}
Stage FirstBounceStage() {
  return {.name = "control_first_bounce",
          .meaning = "keeps the numbers of the first scattered direction",
          .input = QueueId::kVertex,
          .role = StageRole::kSampling,
          .needs = {Feature::kRegressionControl, Feature::kScatters},
          .reads = fields::kBouncePoints | FieldSet{Field::material, Field::first_bsdf},
          .writes = {Field::first_bsdf, Field::first_light},
          .resolve = Always<FirstBounce>};
}

LANELIGHT_END_KERNELS
