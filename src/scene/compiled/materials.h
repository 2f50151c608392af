// Materials as the kernels read them: one column per parameter.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/vocabulary/path/shade_kinds.h"

namespace lanelight {

/// Slices of a bilinear function, stored in MeasuredTable::values.
struct MeasuredGrid {
  std::int32_t at;  // of the first number
  std::int32_t width, height;
};
static_assert(sizeof(MeasuredGrid) == 12);

/// A bilinear density, each slice of which is normalised over its cells, and its
/// integrals: along each row up to each number, and over all before each row.
struct MeasuredWarp {
  MeasuredGrid grid;
  std::int32_t along, before;
};
static_assert(sizeof(MeasuredWarp) == 20);

/// A material of kind Measured: 32 words.
struct MeasuredRecord {
  std::int32_t phis, thetas;      // of known directions
  std::int32_t phi_at, theta_at;  // their angles, radians
  std::uint32_t is_anisotropic;   // 1: azimuths of normals do not count from theirs
  std::int32_t parts;             // MeasuredReflectance::parts
  MeasuredGrid ndf, sigma;
  MeasuredWarp vndf, luminance;
  MeasuredGrid reflectance;  // three slices each; with kSpectral as many as wavelengths
  std::int32_t wavelengths;  // with kSpectral: of the file
  std::int32_t bins;  // with kSpectral: where bins lie among these, a number for each bin
  std::int32_t pad[5];
};
static_assert(sizeof(MeasuredRecord) == 128);

struct MeasuredTable {
  AlignedVector<MeasuredRecord> records;
  AlignedVector<float> values;
  AlignedVector<std::int32_t> of_material;  // record of each material; empty without any
  bool any_anisotropic = false;             // a record has
};

/// Transmittance of a (rough) dielectric coat seen from outside, tabulated over
/// mu = |cos theta| at (i / (kCoatTableSize - 1)); see src/scene/compile/coat.h.
inline constexpr int kCoatTableSize = 64;

/// Nodes of the tables of a coat whose roughness varies: alpha / (1 + alpha) = i /
/// (kCoatAlphas - 1), the last one kRoughestCoat; and of one whose thickness varies:
/// sqrt(1 - exp(-thickness)) = i / (kCoatDepths - 1), so that they lie close where a coat
/// is nearly clear and what it absorbs rises steeply.
inline constexpr int kCoatAlphas = 25, kCoatDepths = 13;
inline constexpr float kRoughestCoat = 1e4f;

/// Largest asymmetry of the phase function of a coat's medium.
inline constexpr float kMaxCoatAsymmetry = 0.9999f;

/// One column per parameter, one entry per material. A texture index >= 0 replaces the
/// constant. What color0 and color1 are depends on the kind:
///   diffuse*, coateddiffuse*: color0 = reflectance
///   diffusetransmission: color0 = reflectance, color1 = transmittance
///   conductor*, coatedconductor: color0 = eta, color1 = k (of the metal relative to
///     what is above it)
///   hair: color0 = reflectance of much of it, from which absorption follows; alpha_x,
///     alpha_y = roughness along a fibre and around it, alpha2_x = tilt of scales,
///     radians
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
  // Where they vary, a coat has a grid of tables: 1 or kCoatAlphas over the roughness for
  // each of 1 or kCoatDepths over the thickness.
  AlignedVector<std::int32_t> coat_alphas, coat_depths;
  // Asymmetry and albedo of the medium in a coat that scatters.
  AlignedVector<float> coat_g, coat_albedo_r, coat_albedo_g, coat_albedo_b;
  AlignedVector<std::uint32_t> coat_depth;  // layer crossings at most (pbrt's maxdepth)
  AlignedVector<std::int32_t> color0_texture, color1_texture;
  AlignedVector<std::int32_t> alpha_x_texture, alpha_y_texture;
  AlignedVector<std::int32_t> alpha2_x_texture, alpha2_y_texture, thickness_texture;
  AlignedVector<std::int32_t> coat_albedo_texture, coat_g_texture;
  AlignedVector<std::uint32_t> alpha_remap;  // 1: textured roughness goes through sqrt
  AlignedVector<std::int32_t> mix0, mix1;
  // Heights, and normal maps: a texture or -1; empty where no material has one.
  AlignedVector<std::int32_t> displacement_texture, normal_map_texture;
  // Rows of SpectrumTable with kSpectral; negative if the colour varies by path, with its
  // use (PathColor). For `eta`: a row of SpectrumTable::indices, or -1 if it does not
  // depend on the wavelength.
  AlignedVector<std::int32_t> color0_spectrum, color1_spectrum, coat_albedo_spectrum;
  AlignedVector<std::int32_t> eta_spectrum;
  AlignedVector<float> color_scale;         // of colours that are a kScaledReflectance
  AlignedVector<float> coat_transmittance;  // kCoatTableSize per table
  AlignedVector<float> coat_internals;      // per table; used where coats vary
  MeasuredTable measured;
  // The material that replaces this one behind a bounce that is not specular, with
  // kRegularizes.
  AlignedVector<std::int32_t> regular;
  // The material that replaces all others with kForcedDiffuse, and their kinds, one bit
  // each.
  std::uint32_t forced = 0, forced_kinds = 0;
  std::vector<std::string> names;
  std::size_t size() const { return kind.size(); }
};

}  // namespace lanelight
