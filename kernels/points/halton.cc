// Stages of points=halton; the estimator and its source: halton-inl.h.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/points/halton.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/halton-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void HaltonCamera(Wave& wave) { FillCamera<HaltonPoints>(wave); }
void HaltonBounce(Wave& wave) { FillBounce<HaltonPoints>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/points/points.h"

namespace lanelight {

HWY_EXPORT(HaltonCamera);
HWY_EXPORT(HaltonBounce);

Stage HaltonCameraStage() {
  return PointsCameraStage(
      "points_camera_halton", Feature::kHaltonPoints,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(HaltonCamera); });
}
Stage HaltonBounceStage() {
  return PointsBounceStage(
      "points_bounce_halton", Feature::kHaltonPoints,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(HaltonBounce); });
}

}  // namespace lanelight
#endif  // HWY_ONCE
