// Stages of points=sobol; the estimator and its source: sobol-inl.h.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/points/sobol.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/sobol-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void SobolCamera(Wave& wave) { FillCamera<SobolPoints>(wave); }
void SobolBounce(Wave& wave) { FillBounce<SobolPoints>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/points/points.h"

namespace lanelight {

HWY_EXPORT(SobolCamera);
HWY_EXPORT(SobolBounce);

Stage SobolCameraStage() {
  return PointsCameraStage(
      "points_camera_sobol", Feature::kSobolPoints,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(SobolCamera); });
}
Stage SobolBounceStage() {
  return PointsBounceStage(
      "points_bounce_sobol", Feature::kSobolPoints,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(SobolBounce); });
}

}  // namespace lanelight
#endif  // HWY_ONCE
