// Stages of points=lattice; the estimator and its source: lattice-inl.h.
#include "kernels/simd/each_target-inl.h"

#include "kernels/points/fill-inl.h"
#include "kernels/points/lattice-inl.h"
#include "kernels/points/points.h"

LANELIGHT_BEGIN_KERNELS

Stage LatticeCameraStage() {
  return PointsCameraStage("points_camera_lattice", Feature::kLatticePoints,
                           Always<FillCamera<LatticePoints>>);
}
Stage LatticeBounceStage() {
  return PointsBounceStage("points_bounce_lattice", Feature::kLatticePoints,
                           Always<FillBounce<LatticePoints>>);
}

LANELIGHT_END_KERNELS
