// Stages of points=pmj02; the estimator and its source: pmj02-inl.h.
#include "kernels/simd/each_target-inl.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/pmj02-inl.h"
#include "kernels/points/points.h"

LANELIGHT_BEGIN_KERNELS

Stage Pmj02CameraStage() {
  return PointsCameraStage("points_camera_pmj02", Feature::kPmj02Points,
                           Always<FillCamera<Pmj02Points>>);
}
Stage Pmj02BounceStage() {
  return PointsBounceStage("points_bounce_pmj02", Feature::kPmj02Points,
                           Always<FillBounce<Pmj02Points>>);
}

LANELIGHT_END_KERNELS
