// Stages of points=cmj; the estimator and its source: cmj-inl.h.
#include "kernels/simd/each_target-inl.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/cmj-inl.h"
#include "kernels/points/points.h"

LANELIGHT_BEGIN_KERNELS

Stage CmjCameraStage() {
  return PointsCameraStage("points_camera_cmj", Feature::kCmjPoints,
                           Always<FillCamera<CmjPoints>>);
}
Stage CmjBounceStage() {
  return PointsBounceStage("points_bounce_cmj", Feature::kCmjPoints,
                           Always<FillBounce<CmjPoints>>);
}

LANELIGHT_END_KERNELS
