// points=lattice: a rank-1 lattice with a random shift, padded from pairs.
//   estimator   mean of f(frac(i / n + s), frac(i z / n + t)) over i < n, with n the size
//               of the group, z from LatticeGenerator, (s, t) uniform
//   unbiased    the shift makes every point uniform, for any n; the order of the points
//               is a random permutation
//   variance    sum of |f^(h, k)|^2 over the frequencies with h + k z = 0 modulo n: near
//               N^-4 for smooth periodic f, N^-2 for smooth f whose opposite edges do not
//               meet, N^-3/2 at edges. In one dimension the points are equidistant
//   dependence  the samples of one group share one shift: one observation
//   cost        a hash, a permutation and two wide multiplications per point
// Sources: Cranley and Patterson 1976; Sloan and Joe 1994.
#if defined(LANELIGHT_POINTS_LATTICE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_POINTS_LATTICE_INL_H_
#undef LANELIGHT_POINTS_LATTICE_INL_H_
#else
#define LANELIGHT_POINTS_LATTICE_INL_H_
#endif

#include "kernels/points/permute-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct LatticePoints {
  static LANELIGHT_INLINE GroupIndex Group(const PointsParameters& points, VU sample) {
    return GroupByDivision(points, sample);
  }

  static LANELIGHT_INLINE void Point(const PointsParameters& points, VU pixel,
                                     GroupIndex at, VU key, VU seed, VF* u0, VF* u1) {
    const U4 h = Pcg4d({pixel, at.group, key, seed});
    const VU i = Permute(points.strata, at.index, h.x);
    const VU x = TimesFraction(i, points.strata.whole, points.strata.part);
    const VU y = TimesFraction(i, points.lattice_whole, points.lattice_part);
    *u0 = ToUnit(hn::Add(x, h.y));
    *u1 = ToUnit(hn::Add(y, h.z));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
