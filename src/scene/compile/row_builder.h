// One material of the description as a row of the table, with the coats that rows share
// and the textures that are made of others.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/scene/compile/compile.h"
#include "src/scene/compile/material_row.h"
#include "src/scene/compile/textures.h"

namespace lanelight {

class RowBuilder {
 public:
  RowBuilder(const SceneDescription& d, const CompileOptions& options)
      : d_(d), options_(options), constants_(d.textures) {}

  /// A material that is no mix; without name and relief. Throws InputError for an index
  /// of refraction that is not positive.
  MaterialRow RowOf(const Material& m);
  /// The same, rougher, as Integrator::regularize has it.
  MaterialRow RegularRowOf(const Material& m);
  /// A texture made of another one; its index goes on where those of the file end.
  ColorValue Derived(TextureKind kind, const ColorValue& from, double amount);

  const TextureConstants& constants() const { return constants_; }
  std::vector<Texture>& derived() { return derived_; }
  const std::map<Coat, std::int32_t>& coats() const { return coats_; }

 private:
  void Diffuse(const Material& m, MaterialRow& row);
  ColorValue Inside(const Material& m) const;
  void Metal(const Material& m, double eta_above, MaterialRow& row);
  void Interface(const Material& m, MaterialRow& row);
  void Hair(const Material& m, MaterialRow& row);
  void CoatOf(const Material& m, MaterialRow& row);
  ColorValue Color(const ColorValue& v) const { return constants_.Fold(v); }
  FloatValue Alpha(const FloatValue& v, bool remap);
  ColorValue Reflectance(const ColorValue& v) const;
  ColorValue ScaledReflectance(const ColorValue& v, double scale);
  bool Scatters(const Material& coat) const;
  ColorValue Scaled(const ColorValue& value, double scale);

  const SceneDescription& d_;
  const CompileOptions& options_;
  const TextureConstants constants_;
  std::vector<Texture> derived_;
  std::map<Coat, std::int32_t> coats_;
  bool regular_ = false;  // rows are those of RegularRowOf
};

/// InputError at the material, by its name.
[[noreturn]] void RefuseMaterial(const Material& m, const std::string& what);

}  // namespace lanelight
