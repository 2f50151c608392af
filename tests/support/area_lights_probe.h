// The closed forms of control=analytic outside a render, for tests and benches.
#pragma once

#include <cstdint>

#include "kernels/simd/target.h"
#include "src/compiled/scene.h"

namespace lanelight {

/// A light and a batch of receivers; arrays hold `n` rounded up to a multiple of 16.
struct IrradianceBatch {
  const CompiledScene* scene = nullptr;  // geometry, and the light table
  std::uint32_t n = 0;
  const float* p[3] = {};
  const float* normal[3] = {};  // unit
  float* above[3] = {};         // out: irradiance on the side of the normal
  float* below[3] = {};         // out: on the other side
  float* takes_part = nullptr;  // out: 1 where light 0 takes part, else 0
};

void ProbeAreaLights(SimdTarget target, const IrradianceBatch& batch);

}  // namespace lanelight
