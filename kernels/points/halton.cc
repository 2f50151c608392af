// Stages of points=halton; the estimator and its source: halton-inl.h.
#include "kernels/simd/each_target-inl.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/halton-inl.h"
#include "kernels/points/points.h"

LANELIGHT_BEGIN_KERNELS

Stage HaltonCameraStage() {
  return PointsCameraStage("points_camera_halton", Feature::kHaltonPoints,
                           Always<FillCamera<HaltonPoints>>);
}
Stage HaltonBounceStage() {
  return PointsBounceStage("points_bounce_halton", Feature::kHaltonPoints,
                           Always<FillBounce<HaltonPoints>>);
}

LANELIGHT_END_KERNELS
