// One material on its way into MaterialTable.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "src/base/image/measured_reflectance.h"
#include "src/scene/compile/materials.h"
#include "src/scene/compile/relief.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Floor of alpha on rough surfaces, as in pbrt-v4 (an anisotropic surface may be smooth
/// along one axis only).
inline constexpr double kMinAlpha = 1e-4;

/// One row of MaterialTable, in double precision.
struct MaterialRow {
  ShadeKind kind = ShadeKind::kDiffuse;
  ColorValue color0, color1;
  double color_scale = 1;       // of diffusetransmission, as in MaterialTable
  bool by_reflectance = false;  // a metal: color1 comes of its reflectance
  FloatValue alpha_x, alpha_y, alpha2_x, alpha2_y;
  double eta = 1;
  OwnSpectrum dispersion;  // the same by wavelength, or null
  std::int32_t coat = -1;  // index of the coat, not yet an offset
  FloatValue coat_thickness;
  FloatValue coat_g;
  ColorValue coat_albedo;
  std::uint32_t coat_depth = 0;
  bool remap = false;
  std::int32_t mix[2] = {-1, -1};
  Relief relief;
  std::shared_ptr<const MeasuredReflectance> measured;
  std::string name;
};

/// The parameters of a coat's tables; equal coats share them. Alpha or thickness is
/// absent if it is textured.
struct Coat {
  std::optional<double> alpha;
  double eta = 1;
  std::optional<double> thickness;
  friend auto operator<=>(const Coat&, const Coat&) = default;
};

/// Appends the row to every column, its spectra where there are some, and its textures to
/// the list of those in use.
void AddMaterialRow(const MaterialRow& row, CompiledMaterials& out);

/// Computes the tables of every coat, in parallel, and completes the rows that have one.
void AddCoatTables(const std::map<Coat, std::int32_t>& coats, MaterialTable& table);
/// The constant colour of a base below a coat, as it acts on light (coat_color.h).
void SetBaseColor(MaterialTable& table, std::size_t i, int bounces);

}  // namespace lanelight
