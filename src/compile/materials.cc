#include "src/compile/materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "src/core/check.h"
#include "src/compile/material_row.h"
#include "src/compile/textures.h"

namespace lanelight {
namespace {

// pbrt-v4: below this a microfacet surface is a smooth one.
constexpr double kSmoothAlpha = 1e-3;
// Reflectance of a metal that is given as a colour: k of 1 would be infinite.
constexpr double kMaxMetalReflectance = 0.9999;

class Builder {
 public:
  Builder(const SceneDescription& d, const CompileOptions& options)
      : d_(d),
        options_(options),
        constants_(d.textures),
        reliefs_(d.textures, derived_),
        index_(d.materials.size(), -1) {}

  void Add(Index material);
  CompiledMaterials Finish();

 private:
  MaterialRow MakeRow(const Material& m);
  void Diffuse(const Material& m, MaterialRow& row);
  void Metal(const Material& m, double eta_above, MaterialRow& row);
  void Interface(const Material& m, MaterialRow& row);
  void CoatOf(const Material& m, MaterialRow& row);
  std::vector<Index> Sides(const Material& m) const;
  std::int32_t Mix(const Material& m, const std::vector<Index>& sides);
  std::int32_t Compile(const Material& m, const std::vector<Index>& sides);
  std::int32_t Push(MaterialRow row);
  ColorValue Color(const ColorValue& v) const { return constants_.Fold(v); }
  FloatValue Alpha(const FloatValue& v, bool remap) const;
  ColorValue Reflectance(const ColorValue& v) const;
  bool Scatters(const Material& coat) const;
  ColorValue Derived(TextureKind kind, const ColorValue& from, double amount);
  ColorValue Scaled(const ColorValue& value, double scale);
  void CorrectBase(MaterialTable& table, std::size_t i);

  const SceneDescription& d_;
  const CompileOptions& options_;
  const TextureConstants constants_;
  std::vector<Texture> derived_;
  Reliefs reliefs_;
  std::vector<std::int32_t> index_;
  std::vector<MaterialRow> rows_;
  std::map<Coat, std::int32_t> coats_;
};

bool IsTextured(const ColorValue& v) { return v.texture != kNone; }
bool IsTextured(const FloatValue& v) { return v.texture != kNone; }

bool IsSmooth(const MaterialRow& row) {
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

// Whether the medium in a coat does more than absorb.
bool Builder::Scatters(const Material& coat) const {
  const ColorValue albedo = Reflectance(coat.coat_albedo);
  return IsTextured(albedo) || albedo.constant != Rgb{};
}

void Builder::Diffuse(const Material& m, MaterialRow& row) {
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
void Builder::Metal(const Material& m, double eta_above, MaterialRow& row) {
  if (m.has_reflectance) {
    const ColorValue reflectance = Color(m.reflectance);
    row.color0 = {Rgb{1, 1, 1} / eta_above, kNone};
    if (IsTextured(reflectance)) {
      row.color1 = Derived(TextureKind::kMetalExtinction, reflectance, 1 / eta_above);
      return;
    }
    const Rgb r = Clamped(reflectance.constant, kMaxMetalReflectance);
    const auto k = [](double x) { return 2 * std::sqrt(x / (1 - x)); };
    row.color1 = {Rgb{k(r.x), k(r.y), k(r.z)} / eta_above, kNone};
  } else {
    row.color0 = Scaled(Color(m.eta), 1 / eta_above);
    row.color1 = Scaled(Color(m.k), 1 / eta_above);
  }
}

// A texture made of another one; its index goes on where those of the file end.
ColorValue Builder::Derived(TextureKind kind, const ColorValue& from, double amount) {
  Texture texture;
  texture.kind = kind;
  texture.name = d_.textures[static_cast<std::size_t>(from.texture)].name;
  texture.where = d_.textures[static_cast<std::size_t>(from.texture)].where;
  texture.tex1 = from;
  texture.amount.constant = amount;
  derived_.push_back(std::move(texture));
  return {{}, static_cast<Index>(d_.textures.size() + derived_.size()) - 1};
}

ColorValue Builder::Scaled(const ColorValue& value, double scale) {
  if (!IsTextured(value)) return {value.constant * scale, kNone};
  return scale == 1 ? value : Derived(TextureKind::kScale, value, scale);
}

FloatValue Builder::Alpha(const FloatValue& v, bool remap) const {
  FloatValue alpha = constants_.Fold(v);
  if (!IsTextured(alpha)) alpha.constant = AlphaOfRoughness(alpha.constant, remap);
  return alpha;
}

void Builder::Interface(const Material& m, MaterialRow& row) {
  row.alpha_x = Alpha(m.uroughness, m.remap_roughness);
  row.alpha_y = Alpha(m.vroughness, m.remap_roughness);
  row.remap = m.remap_roughness;
  row.eta = m.interface_eta;
}

void CheckEta(const Material& m) {
  if (m.interface_eta > 0 && std::isfinite(m.interface_eta)) return;
  Unsupported(
      m, fmt::format("index of refraction {}; it must be positive", m.interface_eta));
}

void Builder::CoatOf(const Material& m, MaterialRow& row) {
  CheckEta(m);
  Interface(m, row);
  // Equal indices on both sides: nothing to see, whatever the roughness.
  if (Scatters(m) && row.eta == 1) row.alpha_x = row.alpha_y = {};
  row.coat_g = m.coat_g;
  row.coat_thickness = constants_.Fold(FloatValue{m.thickness, m.thickness_texture});
  Coat coat = {std::nullopt, m.interface_eta, std::nullopt};
  if (IsSmooth(row)) {
    coat.alpha = 0;
  } else if (!IsTextured(row.alpha_x) && !IsTextured(row.alpha_y)) {
    coat.alpha = std::sqrt(std::max(row.alpha_x.constant, kMinAlpha) *
                           std::max(row.alpha_y.constant, kMinAlpha));
  }
  if (!IsTextured(row.coat_thickness)) coat.thickness = row.coat_thickness.constant;
  const auto next = static_cast<std::int32_t>(coats_.size());
  row.coat = coats_.try_emplace(coat, next).first->second;
  row.coat_depth = static_cast<std::uint32_t>(m.coat_max_depth);
}

MaterialRow Builder::MakeRow(const Material& m) {
  MaterialRow row;
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
      if (Scatters(m)) {
        row.kind = ShadeKind::kCoatedDiffuseMedium;
        row.color1 = Reflectance(m.coat_albedo);
        break;
      }
      row.kind = IsSmooth(row) ? ShadeKind::kCoatedDiffuseSmooth
                               : ShadeKind::kCoatedDiffuseRough;
      break;
    case MaterialKind::kCoatedConductor: {
      CoatOf(m, row);
      Metal(m, m.interface_eta, row);
      row.alpha2_x = Alpha(m.conductor_uroughness, m.remap_roughness);
      row.alpha2_y = Alpha(m.conductor_vroughness, m.remap_roughness);
      row.kind = ShadeKind::kCoatedConductor;
      if (Scatters(m)) {
        row.kind = ShadeKind::kCoatedConductorMedium;
        row.coat_albedo = Reflectance(m.coat_albedo).constant;
      }
      break;
    }
    case MaterialKind::kDiffuseTransmission:
      row.color0 = Reflectance(m.reflectance);
      row.color1 = Reflectance(m.transmittance);
      row.kind = ShadeKind::kDiffuseTransmission;
      break;
    case MaterialKind::kInterface:
      row.kind = ShadeKind::kInterface;
      break;
    case MaterialKind::kMix:
      LL_CHECK(!"mixes have no row of this form");
  }
  return row;
}

// The materials that a mix is made of: one of them if it takes nothing of the other.
std::vector<Index> Builder::Sides(const Material& m) const {
  if (m.kind != MaterialKind::kMix) return {};
  for (Index side : m.mix) {
    LL_CHECK_GE(side, 0);
    LL_CHECK_LT(static_cast<std::size_t>(side), d_.materials.size());
    if (d_.materials[static_cast<std::size_t>(side)].kind == MaterialKind::kInterface) {
      Unsupported(m,
                  "mixing with an \"interface\" material is not supported; for a "
                  "cut-out use the shape's \"alpha\" parameter");
    }
  }
  const FloatValue amount = constants_.Fold(m.mix_amount);
  if (!IsTextured(amount) && amount.constant <= 0) return {m.mix[0]};
  if (!IsTextured(amount) && amount.constant >= 1) return {m.mix[1]};
  return {m.mix[0], m.mix[1]};
}

std::int32_t Builder::Mix(const Material& m, const std::vector<Index>& sides) {
  const auto row_of = [&](Index side) { return index_[static_cast<std::size_t>(side)]; };
  if (sides.size() == 1) return row_of(sides[0]);
  MaterialRow row;
  row.kind = ShadeKind::kMix;
  row.name = m.name;
  row.alpha_x = constants_.Fold(m.mix_amount);
  row.mix[0] = row_of(sides[0]);
  row.mix[1] = row_of(sides[1]);
  return Push(std::move(row));
}

// The sides of a mix have been compiled.
std::int32_t Builder::Compile(const Material& m, const std::vector<Index>& sides) {
  if (m.kind == MaterialKind::kMix) return Mix(m, sides);
  MaterialRow row = MakeRow(m);
  row.name = m.name;
  row.relief = reliefs_.Of(m, constants_);
  return Push(std::move(row));
}

std::int32_t Builder::Push(MaterialRow row) {
  rows_.push_back(std::move(row));
  return static_cast<std::int32_t>(rows_.size()) - 1;
}

// Depth first and without recursion: mixes may be nested as deep as a file likes.
void Builder::Add(Index material) {
  std::vector<Index> open = {material};
  while (!open.empty()) {
    LL_CHECK_GE(open.back(), 0);
    const auto at = static_cast<std::size_t>(open.back());
    LL_CHECK_LT(at, d_.materials.size());
    const Material& m = d_.materials[at];
    const std::vector<Index> sides = Sides(m);
    const auto waits_for = std::find_if(sides.begin(), sides.end(), [&](Index side) {
      return index_[static_cast<std::size_t>(side)] < 0;
    });
    if (index_[at] < 0 && waits_for != sides.end()) {
      open.push_back(*waits_for);
      continue;
    }
    if (index_[at] < 0) index_[at] = Compile(m, sides);
    open.pop_back();
  }
}

CompiledMaterials Builder::Finish() {
  CompiledMaterials out;
  out.index = index_;
  for (const MaterialRow& row : rows_) AddMaterialRow(row, out);
  AddCoatTables(coats_, out.table);
  for (std::size_t i = 0; i < out.table.size(); ++i) CorrectBase(out.table, i);
  for (const Texture& t : derived_) {
    out.textures.push_back(static_cast<Index>(d_.textures.size() + out.derived.size()));
    out.derived.push_back(t);
  }
  DropUnusedReliefs(out.table);
  return out;
}

// Textured colours below a coat, as SetBaseColor (material_row.cc) does with constants.
void Builder::CorrectBase(MaterialTable& table, std::size_t i) {
  const auto kind = static_cast<ShadeKind>(table.kind[i]);
  const bool diffuse_base =
      kind == ShadeKind::kCoatedDiffuseSmooth || kind == ShadeKind::kCoatedDiffuseRough;
  if (!diffuse_base || table.color0_texture[i] < 0) return;
  const ColorValue color = {{}, table.color0_texture[i]};
  table.color0_texture[i] =
      Derived(TextureKind::kCoatedBase, color, table.coat_internal[i]).texture;
  derived_.back().octaves = static_cast<int>((table.coat_depth[i] + 1) / 2);
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
