// Parallel rays. Each point of the film has a lens of its own, so that what lies at the
// depth of focus is sharp everywhere.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/generate/orthographic.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/generate/camera-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct Orthographic {
  static HWY_INLINE CameraRay Project(V3 film) { return {film, Splat3(0, 0, 1)}; }
};

StageFn ResolveOrthographic(const FeatureSet& features) {
  return ResolveCamera<Orthographic>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/generate/camera_stage.h"

namespace lanelight {

HWY_EXPORT(ResolveOrthographic);

Stage OrthographicCameraStage() {
  return MakeCameraStage("camera_orthographic",
                         "parallel rays, and the first values of a path",
                         Feature::kOrthographic, [](const FeatureSet& features) {
                           return HWY_DYNAMIC_DISPATCH(ResolveOrthographic)(features);
                         });
}

}  // namespace lanelight
#endif  // HWY_ONCE
