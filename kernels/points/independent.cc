// Stages of points=independent; the estimator and its source: independent-inl.h.
#include "kernels/simd/each_target-inl.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/independent-inl.h"
#include "kernels/points/points.h"

LANELIGHT_BEGIN_KERNELS

Stage IndependentCameraStage() {
  return PointsCameraStage("points_camera_independent", Feature::kIndependentPoints,
                           Always<FillCamera<IndependentPoints>>);
}
Stage IndependentBounceStage() {
  return PointsBounceStage("points_bounce_independent", Feature::kIndependentPoints,
                           Always<FillBounce<IndependentPoints>>);
}

LANELIGHT_END_KERNELS
