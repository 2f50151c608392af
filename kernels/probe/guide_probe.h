// A guide on its own, outside a render: points in, cells out; numbers in, directions and
// densities out.
#pragma once

#include <cstdint>

#include "kernels/simd/target.h"
#include "src/prepare/guide.h"

namespace lanelight {

/// Arrays hold `n` rounded up to a multiple of kGuidePadding; cells must exist.
inline constexpr std::uint32_t kGuidePadding = 16;
struct GuideBatch {
  const Guide* guide = nullptr;
  std::uint32_t n = 0;
  const float *point[3] = {}, *normal[3] = {};  // of ProbeGuideCells
  std::uint32_t* cell = nullptr;                // its result, and what the others read
  const float *u0 = nullptr, *u1 = nullptr;     // of ProbeGuideSamples, in [0, 1)
  float* direction[3] = {};  // its result, and what ProbeGuidePdfs reads: unit, about z
  float* pdf_sa = nullptr;   // result
};

void ProbeGuideCells(SimdTarget target, const GuideBatch& batch);
void ProbeGuideSamples(SimdTarget target, const GuideBatch& batch);
void ProbeGuidePdfs(SimdTarget target, const GuideBatch& batch);

}  // namespace lanelight
