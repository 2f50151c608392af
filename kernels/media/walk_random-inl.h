// Random numbers of walks through media, whose count is not known beforehand.
#ifndef LANELIGHT_MEDIA_WALK_RANDOM_INL_H_
#define LANELIGHT_MEDIA_WALK_RANDOM_INL_H_

#include "hwy/contrib/math/math-inl.h"

#include "kernels/queue/batch-inl.h"
#include "kernels/simd/rng-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Exponential with mean 1, from u in [0, 1).
LANELIGHT_INLINE VF ExponentialOf(VF u) {
  return hn::Neg(hn::Log(DF(), hn::Sub(Splat(1.0f), u)));
}

/// Uniform numbers for walks of any length: hashes of who the path is, where on it, and
/// of how many were drawn before.
struct WalkRandom {
  VU pixel, sample, key, seed;

  LANELIGHT_INLINE WalkRandom(const Wave& wave, const Slots& slots, uint32_t purpose) {
    const PathColumns& p = wave.path;
    pixel = AsUnsigned(Gather(p.pixel, slots));
    sample = AsUnsigned(Gather(p.sample, slots));
    key = AsUnsigned(Gather(p.depth, slots));
    seed = SplatU(wave.run->seed ^ purpose);
    if (p.branch != nullptr) {
      const VU branch = AsUnsigned(Gather(p.branch, slots));
      key = hn::Or(key, hn::ShiftLeft<24>(branch));
    }
    if (p.crossings != nullptr) {
      const VU crossings = AsUnsigned(Gather(p.crossings, slots));
      seed = hn::Add(seed, hn::Mul(crossings, SplatU(0x632be5abu)));
    }
  }
  /// Two independent numbers in [0, 1).
  LANELIGHT_INLINE void Next(VF* u0, VF* u1) {
    const U4 bits = Pcg4d({pixel, sample, key, seed});
    *u0 = ToUnit(bits.x), *u1 = ToUnit(bits.y);
    seed = hn::Add(seed, SplatU(0x9e3779b9u));
  }
  /// The same for the lanes of `mask` only, so that a lane's numbers do not depend on the
  /// lanes beside it.
  LANELIGHT_INLINE void NextWhere(MF mask, VF* u0, VF* u1) {
    const VU before = seed;
    Next(u0, u1);
    seed = hn::IfThenElse(hn::RebindMask(DU(), mask), seed, before);
  }
};

LANELIGHT_END_KERNELS

#endif
