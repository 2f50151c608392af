// Stages of points=stratified; the estimator and its source: stratified-inl.h.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/points/stratified.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/stratified-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void StratifiedCamera(Wave& wave) { FillCamera<StratifiedPoints>(wave); }
void StratifiedBounce(Wave& wave) { FillBounce<StratifiedPoints>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/points/points.h"

namespace lanelight {

HWY_EXPORT(StratifiedCamera);
HWY_EXPORT(StratifiedBounce);

Stage StratifiedCameraStage() {
  return PointsCameraStage("points_camera_stratified", Feature::kStratifiedPoints,
                           [](const FeatureSet&) -> StageFn {
                             return HWY_DYNAMIC_DISPATCH(StratifiedCamera);
                           });
}
Stage StratifiedBounceStage() {
  return PointsBounceStage("points_bounce_stratified", Feature::kStratifiedPoints,
                           [](const FeatureSet&) -> StageFn {
                             return HWY_DYNAMIC_DISPATCH(StratifiedBounce);
                           });
}

}  // namespace lanelight
#endif  // HWY_ONCE
