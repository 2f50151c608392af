// Stages of points=lattice; the estimator and its source: lattice-inl.h.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/points/lattice.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/lattice-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

void LatticeCamera(Wave& wave) { FillCamera<LatticePoints>(wave); }
void LatticeBounce(Wave& wave) { FillBounce<LatticePoints>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/points/points.h"

namespace lanelight {

HWY_EXPORT(LatticeCamera);
HWY_EXPORT(LatticeBounce);

Stage LatticeCameraStage() {
  return PointsCameraStage(
      "points_camera_lattice", Feature::kLatticePoints,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(LatticeCamera); });
}
Stage LatticeBounceStage() {
  return PointsBounceStage(
      "points_bounce_lattice", Feature::kLatticePoints,
      [](const FeatureSet&) -> StageFn { return HWY_DYNAMIC_DISPATCH(LatticeBounce); });
}

}  // namespace lanelight
#endif  // HWY_ONCE
