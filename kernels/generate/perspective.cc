// Rays from one point through a film at depth 1.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/generate/perspective.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/generate/camera-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct Perspective {
  static HWY_INLINE CameraRay Project(V3 film) { return {Splat3(0, 0, 0), film}; }
};

StageFn ResolvePerspective(const FeatureSet& features) {
  return ResolveCamera<Perspective>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/generate/camera_stage.h"

namespace lanelight {

HWY_EXPORT(ResolvePerspective);

Stage PerspectiveCameraStage() {
  return MakeCameraStage("camera_perspective",
                         "rays from one point, and the first values of a path",
                         Feature::kPerspective, [](const FeatureSet& features) {
                           return HWY_DYNAMIC_DISPATCH(ResolvePerspective)(features);
                         });
}

}  // namespace lanelight
#endif  // HWY_ONCE
