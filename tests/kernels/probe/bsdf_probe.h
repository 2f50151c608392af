// Material policies on their own, without an engine: batches of directions in, values and
// samples out.
#pragma once

#include <cstdint>

#include "kernels/simd/target.h"
#include "src/scene/compiled/materials.h"

namespace lanelight {

/// Arrays hold `n` rounded up to a multiple of kProbePadding; directions are unit, in the
/// local frame of the shading normal (+z).
inline constexpr std::uint32_t kProbePadding = 16;
struct BsdfBatch {
  const MaterialTable* materials = nullptr;
  std::uint32_t material = 0;  // row of the table, for all
  std::uint32_t n = 0;
  std::uint32_t seed = 0;             // of materials that are evaluated by a random walk
  const float* uv_v = nullptr;        // of fibres: v, for all, at the place of `material`
  const float* wavelength = nullptr;  // of spectra: the number of the paths, likewise
  const float* wo[3] = {};
  const float* u[3] = {};      // Sample: lobe and direction, in [0, 1)
  float* wi[3] = {};           // Eval: in; Sample: out
  float* value[3] = {};        // Eval: f |cos|; Sample: f |cos| / density
  float* pdf = nullptr;        // solid angle; Sample: 0 for a delta direction
  float* eta_scale = nullptr;  // Sample only
};

struct BsdfProbe {
  void (*eval)(const BsdfBatch&) = nullptr;  // null for purely specular materials
  void (*sample)(const BsdfBatch&) = nullptr;
};

/// Throws CheckFailure for a kind without kernels.
BsdfProbe GetBsdfProbe(SimdTarget target, ShadeKind kind);

}  // namespace lanelight
