// Materials as the kernels read them: one column per parameter.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/core/aligned.h"
#include "src/path/shade_kinds.h"

namespace lanelight {

/// Transmittance of a (rough) dielectric coat seen from outside, tabulated over
/// mu = |cos theta| at (i / (kCoatTableSize - 1)); see src/compile/coat_table.h.
inline constexpr int kCoatTableSize = 64;

/// One column per parameter, one entry per material. A texture index >= 0 replaces the
/// constant. What color0 and color1 are depends on the kind:
///   diffuse*, coateddiffuse*: color0 = reflectance
///   diffusetransmission: color0 = reflectance, color1 = transmittance
///   conductor*, coatedconductor: color0 = eta, color1 = k (of the metal relative to
///     what is above it)
///   kMix: alpha_x = amount of the second; mix0, mix1 = materials
struct MaterialTable {
  AlignedVector<std::uint32_t> kind;  // ShadeKind
  AlignedVector<float> color0_r, color0_g, color0_b;
  AlignedVector<float> color1_r, color1_g, color1_b;
  AlignedVector<float> alpha_x, alpha_y;    // GGX alpha of the (outer) interface
  AlignedVector<float> alpha2_x, alpha2_y;  // of the metal below a coat
  AlignedVector<float> eta;                 // relative index of the dielectric
  AlignedVector<std::int32_t> coat;     // offset of its table in coat_transmittance, -1
  AlignedVector<float> coat_internal;   // mean internal reflectance under the coat
  AlignedVector<float> coat_thickness;  // of a coat: the medium absorbs exp(-t / cos)
  AlignedVector<std::uint32_t> coat_depth;  // layer crossings at most (pbrt's maxdepth)
  AlignedVector<std::int32_t> color0_texture, color1_texture;
  AlignedVector<std::int32_t> alpha_x_texture, alpha_y_texture;
  AlignedVector<std::uint32_t> alpha_remap;  // 1: textured roughness goes through sqrt
  AlignedVector<std::int32_t> mix0, mix1;
  AlignedVector<float> coat_transmittance;  // kCoatTableSize per distinct coat
  std::vector<std::string> names;
  std::size_t size() const { return kind.size(); }
};

}  // namespace lanelight
