// points=cmj: correlated multi-jittered samples: one in each of a x b strata of two
// dimensions, and one in each of the a b strata of either dimension alone.
//   estimator   mean of f(u0, u1) with, for the stratum (x, y),
//                 u0 = (x b + p(y) + xi) / (a b), u1 = (y a + q(x) + eta) / (a b),
//               p and q random permutations, the same for all columns and all rows (that
//               is the correlation: it keeps samples of neighbouring strata apart), and a
//               random order of the strata
//   unbiased    p, q and the order are random permutations, so each sample is uniform
//   variance    N^-3 for the parts of smooth f that depend on one of the two dimensions
//               alone; N^-3/2 for the rest, since all columns share p and with it the
//               same error (independently jittered strata have N^-2): measured in
//               tests/points/convergence_test.cc
//   dependence  the samples of one group share the permutations: one observation
//   cost        two PCG-4D hashes and three permutations per point
// Source: Kensler 2013, "Correlated Multi-Jittered Sampling" (the permutations are ours:
// permute-inl.h).
#if defined(LANELIGHT_POINTS_CMJ_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_POINTS_CMJ_INL_H_
#undef LANELIGHT_POINTS_CMJ_INL_H_
#else
#define LANELIGHT_POINTS_CMJ_INL_H_
#endif

#include "kernels/points/permute-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct CmjPoints {
  static LANELIGHT_INLINE GroupIndex Group(const PointsParameters& points, VU sample) {
    return GroupByDivision(points, sample);
  }

  static LANELIGHT_INLINE void Point(const PointsParameters& points, VU pixel,
                                     GroupIndex at, VU key, VU seed, VF* u0, VF* u1) {
    const U4 h = Pcg4d({pixel, at.group, key, seed});
    const U4 jitter = Pcg4d({at.index, h.y, h.z, h.w});
    const QuotientRemainder cell =
        DivideBy(points.columns, Permute(points.strata, at.index, h.x));
    const VU x = cell.remainder, y = cell.quotient;
    const VU fine0 =
        hn::Add(hn::Mul(x, SplatU(points.rows.count)), Permute(points.rows, y, h.y));
    const VU fine1 = hn::Add(hn::Mul(y, SplatU(points.columns.count)),
                             Permute(points.columns, x, h.z));
    *u0 = ToUnit(InStratum(points.strata, fine0, jitter.x));
    *u1 = ToUnit(InStratum(points.strata, fine1, jitter.y));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
