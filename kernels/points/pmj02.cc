// Stages of points=pmj02; the estimator and its source: pmj02-inl.h.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/points/pmj02.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/pmj02-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void Pmj02Camera(Wave& wave) { FillCamera<Pmj02Points>(wave); }
void Pmj02Bounce(Wave& wave) { FillBounce<Pmj02Points>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/points/points.h"

namespace lanelight {

HWY_EXPORT(Pmj02Camera);
HWY_EXPORT(Pmj02Bounce);

Stage Pmj02CameraStage() {
  return PointsCameraStage(
      "points_camera_pmj02", Feature::kPmj02Points,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(Pmj02Camera); });
}
Stage Pmj02BounceStage() {
  return PointsBounceStage(
      "points_bounce_pmj02", Feature::kPmj02Points,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(Pmj02Bounce); });
}

}  // namespace lanelight
#endif  // HWY_ONCE
