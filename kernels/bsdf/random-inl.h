// Random numbers for materials that are evaluated by a random walk and so need more than
// the three sample points of a bounce: a counter-based hash of the path's own identity.
#ifndef LANELIGHT_BSDF_RANDOM_INL_H_
#define LANELIGHT_BSDF_RANDOM_INL_H_

#include "kernels/simd/rng-inl.h"
#include "kernels/simd/vec3-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Uniform numbers in [0, 1) with 24 bits, a pure function of the four key words and of
/// how many were drawn before. Each hash (Pcg4d) gives four numbers. The counter advances
/// with every call of Next4, whichever lanes need it, so lanes never influence each
/// other.
struct LaneRandom {
  /// Combined with the seed, keeps these numbers apart from the sample points.
  static constexpr std::uint32_t kStream = 0x7feb352du;

  VU pixel, sample, depth, seed;

  HWY_NOINLINE void Next4(VF out[4]) {
    const U4 bits = Pcg4d({pixel, sample, depth, seed});
    out[0] = ToUnit(bits.x);
    out[1] = ToUnit(bits.y);
    out[2] = ToUnit(bits.z);
    out[3] = ToUnit(bits.w);
    // The bounce number uses the low bits of `depth`; draws count above them.
    depth = hn::Add(depth, SplatU(1u << 20));
  }
};

LANELIGHT_END_KERNELS

#endif
