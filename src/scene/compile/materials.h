// Materials of the description, first as rows, then as the columns that kernels gather.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/base/image/measured_reflectance.h"
#include "src/scene/compile/compile.h"
#include "src/scene/compile/spectrum_rows.h"
#include "src/scene/compile/textures.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/description/description.h"

namespace lanelight {

struct CompiledMaterials {
  MaterialTable table;              // only materials that are used
  std::vector<std::int32_t> index;  // of each described material in it; -1 = unused
  std::vector<Index> textures;      // used by the table
  std::vector<Texture> derived;     // made for it; their indices follow the description's
  SpectrumRows* spectra = nullptr;  // of its colours; null: paths carry RGB
};

/// `used`: material indices that shapes refer to. Mixes bring in what they mix; a mix
/// with a constant weight of 0 or 1 is replaced by one of its sides. Throws InputError
/// for parameters that the closed forms of the kernels cannot represent. `spectra`: of
/// paths that carry wavelengths; else null.
CompiledMaterials CompileMaterials(const SceneDescription& description,
                                   const std::vector<Index>& used,
                                   const CompileOptions& options,
                                   SpectrumRows* spectra = nullptr);

/// GGX alpha of a roughness: sqrt if remapped (as pbrt-v4).
double AlphaOfRoughness(double roughness, bool remap);

/// Floor of alpha on rough surfaces, as in pbrt-v4 (an anisotropic surface may be smooth
/// along one axis only).
inline constexpr double kMinAlpha = 1e-4;

/// A row of MaterialTable in double precision.
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
  BumpMaps bump_maps;
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

/// Appends the row to every column, with its spectra, and lists its textures as used.
void AddMaterialRow(const MaterialRow& row, CompiledMaterials& out);

/// Computes the tables of all coats in parallel and completes the rows that have one.
void AddCoatTables(const std::map<Coat, std::int32_t>& coats, MaterialTable& table);
/// Replaces the constant colour of a base by its effective colour below a coat (coat.h).
void SetBaseColor(MaterialTable& table, std::size_t i, int bounces);

class RowBuilder {
 public:
  RowBuilder(const SceneDescription& d, const CompileOptions& options)
      : d_(d), options_(options), constants_(d.textures) {}

  /// A material that is no mix; without name and bump maps. Throws InputError for an
  /// index of refraction that is not positive.
  MaterialRow RowOf(const Material& m);
  /// Returns the rougher row that Integrator::regularize uses.
  MaterialRow RegularRowOf(const Material& m);
  /// Adds a texture derived from another one; its index follows those of the file.
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

/// Throws InputError at the material, with its name.
[[noreturn]] void ThrowUnsupportedMaterial(const Material& m, const std::string& what);

/// Returns the reflected fraction of light that arrives along the normal.
Rgb HeadOnAlbedo(const MeasuredReflectance& measured);

/// Adds the measured tables of the rows, each once; with spectral transport their
/// spectra, read from files. Throws InputError as ReadMeasuredSpectra().
void AddMeasured(const std::vector<MaterialRow>& rows, MeasuredTable& table,
                 Transport transport = Transport::kRgb);

}  // namespace lanelight
