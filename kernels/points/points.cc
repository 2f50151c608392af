// The stages of all sample points: each policy, and its source, is in a file of its own.
#include "kernels/simd/each_target-inl.h"

#include "kernels/points/cmj-inl.h"
#include "kernels/points/fill-inl.h"
#include "kernels/points/halton-inl.h"
#include "kernels/points/independent-inl.h"
#include "kernels/points/lattice-inl.h"
#include "kernels/points/pmj02-inl.h"
#include "kernels/points/sobol-inl.h"
#include "kernels/points/stratified-inl.h"

LANELIGHT_BEGIN_KERNELS

constexpr FieldSet kPointsCounter = {Field::pixel, Field::sample, Field::depth,
                                     Field::branch};

template <class Policy>
Stage PointsCameraStage(const char* name, Feature policy) {
  return {
      .name = name,
      .meaning = "sample points of film, lens, time and wavelengths",
      .input = QueueId::kCamera,
      .role = StageRole::kSampling,
      .needs = {policy},
      .reads = kPointsCounter,
      .writes = {Field::u_film_0, Field::u_film_1, Field::u_lens_0, Field::u_lens_1,
                 Field::time, Field::u_medium_0, Field::u_medium_1, Field::wavelength},
      .resolve = Always<FillCamera<Policy>>};
}

template <class Policy>
Stage PointsBounceStage(const char* name, Feature policy) {
  return {.name = name,
          .meaning = "sample points of a bounce",
          .input = QueueId::kVertex,
          .role = StageRole::kSampling,
          .needs = {policy, Feature::kScatters},
          .reads = kPointsCounter,
          .writes = fields::kBouncePoints,
          .resolve = Always<FillBounce<Policy>>};
}

Stage IndependentCameraStage() {
  return PointsCameraStage<IndependentPoints>("points_camera_independent",
                                              Feature::kIndependentPoints);
}
Stage IndependentBounceStage() {
  return PointsBounceStage<IndependentPoints>("points_bounce_independent",
                                              Feature::kIndependentPoints);
}

Stage StratifiedCameraStage() {
  return PointsCameraStage<StratifiedPoints>("points_camera_stratified",
                                             Feature::kStratifiedPoints);
}
Stage StratifiedBounceStage() {
  return PointsBounceStage<StratifiedPoints>("points_bounce_stratified",
                                             Feature::kStratifiedPoints);
}

Stage CmjCameraStage() {
  return PointsCameraStage<CmjPoints>("points_camera_cmj", Feature::kCmjPoints);
}
Stage CmjBounceStage() {
  return PointsBounceStage<CmjPoints>("points_bounce_cmj", Feature::kCmjPoints);
}

Stage Pmj02CameraStage() {
  return PointsCameraStage<Pmj02Points>("points_camera_pmj02", Feature::kPmj02Points);
}
Stage Pmj02BounceStage() {
  return PointsBounceStage<Pmj02Points>("points_bounce_pmj02", Feature::kPmj02Points);
}

Stage SobolCameraStage() {
  return PointsCameraStage<SobolPoints>("points_camera_sobol", Feature::kSobolPoints);
}
Stage SobolBounceStage() {
  return PointsBounceStage<SobolPoints>("points_bounce_sobol", Feature::kSobolPoints);
}

Stage HaltonCameraStage() {
  return PointsCameraStage<HaltonPoints>("points_camera_halton", Feature::kHaltonPoints);
}
Stage HaltonBounceStage() {
  return PointsBounceStage<HaltonPoints>("points_bounce_halton", Feature::kHaltonPoints);
}

Stage LatticeCameraStage() {
  return PointsCameraStage<LatticePoints>("points_camera_lattice",
                                          Feature::kLatticePoints);
}
Stage LatticeBounceStage() {
  return PointsBounceStage<LatticePoints>("points_bounce_lattice",
                                          Feature::kLatticePoints);
}

LANELIGHT_END_KERNELS
