// Stages of points=stratified; the estimator and its source: stratified-inl.h.
#include "kernels/simd/each_target-inl.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/stratified-inl.h"
#include "kernels/points/points.h"

LANELIGHT_BEGIN_KERNELS

Stage StratifiedCameraStage() {
  return PointsCameraStage("points_camera_stratified", Feature::kStratifiedPoints,
                           Always<FillCamera<StratifiedPoints>>);
}
Stage StratifiedBounceStage() {
  return PointsBounceStage("points_bounce_stratified", Feature::kStratifiedPoints,
                           Always<FillBounce<StratifiedPoints>>);
}

LANELIGHT_END_KERNELS
