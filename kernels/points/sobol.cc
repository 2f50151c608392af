// Stages of points=sobol; the estimator and its source: sobol-inl.h.
#include "kernels/simd/each_target-inl.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/sobol-inl.h"
#include "kernels/points/points.h"

LANELIGHT_BEGIN_KERNELS

Stage SobolCameraStage() {
  return PointsCameraStage("points_camera_sobol", Feature::kSobolPoints,
                           Always<FillCamera<SobolPoints>>);
}
Stage SobolBounceStage() {
  return PointsBounceStage("points_bounce_sobol", Feature::kSobolPoints,
                           Always<FillBounce<SobolPoints>>);
}

LANELIGHT_END_KERNELS
