// The stages of all sample points: each policy, and its source, is in a file of its own.
#include "kernels/simd/each_target-inl.h"

#include "kernels/samplers/fill-inl.h"
#include "kernels/samplers/halton-inl.h"
#include "kernels/samplers/independent-inl.h"
#include "kernels/samplers/sobol-inl.h"
#include "kernels/samplers/stratified-inl.h"

LANELIGHT_BEGIN_KERNELS

constexpr FieldSet kSamplerCounter = {Field::pixel, Field::sample, Field::depth,
                                      Field::branch};

template <class Policy>
Stage SamplerCameraStage(const char* name, Feature policy) {
  return {
      .name = name,
      .meaning = "sample points of film, lens, time and wavelengths",
      .input = QueueId::kCamera,
      .role = StageRole::kSampling,
      .needs = {policy},
      .reads = kSamplerCounter,
      .writes = {Field::u_film_0, Field::u_film_1, Field::u_lens_0, Field::u_lens_1,
                 Field::time, Field::u_medium_0, Field::u_medium_1, Field::wavelength},
      .resolve = Always<FillCamera<Policy>>};
}

template <class Policy>
Stage SamplerBounceStage(const char* name, Feature policy) {
  return {.name = name,
          .meaning = "sample points of a bounce",
          .input = QueueId::kVertex,
          .role = StageRole::kSampling,
          .needs = {policy, Feature::kScatters},
          .reads = kSamplerCounter,
          .writes = fields::kBounceNumbers,
          .resolve = Always<FillBounce<Policy>>};
}

Stage IndependentCameraStage() {
  return SamplerCameraStage<IndependentSequence>("points_camera_independent",
                                                 Feature::kIndependentSampleSequence);
}
Stage IndependentBounceStage() {
  return SamplerBounceStage<IndependentSequence>("points_bounce_independent",
                                                 Feature::kIndependentSampleSequence);
}

Stage StratifiedCameraStage() {
  return SamplerCameraStage<StratifiedSequence>("points_camera_stratified",
                                                Feature::kStratifiedSampleSequence);
}
Stage StratifiedBounceStage() {
  return SamplerBounceStage<StratifiedSequence>("points_bounce_stratified",
                                                Feature::kStratifiedSampleSequence);
}

Stage SobolCameraStage() {
  return SamplerCameraStage<SobolSequence>("points_camera_sobol",
                                           Feature::kSobolSampleSequence);
}
Stage SobolBounceStage() {
  return SamplerBounceStage<SobolSequence>("points_bounce_sobol",
                                           Feature::kSobolSampleSequence);
}

Stage HaltonCameraStage() {
  return SamplerCameraStage<HaltonSequence>("points_camera_halton",
                                            Feature::kHaltonSampleSequence);
}
Stage HaltonBounceStage() {
  return SamplerBounceStage<HaltonSequence>("points_bounce_halton",
                                            Feature::kHaltonSampleSequence);
}

LANELIGHT_END_KERNELS
