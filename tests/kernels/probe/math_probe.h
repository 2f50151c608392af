// Fresnel terms and sampling routines outside a render, in batches.
#pragma once

#include <cstdint>

#include "kernels/simd/target.h"

namespace lanelight {

/// Arrays of a batch hold `n` rounded up to a multiple of this.
inline constexpr int kMathPadding = 16;

struct FresnelBatch {
  std::uint32_t n = 0;
  const float* cosine = nullptr;  // of incidence, in [0, 1]
  const float* eta = nullptr;     // relative index: transmitted over incident, above 0
  const float* k = nullptr;       // extinction of a metal; null: a dielectric
  float* reflectance = nullptr;
  float* cos_t = nullptr;  // of a dielectric: refracted, 0 under total reflection
};

void ProbeFresnel(SimdTarget target, const FresnelBatch& batch);

enum class WarpId { kDisk, kCosine, kUniformHemisphere, kInSphere };
inline constexpr WarpId kWarpIds[] = {WarpId::kDisk, WarpId::kCosine,
                                      WarpId::kUniformHemisphere, WarpId::kInSphere};

struct WarpBatch {
  std::uint32_t n = 0;
  const float *u0, *u1;
  float *x, *y, *z, *pdf;
};

/// z of a point of the disk is 0.
void ProbeWarp(SimdTarget target, WarpId id, const WarpBatch& batch);

}  // namespace lanelight
