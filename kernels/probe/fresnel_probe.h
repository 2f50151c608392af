// Fresnel terms outside a material: batches of incidences in, reflectances out.
#pragma once

#include <cstdint>

#include "kernels/simd/target.h"

namespace lanelight {

/// Arrays hold `n` rounded up to a multiple of kFresnelPadding.
inline constexpr std::uint32_t kFresnelPadding = 16;
struct FresnelBatch {
  std::uint32_t n = 0;
  const float* cosine = nullptr;  // of incidence, in [0, 1]
  const float* eta = nullptr;     // relative index: transmitted over incident, above 0
  const float* k = nullptr;       // extinction of a metal; null: a dielectric
  float* reflectance = nullptr;
  float* cos_t = nullptr;  // of a dielectric: refracted, 0 under total reflection
};

void ProbeFresnel(SimdTarget target, const FresnelBatch& batch);

}  // namespace lanelight
