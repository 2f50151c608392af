// Stages of points=cmj; the estimator and its source: cmj-inl.h.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/points/cmj.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/cmj-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void CmjCamera(Wave& wave) { FillCamera<CmjPoints>(wave); }
void CmjBounce(Wave& wave) { FillBounce<CmjPoints>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/points/points.h"

namespace lanelight {

HWY_EXPORT(CmjCamera);
HWY_EXPORT(CmjBounce);

Stage CmjCameraStage() {
  return PointsCameraStage(
      "points_camera_cmj", Feature::kCmjPoints,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(CmjCamera); });
}
Stage CmjBounceStage() {
  return PointsBounceStage(
      "points_bounce_cmj", Feature::kCmjPoints,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(CmjBounce); });
}

}  // namespace lanelight
#endif  // HWY_ONCE
