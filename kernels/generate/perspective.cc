// Rays from one point through a film at depth 1.
#include "kernels/simd/each_target-inl.h"

#include "kernels/generate/camera-inl.h"

LANELIGHT_BEGIN_KERNELS

struct Perspective {
  static HWY_INLINE CameraRay Project(V3 film) { return {Splat3(0, 0, 0), film}; }
};

Stage PerspectiveCameraStage() {
  return MakeCameraStage("camera_perspective",
                         "rays from one point, and the first values of a path",
                         Feature::kPerspective, ResolveCamera<Perspective>);
}

LANELIGHT_END_KERNELS
