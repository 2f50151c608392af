// control=regression: h is a polynomial in the numbers that drive the first bounce,
// fitted to earlier samples of the neighbourhood.
//   estimator   f - c sum_j b_j phi_j(u): phi_j are Legendre polynomials on [0, 1],
//               orthonormal: degrees 1 and 2 in each of the numbers of the first bounce's
//               direction and light point, degree 1 in the position in the pixel; b by
//               least squares (src/image/regression_film.h). Here the numbers are kept
//   unbiased    E[phi_j] = 0 whatever came before in the path, and b depends on groups of
//               samples that came earlier and are independent of the one it corrects
//               (a martingale); c may be any number, and 1 is the optimum, as the fit is
//   variance    f's share that is additive and quadratic in these numbers goes away:
//               (1 - R^2) of the variance. Stratified and low-discrepancy points
//               integrate that share already: nothing is left to gain there, nor
//               where rare bright samples are most of the variance
//   cost        per sample seven multiply-adds per function, and a fit (a window of 5 x 5
//               pixels, as sums of rows and columns) whenever the samples have grown by a
//               quarter, or at first by 8; 344 bytes per pixel
//   source      Salaun et al. 2022, "Regression-based Monte Carlo Integration"
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/control/regression.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/queue/filter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void FirstFilm(Wave& wave) {
  const PathColumns& p = wave.path;
  ForEachBatch(wave, wave.queue(QueueId::kCamera), [&](const Slots& slots, MF) HWY_ATTR {
    Scatter(Gather(p.u_film_0, slots), p.first_film_0, slots);
    Scatter(Gather(p.u_film_1, slots), p.first_film_1, slots);
  });
}

void FirstBounce(Wave& wave) {
  const PathColumns& p = wave.path;
  const Queue& first =
      FilterQueue(wave, wave.queue(QueueId::kVertex), [&](const Slots& slots) HWY_ATTR {
        return hn::RebindMask(DF(), hn::Eq(Gather(p.depth, slots), hn::Zero(DI())));
      });
  ForEachBatch(wave, first, [&](const Slots& slots, MF) HWY_ATTR {
    Scatter(Gather(p.u_bsdf_0, slots), p.first_bsdf_0, slots);
    Scatter(Gather(p.u_bsdf_1, slots), p.first_bsdf_1, slots);
    if (p.u_light_0 == nullptr) return;
    Scatter(Gather(p.u_light_0, slots), p.first_light_0, slots);
    Scatter(Gather(p.u_light_1, slots), p.first_light_1, slots);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/path/stage.h"

namespace lanelight {

HWY_EXPORT(FirstFilm);
HWY_EXPORT(FirstBounce);

Stage FirstFilmStage() {
  return {.name = "control_first_film",
          .meaning = "keeps the position in the pixel",
          .input = QueueId::kCamera,
          .needs = {Feature::kRegressionControl},
          .reads = {Field::u_film_0, Field::u_film_1},
          .writes = fields::kFirstFilm,
          .resolve = [](const FeatureSet&) -> StageFn {
            return HWY_DYNAMIC_DISPATCH(FirstFilm);
          }};
}
Stage FirstBounceStage() {
  return {.name = "control_first_bounce",
          .meaning = "keeps the numbers of the first bounce",
          .input = QueueId::kVertex,
          .needs = {Feature::kRegressionControl, Feature::kScatters},
          .reads = fields::kBouncePoints | FieldSet{Field::depth},
          .writes = fields::kFirstBounce,
          .resolve = [](const FeatureSet&) -> StageFn {
            return HWY_DYNAMIC_DISPATCH(FirstBounce);
          }};
}

}  // namespace lanelight
#endif  // HWY_ONCE
