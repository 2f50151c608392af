#include "src/scene/compile_materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/scene/coat_table.h"
#include "src/scene/compile_textures.h"

namespace lanelight {
namespace {

// pbrt-v4: below the first a microfacet surface is a smooth one; the second is the floor
// of alpha on a rough one (an anisotropic surface may be smooth along one axis only).
constexpr double kSmoothAlpha = 1e-3;
constexpr double kMinAlpha = 1e-4;
// Reflectance of a metal that is given as a colour: k of 1 would be infinite.
constexpr double kMaxMetalReflectance = 0.9999;

// One row of MaterialTable.
struct Row {
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

using Coat = std::tuple<double, double, double>;  // alpha, eta, thickness

class Builder {
 public:
  Builder(const SceneDescription& d, const CompileOptions& options)
      : d_(d), options_(options), index_(d.materials.size(), -1) {}

  std::int32_t Add(Index material);
  CompiledMaterials Finish();

 private:
  Row MakeRow(const Material& m);
  void Diffuse(const Material& m, Row& row);
  void Metal(const Material& m, double eta_above, Row& row);
  void Interface(const Material& m, Row& row);
  void CoatOf(const Material& m, Row& row);
  std::int32_t Mix(const Material& m);
  std::int32_t Push(Row row);
  ColorValue Color(const ColorValue& v) const { return FoldConstant(d_.textures, v); }
  ColorValue Reflectance(const ColorValue& v) const;

  const SceneDescription& d_;
  const CompileOptions& options_;
  std::vector<std::int32_t> index_;
  std::vector<Row> rows_;
  std::map<Coat, std::int32_t> coats_;
};

bool IsTextured(const ColorValue& v) { return v.texture != kNone; }
bool IsTextured(const FloatValue& v) { return v.texture != kNone; }

bool IsSmooth(const Row& row) {
  return !IsTextured(row.alpha_x) && !IsTextured(row.alpha_y) &&
         std::max(row.alpha_x.constant, row.alpha_y.constant) < kSmoothAlpha;
}

[[noreturn]] void Unsupported(const Material& m, const std::string& what) {
  throw InputError(m.where,
                   (m.name.empty() ? "" : "material \"" + m.name + "\": ") + what);
}

Rgb Clamped(Rgb c, double largest) {
  const Rgb zero, top = {largest, largest, largest};
  return Min(Max(c, zero), top);
}

// pbrt clamps constant reflectances too.
ColorValue Builder::Reflectance(const ColorValue& v) const {
  ColorValue color = Color(v);
  if (!IsTextured(color)) color.constant = Clamped(color.constant, 1);
  return color;
}

void Builder::Diffuse(const Material& m, Row& row) {
  switch (options_.scattering.value_or(m.scattering)) {
    case Scattering::kLambertian:
      row.kind = ShadeKind::kDiffuse;
      break;
    case Scattering::kUniform:
      row.kind = ShadeKind::kDiffuseUniform;
      break;
    case Scattering::kInSphere:
      row.kind = ShadeKind::kDiffuseInSphere;
      break;
  }
  row.color0 = Reflectance(m.reflectance);
}

// Index and extinction relative to `eta_above`.
void Builder::Metal(const Material& m, double eta_above, Row& row) {
  if (m.has_reflectance) {
    const ColorValue reflectance = Color(m.reflectance);
    if (IsTextured(reflectance)) {
      Unsupported(m,
                  "a textured \"reflectance\" of a conductor is not supported; give a "
                  "constant reflectance, or \"eta\" and \"k\"");
    }
    const Rgb r = Clamped(reflectance.constant, kMaxMetalReflectance);
    const auto k = [](double x) { return 2 * std::sqrt(x / (1 - x)); };
    row.color0 = {{1, 1, 1}, kNone};
    row.color1 = {{k(r.x), k(r.y), k(r.z)}, kNone};
  } else {
    row.color0 = Color(m.eta);
    row.color1 = Color(m.k);
    if (IsTextured(row.color0) || IsTextured(row.color1)) {
      Unsupported(m, "textured \"eta\" or \"k\" are not supported; give constants");
    }
  }
  row.color0.constant *= 1 / eta_above;
  row.color1.constant *= 1 / eta_above;
}

FloatValue Alpha(const std::vector<Texture>& textures, const FloatValue& v, bool remap) {
  FloatValue alpha = FoldConstant(textures, v);
  if (!IsTextured(alpha)) alpha.constant = AlphaOfRoughness(alpha.constant, remap);
  return alpha;
}

void Builder::Interface(const Material& m, Row& row) {
  row.alpha_x = Alpha(d_.textures, m.uroughness, m.remap_roughness);
  row.alpha_y = Alpha(d_.textures, m.vroughness, m.remap_roughness);
  row.remap = m.remap_roughness;
  row.eta = m.interface_eta;
}

void CheckEta(const Material& m) {
  if (m.interface_eta > 0 && std::isfinite(m.interface_eta)) return;
  Unsupported(
      m, fmt::format("index of refraction {}; it must be positive", m.interface_eta));
}

void Builder::CoatOf(const Material& m, Row& row) {
  CheckEta(m);
  if (m.coat_albedo != Rgb{}) {
    Unsupported(m, fmt::format("a scattering medium inside the coat (albedo {} {} {}) is "
                               "not supported; supported are clear coats, albedo 0",
                               m.coat_albedo.x, m.coat_albedo.y, m.coat_albedo.z));
  }
  Interface(m, row);
  if (IsTextured(row.alpha_x) || IsTextured(row.alpha_y)) {
    Unsupported(m, "a textured roughness of a coat is not supported; give a constant");
  }
  const double alpha = IsSmooth(row)
                           ? 0
                           : std::sqrt(std::max(row.alpha_x.constant, kMinAlpha) *
                                       std::max(row.alpha_y.constant, kMinAlpha));
  const auto next = static_cast<std::int32_t>(coats_.size());
  row.coat =
      coats_.try_emplace({alpha, m.interface_eta, m.thickness}, next).first->second;
  row.coat_thickness = m.thickness;
  row.coat_depth = static_cast<std::uint32_t>(m.coat_max_depth);
}

Row Builder::MakeRow(const Material& m) {
  Row row;
  switch (m.kind) {
    case MaterialKind::kDiffuse:
      Diffuse(m, row);
      break;
    case MaterialKind::kConductor:
      Interface(m, row);
      row.eta = 1;
      Metal(m, 1, row);
      row.kind = IsSmooth(row) ? ShadeKind::kConductorSmooth : ShadeKind::kConductorRough;
      break;
    case MaterialKind::kDielectric:
      CheckEta(m);
      Interface(m, row);
      // Equal indices on both sides: nothing to see, whatever the roughness (as pbrt).
      row.kind = IsSmooth(row) || row.eta == 1 ? ShadeKind::kDielectricSmooth
                                               : ShadeKind::kDielectricRough;
      break;
    case MaterialKind::kThinDielectric:
      CheckEta(m);
      row.eta = m.interface_eta;
      row.kind = ShadeKind::kThinDielectric;
      break;
    case MaterialKind::kCoatedDiffuse:
      CoatOf(m, row);
      row.color0 = Reflectance(m.reflectance);
      row.kind = IsSmooth(row) ? ShadeKind::kCoatedDiffuseSmooth
                               : ShadeKind::kCoatedDiffuseRough;
      break;
    case MaterialKind::kCoatedConductor: {
      CoatOf(m, row);
      Metal(m, m.interface_eta, row);
      const FloatValue x = Alpha(d_.textures, m.conductor_uroughness, m.remap_roughness);
      const FloatValue y = Alpha(d_.textures, m.conductor_vroughness, m.remap_roughness);
      if (IsTextured(x) || IsTextured(y)) {
        Unsupported(m,
                    "a textured roughness of a metal below a coat is not supported; "
                    "give a constant");
      }
      row.alpha2_x = x.constant;
      row.alpha2_y = y.constant;
      row.kind = ShadeKind::kCoatedConductor;
      break;
    }
    case MaterialKind::kDiffuseTransmission:
      row.color0 = Reflectance(m.reflectance);
      row.color1 = Reflectance(m.transmittance);
      if (IsTextured(row.color1)) {
        Unsupported(m, "a textured \"transmittance\" is not supported; give a constant");
      }
      row.kind = ShadeKind::kDiffuseTransmission;
      break;
    case MaterialKind::kMix:
    case MaterialKind::kInterface:
      LL_CHECK(!"mixes and interfaces have no row of this form");
  }
  return row;
}

std::int32_t Builder::Mix(const Material& m) {
  for (Index side : m.mix) {
    LL_CHECK_GE(side, 0);
    LL_CHECK_LT(static_cast<std::size_t>(side), d_.materials.size());
    if (d_.materials[static_cast<std::size_t>(side)].kind == MaterialKind::kInterface) {
      Unsupported(m,
                  "mixing with an \"interface\" material is not supported; for a "
                  "cut-out use the shape's \"alpha\" parameter");
    }
  }
  Row row;
  row.kind = ShadeKind::kMix;
  row.name = m.name;
  row.alpha_x = FoldConstant(d_.textures, m.mix_amount);
  if (!IsTextured(row.alpha_x)) {
    if (row.alpha_x.constant <= 0) return Add(m.mix[0]);
    if (row.alpha_x.constant >= 1) return Add(m.mix[1]);
  }
  row.mix[0] = Add(m.mix[0]);
  row.mix[1] = Add(m.mix[1]);
  return Push(std::move(row));
}

std::int32_t Builder::Push(Row row) {
  rows_.push_back(std::move(row));
  return static_cast<std::int32_t>(rows_.size()) - 1;
}

std::int32_t Builder::Add(Index material) {
  LL_CHECK_GE(material, 0);
  LL_CHECK_LT(static_cast<std::size_t>(material), d_.materials.size());
  std::int32_t& index = index_[static_cast<std::size_t>(material)];
  if (index >= 0) return index;
  const Material& m = d_.materials[static_cast<std::size_t>(material)];
  if (m.kind == MaterialKind::kMix) return index = Mix(m);
  Row row = MakeRow(m);
  row.name = m.name;
  return index = Push(std::move(row));
}

float RoughAlpha(const Row& row, double alpha) {
  if (row.kind == ShadeKind::kMix) return static_cast<float>(alpha);
  return static_cast<float>(std::max(alpha, kMinAlpha));
}

void AddRow(const Row& row, CompiledMaterials& out) {
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

// Coats that are equal share a table.
void AddCoats(const std::map<Coat, std::int32_t>& coats, MaterialTable& table) {
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
  }
}

CompiledMaterials Builder::Finish() {
  CompiledMaterials out;
  out.index = index_;
  for (const Row& row : rows_) AddRow(row, out);
  AddCoats(coats_, out.table);
  return out;
}

}  // namespace

double AlphaOfRoughness(double roughness, bool remap) {
  return remap ? std::sqrt(std::max(roughness, 0.0)) : roughness;
}

CompiledMaterials CompileMaterials(const SceneDescription& description,
                                   const std::vector<Index>& used,
                                   const CompileOptions& options) {
  Builder builder(description, options);
  for (Index material : used) builder.Add(material);
  return builder.Finish();
}

}  // namespace lanelight
