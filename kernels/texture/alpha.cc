#include "kernels/simd/each_target-inl.h"

#include "kernels/texture/alpha-inl.h"
#include "kernels/texture/texture-inl.h"

LANELIGHT_BEGIN_KERNELS

float AlphaAtPlace(const TextureTable& table, int32_t texture, float u, float v,
                   const PointOfAlpha& at) {
  const PlacedPoint point = {Splat(u), Splat(v), Splat3(at.p[0], at.p[1], at.p[2]),
                             Splat3(at.n[0], at.n[1], at.n[2])};
  return hn::GetLane(EvalTexture(table, texture, point).x);
}

LANELIGHT_END_KERNELS
