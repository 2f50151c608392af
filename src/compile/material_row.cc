#include "src/compile/material_row.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "src/core/parallel.h"
#include "src/compile/coat_color.h"
#include "src/compile/coat_table.h"

namespace lanelight {
namespace {

float RoughAlpha(const MaterialRow& row, double alpha) {
  if (row.kind == ShadeKind::kMix) return static_cast<float>(alpha);
  return static_cast<float>(std::max(alpha, kMinAlpha));
}

}  // namespace

void AddMaterialRow(const MaterialRow& row, CompiledMaterials& out) {
  MaterialTable& t = out.table;
  const auto add = [](auto& column, double v) {
    column.push_back(static_cast<float>(v));
  };
  t.kind.push_back(static_cast<std::uint32_t>(row.kind));
  add(t.color0_r, row.color0.constant.x);
  add(t.color0_g, row.color0.constant.y);
  add(t.color0_b, row.color0.constant.z);
  add(t.color1_r, row.color1.constant.x);
  add(t.color1_g, row.color1.constant.y);
  add(t.color1_b, row.color1.constant.z);
  t.alpha_x.push_back(RoughAlpha(row, row.alpha_x.constant));
  t.alpha_y.push_back(RoughAlpha(row, row.alpha_y.constant));
  t.alpha2_x.push_back(RoughAlpha(row, row.alpha2_x));
  t.alpha2_y.push_back(RoughAlpha(row, row.alpha2_y));
  add(t.eta, row.eta);
  t.coat.push_back(row.coat < 0 ? -1 : row.coat * kCoatTableSize);
  t.coat_internal.push_back(0);
  add(t.coat_thickness, row.coat_thickness);
  t.coat_depth.push_back(row.coat_depth);
  t.color0_texture.push_back(row.color0.texture);
  t.color1_texture.push_back(row.color1.texture);
  t.alpha_x_texture.push_back(row.alpha_x.texture);
  t.alpha_y_texture.push_back(row.alpha_y.texture);
  t.alpha_remap.push_back(row.remap ? 1 : 0);
  t.mix0.push_back(row.mix[0]);
  t.mix1.push_back(row.mix[1]);
  t.names.push_back(row.name);
  for (Index texture : {row.color0.texture, row.color1.texture, row.alpha_x.texture,
                        row.alpha_y.texture}) {
    if (texture != kNone) out.textures.push_back(texture);
  }
}

namespace {

// The base below a coat acts on light as a spectrum; see coat_color.h. Textured colours
// stay as they are: the correction is no linear map, so it would have to follow the
// filter and the arithmetic of textures, and images of real surfaces change by less than
// 1 %.
void SetBaseColor(MaterialTable& table, std::size_t i) {
  const auto kind = static_cast<ShadeKind>(table.kind[i]);
  const bool diffuse_base =
      kind == ShadeKind::kCoatedDiffuseSmooth || kind == ShadeKind::kCoatedDiffuseRough;
  if (!diffuse_base || table.color0_texture[i] >= 0) return;
  const Rgb base = EffectiveCoatBase(
      {table.color0_r[i], table.color0_g[i], table.color0_b[i]}, table.coat_internal[i],
      static_cast<int>((table.coat_depth[i] + 1) / 2));
  table.color0_r[i] = static_cast<float>(base.x);
  table.color0_g[i] = static_cast<float>(base.y);
  table.color0_b[i] = static_cast<float>(base.z);
}

}  // namespace

void AddCoatTables(const std::map<Coat, std::int32_t>& coats, MaterialTable& table) {
  std::vector<Coat> list(coats.size());
  for (const auto& [coat, at] : coats) list[static_cast<std::size_t>(at)] = coat;
  std::vector<CoatTable> tables(list.size());
  ParallelFor(list.size(),
              [&](std::size_t i) { tables[i] = std::apply(ComputeCoatTable, list[i]); });
  for (const CoatTable& t : tables) {
    table.coat_transmittance.insert(table.coat_transmittance.end(),
                                    std::begin(t.transmittance),
                                    std::end(t.transmittance));
  }
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.coat[i] < 0) continue;
    const auto at = static_cast<std::size_t>(table.coat[i] / kCoatTableSize);
    table.coat_internal[i] = tables[at].internal_reflectance;
    SetBaseColor(table, i);
  }
}

}  // namespace lanelight
