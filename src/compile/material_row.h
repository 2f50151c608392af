// One material on its way into MaterialTable.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "src/compile/materials.h"
#include "src/compiled/scene.h"
#include "src/scene/description.h"

namespace lanelight {

/// Floor of alpha on rough surfaces, as in pbrt-v4 (an anisotropic surface may be smooth
/// along one axis only).
inline constexpr double kMinAlpha = 1e-4;

/// One row of MaterialTable, in double precision.
struct MaterialRow {
  ShadeKind kind = ShadeKind::kDiffuse;
  ColorValue color0, color1;
  FloatValue alpha_x, alpha_y;
  double alpha2_x = 0, alpha2_y = 0, eta = 1;
  std::int32_t coat = -1;  // index of the coat, not yet an offset
  double coat_thickness = 0;
  std::uint32_t coat_depth = 0;
  bool remap = false;
  std::int32_t mix[2] = {-1, -1};
  std::string name;
};

/// Coats that are equal share a table.
using Coat = std::tuple<double, double, double>;  // alpha, eta, thickness

/// Appends the row to every column, and its textures to the list of those in use.
void AddMaterialRow(const MaterialRow& row, CompiledMaterials& out);

/// Computes the table of every coat, in parallel, and completes the rows that have one.
void AddCoatTables(const std::map<Coat, std::int32_t>& coats, MaterialTable& table);

}  // namespace lanelight
