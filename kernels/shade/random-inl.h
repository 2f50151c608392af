// Random numbers for materials that are evaluated by a random walk and so need more than
// the three sample points of a bounce: a counter-based hash of the path's own identity.
#if defined(LANELIGHT_SHADE_RANDOM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_SHADE_RANDOM_INL_H_
#undef LANELIGHT_SHADE_RANDOM_INL_H_
#else
#define LANELIGHT_SHADE_RANDOM_INL_H_
#endif

#include "kernels/simd/vec3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// Uniform numbers in [0, 1) with 24 bits, a pure function of the four key words and of
/// how many were drawn before. pcg4d of Jarzynski and Olano 2020, "Hash Functions for GPU
/// Rendering": each hash gives four numbers. The counter advances with every
/// call of Next4, whichever lanes need it, so lanes never influence each other.
struct LaneRandom {
  VU pixel, sample, depth, seed;

  HWY_INLINE void Next4(VF out[4]) {
    VU x = Scramble(pixel), y = Scramble(sample), z = Scramble(depth), w = Scramble(seed);
    Round(x, y, z, w);
    x = hn::Xor(x, hn::ShiftRight<16>(x));
    y = hn::Xor(y, hn::ShiftRight<16>(y));
    z = hn::Xor(z, hn::ShiftRight<16>(z));
    w = hn::Xor(w, hn::ShiftRight<16>(w));
    Round(x, y, z, w);
    out[0] = ToUnit(x);
    out[1] = ToUnit(y);
    out[2] = ToUnit(z);
    out[3] = ToUnit(w);
    // The bounce number uses the low bits of `depth`; draws count above them.
    depth = hn::Add(depth, hn::Set(DU(), 1u << 20));
  }

 private:
  HWY_INLINE static VU Scramble(VU v) {
    const DU du;
    return hn::Add(hn::Mul(v, hn::Set(du, 1664525u)), hn::Set(du, 1013904223u));
  }
  HWY_INLINE static void Round(VU& x, VU& y, VU& z, VU& w) {
    x = hn::Add(hn::Mul(y, w), x);
    y = hn::Add(hn::Mul(z, x), y);
    z = hn::Add(hn::Mul(x, y), z);
    w = hn::Add(hn::Mul(y, z), w);
  }
  HWY_INLINE static VF ToUnit(VU bits) {
    const VI high = hn::BitCast(DI(), hn::ShiftRight<8>(bits));
    return hn::Mul(hn::ConvertTo(DF(), high), Splat(0x1p-24f));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
