// Stages of points=independent; the estimator and its source: independent-inl.h.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/points/independent.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/independent-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void IndependentCamera(Wave& wave) { FillCamera<IndependentPoints>(wave); }
void IndependentBounce(Wave& wave) { FillBounce<IndependentPoints>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/points/points.h"

namespace lanelight {

HWY_EXPORT(IndependentCamera);
HWY_EXPORT(IndependentBounce);

Stage IndependentCameraStage() {
  return PointsCameraStage("points_camera_independent", Feature::kIndependentPoints,
                           [](const FeatureSet&) -> StageFn {
                             return HWY_DYNAMIC_DISPATCH(IndependentCamera);
                           });
}
Stage IndependentBounceStage() {
  return PointsBounceStage("points_bounce_independent", Feature::kIndependentPoints,
                           [](const FeatureSet&) -> StageFn {
                             return HWY_DYNAMIC_DISPATCH(IndependentBounce);
                           });
}

}  // namespace lanelight
#endif  // HWY_ONCE
