#include "src/scene/compile/materials.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/base/core/check.h"

namespace lanelight {
namespace {

// Compiles materials in order of dependence: mixes after their sides.
class Builder {
 public:
  Builder(const SceneDescription& d, const CompileOptions& options, SpectrumRows* spectra)
      : d_(d),
        spectra_(spectra),
        build_(d, options),
        bump_maps_(d.textures, build_.derived()),
        index_(d.materials.size(), -1) {}

  // Depth first and without recursion, since mixes may be nested deeply.
  void Add(Index material) {
    std::vector<Index> open = {material};
    while (!open.empty()) {
      LL_CHECK_GE(open.back(), 0);
      const auto at = static_cast<std::size_t>(open.back());
      LL_CHECK_LT(at, d_.materials.size());
      const Material& m = d_.materials[at];
      const std::vector<Index> sides = Sides(m);
      const auto waits_for = std::ranges::find_if(
          sides, [&](Index side) { return index_[static_cast<std::size_t>(side)] < 0; });
      if (index_[at] < 0 && waits_for != sides.end()) {
        open.push_back(*waits_for);
        continue;
      }
      if (index_[at] < 0) index_[at] = Compile(m, sides);
      open.pop_back();
    }
  }

  CompiledMaterials Finish() {
    CompiledMaterials out;
    out.index = index_;
    out.spectra = spectra_;
    if (d_.integrator.force_diffuse) {
      Force(out.table);  // what scatters evenly has no roughness
    } else if (d_.integrator.regularize) {
      Regularize(out.table);
    }
    for (const MaterialRow& row : rows_) AddMaterialRow(row, out);
    AddMeasured(rows_, out.table.measured,
                spectra_ == nullptr ? Transport::kRgb : Transport::kSpectral);
    AddCoatTables(build_.coats(), out.table);
    if (spectra_ == nullptr) CorrectBases(out.table);
    for (const Texture& t : build_.derived()) {
      out.textures.push_back(static_cast<Index>(d_.textures.size() + out.derived.size()));
      out.derived.push_back(t);
    }
    DropUnusedBumpMaps(out.table);
    return out;
  }

 private:
  // Returns the materials of a mix; only one if the other has weight 0.
  std::vector<Index> Sides(const Material& m) const {
    if (m.kind != MaterialKind::kMix) return {};
    for (Index side : m.mix) {
      LL_CHECK_GE(side, 0);
      LL_CHECK_LT(static_cast<std::size_t>(side), d_.materials.size());
      if (d_.materials[static_cast<std::size_t>(side)].kind == MaterialKind::kInterface) {
        ThrowUnsupportedMaterial(
            m,
            "mixing with an \"interface\" material is not supported; for a "
            "cut-out use the shape's \"alpha\" parameter");
      }
    }
    const FloatValue amount = build_.constants().Fold(m.mix_amount);
    if (amount.texture == kNone && amount.constant <= 0) return {m.mix[0]};
    if (amount.texture == kNone && amount.constant >= 1) return {m.mix[1]};
    return {m.mix[0], m.mix[1]};
  }

  std::int32_t Mix(const Material& m, const std::vector<Index>& sides) {
    const auto row_of = [&](Index side) {
      return index_[static_cast<std::size_t>(side)];
    };
    if (sides.size() == 1) return row_of(sides[0]);
    MaterialRow row;
    row.kind = ShadeKind::kMix;
    row.name = m.name;
    row.alpha_x = build_.constants().Fold(m.mix_amount);
    row.mix[0] = row_of(sides[0]);
    row.mix[1] = row_of(sides[1]);
    return Push(std::move(row));
  }

  std::int32_t Compile(const Material& m, const std::vector<Index>& sides) {
    if (m.kind == MaterialKind::kMix) return Mix(m, sides);
    MaterialRow row = build_.RowOf(m);
    row.name = m.name;
    row.bump_maps = bump_maps_.Of(m, build_.constants());
    return Push(std::move(row));
  }

  std::int32_t Push(MaterialRow row) {
    rows_.push_back(std::move(row));
    return static_cast<std::int32_t>(rows_.size()) - 1;
  }

  // Appends the material that replaces all others.
  void Force(MaterialTable& table) {
    for (const MaterialRow& row : rows_) {
      if (IsShaded(row.kind)) table.forced_kinds |= 1u << static_cast<int>(row.kind);
    }
    Material even;
    even.kind = MaterialKind::kDiffuse;
    MaterialRow row = build_.RowOf(even);
    row.name = "forcediffuse";
    table.forced = static_cast<std::uint32_t>(Push(std::move(row)));
  }

  // Appends the rougher rows that replace those of the scene behind bounces that
  // are not specular.
  void Regularize(MaterialTable& table) {
    const std::size_t count = rows_.size();
    for (std::size_t i = 0; i < count; ++i) {
      table.regular.push_back(static_cast<std::int32_t>(i));
    }
    for (std::size_t i = 0; i < d_.materials.size(); ++i) {
      const Material& m = d_.materials[i];
      const bool microfacets = m.kind == MaterialKind::kConductor ||
                               m.kind == MaterialKind::kDielectric ||
                               m.kind == MaterialKind::kCoatedDiffuse ||
                               m.kind == MaterialKind::kCoatedConductor;
      if (index_[i] < 0 || !microfacets) continue;
      MaterialRow row = build_.RegularRowOf(m);
      row.name = m.name;
      row.bump_maps = rows_[static_cast<std::size_t>(index_[i])].bump_maps;
      table.regular[static_cast<std::size_t>(index_[i])] = Push(std::move(row));
    }
    if (rows_.size() == count) return table.regular.clear();
    for (std::size_t i = count; i < rows_.size(); ++i) {
      table.regular.push_back(static_cast<std::int32_t>(i));
    }
  }

  // Corrects the colours of bases below coats; see coat.h.
  void CorrectBases(MaterialTable& table) {
    for (std::size_t i = 0; i < table.size(); ++i) {
      const auto kind = static_cast<ShadeKind>(table.kind[i]);
      const bool diffuse_base = kind == ShadeKind::kCoatedDiffuseSmooth ||
                                kind == ShadeKind::kCoatedDiffuseRough;
      if (!diffuse_base) continue;
      const int bounces = static_cast<int>((table.coat_depth[i] + 1) / 2);
      if (table.color0_texture[i] < 0) {
        SetBaseColor(table, i, bounces);
        continue;
      }
      const ColorValue color = {{}, table.color0_texture[i]};
      table.color0_texture[i] =
          build_.Derived(TextureKind::kCoatedBase, color, table.coat_internal[i]).texture;
      build_.derived().back().octaves = bounces;
    }
  }

  const SceneDescription& d_;
  SpectrumRows* const spectra_;
  RowBuilder build_;
  BumpMapCompiler bump_maps_;
  std::vector<std::int32_t> index_;
  std::vector<MaterialRow> rows_;
};

}  // namespace

double AlphaOfRoughness(double roughness, bool remap) {
  return remap ? std::sqrt(std::max(roughness, 0.0)) : roughness;
}

CompiledMaterials CompileMaterials(const SceneDescription& description,
                                   const std::vector<Index>& used,
                                   const CompileOptions& options, SpectrumRows* spectra) {
  Builder builder(description, options, spectra);
  for (Index material : used) builder.Add(material);
  return builder.Finish();
}

}  // namespace lanelight
