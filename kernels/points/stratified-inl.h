// points=stratified: the group's samples fill a grid of a x b strata, one jittered sample
// in each, in a random order per dimension.
//   estimator   mean of f((x + xi) / a, (y + eta) / b) over all strata (x, y); scalars
//               have a b strata in one dimension
//   unbiased    the order is a random permutation, so each sample is uniform; an
//               incomplete group is unbiased too
//   variance    N^-2 for two dimensions and smooth f, N^-3/2 at edges; N^-3 for one
//               dimension; never above independent samples in the stratified dimensions.
//               Nothing is gained for functions of many dimensions at once
//   dependence  the samples of one group share one permutation: one observation
//   cost        two PCG-4D hashes and a permutation per point
// Sources: the paper's section 3.5.3; Cook 1986, "Stochastic Sampling in Computer
// Graphics"; Mitchell 1996 (rates).
#if defined(LANELIGHT_POINTS_STRATIFIED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_POINTS_STRATIFIED_INL_H_
#undef LANELIGHT_POINTS_STRATIFIED_INL_H_
#else
#define LANELIGHT_POINTS_STRATIFIED_INL_H_
#endif

#include "kernels/points/permute-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct StratifiedPoints {
  static LANELIGHT_INLINE GroupIndex Group(const PointsParameters& points, VU sample) {
    return GroupByDivision(points, sample);
  }

  // The group's hash and the index give the jitter; the hash's first word is the
  // permutation's.
  struct Drawn {
    VU stratum;
    U4 jitter;
  };
  static LANELIGHT_INLINE Drawn Draw(const PointsParameters& points, VU pixel,
                                     GroupIndex at, VU key, VU seed) {
    const U4 h = Pcg4d({pixel, at.group, key, seed});
    return {Permute(points.strata, at.index, h.x), Pcg4d({at.index, h.y, h.z, h.w})};
  }

  static LANELIGHT_INLINE void Point(const PointsParameters& points, VU pixel,
                                     GroupIndex at, VU key, VU seed, VF* u0, VF* u1) {
    const Drawn drawn = Draw(points, pixel, at, key, seed);
    const QuotientRemainder cell = DivideBy(points.columns, drawn.stratum);
    *u0 = ToUnit(InStratum(points.columns, cell.remainder, drawn.jitter.x));
    *u1 = ToUnit(InStratum(points.rows, cell.quotient, drawn.jitter.y));
  }

  static LANELIGHT_INLINE VF Number(const PointsParameters& points, VU pixel,
                                    GroupIndex at, VU key, VU seed) {
    const Drawn drawn = Draw(points, pixel, at, key, seed);
    return ToUnit(InStratum(points.strata, drawn.stratum, drawn.jitter.x));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
