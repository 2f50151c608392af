// points=lattice: an extensible rank-1 lattice with a random shift, padded from pairs.
//   estimator   mean of f(frac(phi(i) + s), frac(phi(i) z + t)) with phi the
//               binary radical inverse, z = kLatticeGenerator, (s, t) uniform: any
//               aligned 2^m successive points are a shifted lattice of 2^m points
//   unbiased    the shift makes every point uniform, for any N; the order of the
//               points is a random nested permutation
//   variance    of 2^m points: sum of |f^(h, k)|^2 over the frequencies with h + k z = 0
//               modulo 2^m: near N^-4 for smooth periodic f, N^-2 for smooth f whose
//               opposite edges do not meet, N^-3/2 at edges (measured from 4 to 2^14:
//               3.6, 1.8 to 2.0 and 1.6, as one z is not equally good for all m). In one
//               dimension the points are equidistant
//   dependence  the samples of one group share one shift: one observation
//   cost        a hash, a permutation and a multiplication per point
// Sources: Cranley and Patterson 1976; Hickernell, Hong, L'Ecuyer and Lemieux 2000
// ("Extensible lattice sequences").
#ifndef LANELIGHT_SAMPLERS_LATTICE_INL_H_
#define LANELIGHT_SAMPLERS_LATTICE_INL_H_

#include "kernels/samplers/sobol-inl.h"
#include "src/scene/prepare/lattice.h"

LANELIGHT_BEGIN_KERNELS

struct LatticeSequence : RoundRobinPoints {
  static LANELIGHT_INLINE void Point(const SamplerParameters&, const PointKey& of, VF* u0,
                                     VF* u1) {
    const auto& [pixel, at, key, seed] = of;
    const U4 h = Pcg4d({pixel, at.group, key, seed});
    const VU inverse = LaineKarras(ReverseBits32(at.index), h.x);  // phi in 2^-32
    *u0 = ToUnit(hn::Add(inverse, h.y));
    *u1 = ToUnit(hn::Add(hn::Mul(inverse, SplatU(kLatticeGenerator)), h.z));
  }
};

LANELIGHT_END_KERNELS

#endif
