// Cameras with a plane film. Perspective: rays from one point through a film at depth 1.
// Orthographic: parallel rays; each film point has its own lens, so that the plane of
// focus is sharp everywhere.
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

struct Orthographic {
  static HWY_INLINE CameraRay Project(V3 film) { return {film, Splat3(0, 0, 1)}; }
};

Stage OrthographicCameraStage() {
  return MakeCameraStage("camera_orthographic",
                         "parallel rays, and the first values of a path",
                         Feature::kOrthographic, ResolveCamera<Orthographic>);
}

LANELIGHT_END_KERNELS
