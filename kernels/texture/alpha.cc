#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/texture/alpha.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/texture/alpha.h"
#include "kernels/texture/texture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

float EvalPlacedAlpha(const TextureTable& table, int32_t texture, float u, float v,
                      const PointOfAlpha& at) {
  const PlacedPoint point = {Splat(u), Splat(v), Splat3(at.p[0], at.p[1], at.p[2]),
                             Splat3(at.n[0], at.n[1], at.n[2])};
  return hn::GetLane(EvalTexture(table, texture, point).x);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lanelight {

HWY_EXPORT(EvalPlacedAlpha);

float AlphaAtPlace(const TextureTable& table, std::int32_t texture, float u, float v,
                   const PointOfAlpha& at) {
  return HWY_DYNAMIC_DISPATCH(EvalPlacedAlpha)(table, texture, u, v, at);
}

}  // namespace lanelight
#endif
