// Sampling routines outside a render: numbers in, points with densities out.
#pragma once

#include "kernels/simd/target.h"

namespace lanelight {

enum class WarpId { kDisk, kCosine, kUniformHemisphere, kInSphere };
inline constexpr WarpId kWarpIds[] = {WarpId::kDisk, WarpId::kCosine,
                                      WarpId::kUniformHemisphere, WarpId::kInSphere};

/// Arrays hold `n` rounded up to a multiple of kWarpPadding. (back0, back1): the inverse.
inline constexpr int kWarpPadding = 16;
struct WarpBatch {
  int n;
  const float *u0, *u1;
  float *x, *y, *z, *pdf, *back0, *back1;
};

/// z of a point of the disk is 0.
void ProbeWarp(SimdTarget target, WarpId id, const WarpBatch& batch);

}  // namespace lanelight
