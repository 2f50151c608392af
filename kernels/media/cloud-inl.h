// pbrt-v4's procedural cloud: noise whose threshold rises with the height.
#ifndef LANELIGHT_MEDIA_CLOUD_INL_H_
#define LANELIGHT_MEDIA_CLOUD_INL_H_

#include "kernels/media/medium-inl.h"
#include "kernels/texture/noise-inl.h"

LANELIGHT_BEGIN_KERNELS

/// Differences of the noise over 0.01, as pbrt-v4 approximates its derivatives.
LANELIGHT_INLINE V3 NoiseSlope(V3 p) {
  const VF step = Splat(0.01f), per_step = Splat(1 / 0.01f), here = Noise(p);
  const auto slope = [&](V3 beside) HWY_ATTR {
    return hn::Mul(hn::Sub(Noise(beside), here), per_step);
  };
  return {slope({hn::Add(p.x, step), p.y, p.z}), slope({p.x, hn::Add(p.y, step), p.z}),
          slope({p.x, p.y, hn::Add(p.z, step)})};
}

/// Density in [0, 1] at p of the box: five octaves of noise, looked up where two octaves
/// of it have moved the point to, times what is left of a height of 1, and solid below
/// 0.5.
inline HWY_NOINLINE VF CloudDensity(const CloudShape& cloud, V3 p) {
  const float *low = cloud.low, *size = cloud.size;
  const VF zero = Splat(0), one = Splat(1.0f);
  const VF height = hn::MulAdd(p.y, Splat(size[1]), Splat(low[1]));
  V3 at = Mul(V3{hn::MulAdd(p.x, Splat(size[0]), Splat(low[0])), height,
                 hn::MulAdd(p.z, Splat(size[2]), Splat(low[2]))},
              Splat(cloud.frequency));
  if (cloud.wispiness > 0) {
    float reach = 0.05f * cloud.wispiness, frequency = 10;
    for (int i = 0; i < 2; ++i) {
      at = at + Mul(NoiseSlope(Mul(at, Splat(frequency))), Splat(reach));
      reach *= 0.5f;
      frequency *= kLacunarity;
    }
  }
  const VF noise = hn::Mul(FBm(at, 5, 0.5f), Splat(0.5f));
  const VF amount = hn::Mul(hn::Sub(one, height), Splat(4.5f * cloud.density));
  const VF lumps = hn::Clamp(hn::Mul(amount, noise), zero, one);
  const VF solid = hn::Max(zero, hn::Sub(Splat(0.5f), height));
  return hn::Min(hn::MulAdd(Splat(2.0f), solid, lumps), one);
}

LANELIGHT_END_KERNELS

#endif
