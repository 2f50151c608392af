#include "src/scene/compile/materials.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "src/base/core/parallel.h"
#include "src/scene/compile/coat.h"

namespace lanelight {
namespace {

float RoughAlpha(const MaterialRow& row, double alpha) {
  if (row.kind == ShadeKind::kMix || row.kind == ShadeKind::kHair) {
    return static_cast<float>(alpha);  // not of a microfacet surface
  }
  return static_cast<float>(std::max(alpha, kMinAlpha));
}

void AddMaterialSpectra(const MaterialRow& row, SpectrumRows& spectra,
                        MaterialTable& table) {
  const bool metal = HasTrait(row.kind, kMetallic);
  const ColorBound bound = metal ? ColorBound::kUnbounded : ColorBound::kReflectance;
  const auto by_path = [&] {
    spectra.AddSigmoidTables();
    if (row.color_scale != 1) return PathColor::kScaledReflectance;
    if (!metal) return PathColor::kReflectance;
    return row.by_reflectance ? PathColor::kMetalExtinction : PathColor::kUnbounded;
  };
  const auto add = [&](const ColorValue& color, ColorBound of, auto& column) {
    column.push_back(color.texture == kNone ? spectra.Of(color, of)
                                            : static_cast<std::int32_t>(by_path()));
  };
  add(row.color0, bound, table.color0_spectrum);
  add(row.color1, bound, table.color1_spectrum);
  add(row.coat_albedo, ColorBound::kReflectance, table.coat_albedo_spectrum);
  table.color_scale.push_back(static_cast<float>(row.color_scale));
  table.eta_spectrum.push_back(
      row.dispersion == nullptr ? -1 : spectra.OfIndex(*row.dispersion));
}

// If a coat varies, the colour of its base is corrected for this node of the roughness
// (alpha 1/3) and a clear medium: the correction is small, and changes little with both.
constexpr int kTypicalAlpha = 6;

// Roughnesses of the tables of a coat, and thicknesses; see kCoatAlphas.
std::vector<double> Alphas(const Coat& coat) {
  if (coat.alpha) return {*coat.alpha};
  std::vector<double> alphas;
  for (int i = 0; i + 1 < kCoatAlphas; ++i) {
    const double part = i / (kCoatAlphas - 1.0);
    alphas.push_back(part / (1 - part));
  }
  alphas.push_back(kRoughestCoat);
  return alphas;
}

std::vector<double> Thicknesses(const Coat& coat) {
  if (coat.thickness) return {*coat.thickness};
  std::vector<double> thicknesses;
  for (int i = 0; i + 1 < kCoatDepths; ++i) {
    const double part = i / (kCoatDepths - 1.0);
    thicknesses.push_back(-std::log1p(-part * part));
  }
  thicknesses.push_back(1e3);  // nothing passes
  return thicknesses;
}

struct PlannedTable {
  double alpha, eta, thickness;
};

// The first table of every coat; appends its tables to the list.
std::vector<std::size_t> PlanTables(const std::map<Coat, std::int32_t>& coats,
                                    std::vector<PlannedTable>& tables) {
  std::vector<std::size_t> first(coats.size());
  for (const auto& [coat, at] : coats) {
    first[static_cast<std::size_t>(at)] = tables.size();
    for (double thickness : Thicknesses(coat)) {
      for (double alpha : Alphas(coat)) tables.push_back({alpha, coat.eta, thickness});
    }
  }
  return first;
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
  t.alpha2_x.push_back(RoughAlpha(row, row.alpha2_x.constant));
  t.alpha2_y.push_back(RoughAlpha(row, row.alpha2_y.constant));
  add(t.eta, row.eta);
  t.coat.push_back(row.coat);
  t.coat_internal.push_back(0);
  add(t.coat_thickness, row.coat_thickness.constant);
  add(t.coat_g, row.coat_g.constant);
  add(t.coat_albedo_r, row.coat_albedo.constant.x);
  add(t.coat_albedo_g, row.coat_albedo.constant.y);
  add(t.coat_albedo_b, row.coat_albedo.constant.z);
  t.coat_alphas.push_back(1);
  t.coat_depths.push_back(1);
  t.coat_depth.push_back(row.coat_depth);
  t.color0_texture.push_back(row.color0.texture);
  t.color1_texture.push_back(row.color1.texture);
  t.alpha_x_texture.push_back(row.alpha_x.texture);
  t.alpha_y_texture.push_back(row.alpha_y.texture);
  t.alpha2_x_texture.push_back(row.alpha2_x.texture);
  t.alpha2_y_texture.push_back(row.alpha2_y.texture);
  t.thickness_texture.push_back(row.coat_thickness.texture);
  t.coat_albedo_texture.push_back(row.coat_albedo.texture);
  t.coat_g_texture.push_back(row.coat_g.texture);
  t.alpha_remap.push_back(row.remap ? 1 : 0);
  t.mix0.push_back(row.mix[0]);
  t.mix1.push_back(row.mix[1]);
  t.displacement_texture.push_back(row.bump_maps.displacement);
  t.normal_map_texture.push_back(row.bump_maps.normal_map);
  t.names.push_back(row.name);
  for (Index texture :
       {row.color0.texture, row.color1.texture, row.alpha_x.texture, row.alpha_y.texture,
        row.alpha2_x.texture, row.alpha2_y.texture, row.coat_thickness.texture,
        row.coat_albedo.texture, row.coat_g.texture, row.bump_maps.displacement,
        row.bump_maps.normal_map}) {
    if (texture != kNone) out.textures.push_back(texture);
  }
  if (out.spectra != nullptr) AddMaterialSpectra(row, *out.spectra, t);
}

void SetBaseColor(MaterialTable& table, std::size_t i, int bounces) {
  const Rgb base =
      EffectiveCoatBase({table.color0_r[i], table.color0_g[i], table.color0_b[i]},
                        table.coat_internal[i], bounces);
  table.color0_r[i] = static_cast<float>(base.x);
  table.color0_g[i] = static_cast<float>(base.y);
  table.color0_b[i] = static_cast<float>(base.z);
}

void AddCoatTables(const std::map<Coat, std::int32_t>& coats, MaterialTable& table) {
  std::vector<PlannedTable> planned;
  const std::vector<std::size_t> first = PlanTables(coats, planned);
  std::vector<CoatTable> tables(planned.size());
  ParallelFor(planned.size(), [&](std::size_t i) {
    tables[i] = ComputeCoatTable(planned[i].alpha, planned[i].eta, planned[i].thickness);
  });
  for (const CoatTable& t : tables) {
    table.coat_transmittance.insert(table.coat_transmittance.end(),
                                    std::begin(t.transmittance),
                                    std::end(t.transmittance));
    table.coat_internals.push_back(t.internal_reflectance);
  }
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table.coat[i] < 0) continue;
    const std::size_t at = first[static_cast<std::size_t>(table.coat[i])];
    table.coat[i] = static_cast<std::int32_t>(at) * kCoatTableSize;
    const bool alphas = table.alpha_x_texture[i] >= 0 || table.alpha_y_texture[i] >= 0;
    table.coat_alphas[i] = alphas ? kCoatAlphas : 1;
    table.coat_depths[i] = table.thickness_texture[i] >= 0 ? kCoatDepths : 1;
    const std::size_t typical = at + (alphas ? kTypicalAlpha : 0);
    table.coat_internal[i] = tables[typical].internal_reflectance;
  }
}

}  // namespace lanelight
