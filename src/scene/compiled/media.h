// Participating media as the kernels read them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "src/base/core/aligned.h"

namespace lanelight {

class SparseGrid;  // src/base/core/sparse_grid.h

/// Index of empty space.
inline constexpr std::int32_t kVacuum = -1;

/// Medium: 16 words. Coefficients are per unit of scene length.
struct MediumRecord {
  float sigma_t[3];        // extinction: absorption and scattering
  std::uint32_t material;  // its phase function (MaterialTable)
  float sigma_s[3];        // scattering
  std::uint32_t scatters;  // 0: it absorbs only, and no path needs an event in it
  float emission[3];       // radiance that it emits per length; with a grid, over sigma_a
  std::int32_t grid;       // -1: the same everywhere
  std::uint32_t inside;    // 1: of a material; events in it and on its bounds from within
                           // do not count
  std::int32_t albedos;    // offset in MediumTable::albedos; -1: not textured
  std::int32_t spectra;    // with kSpectral: rows of SpectrumTable (MediumRow)
  float pad;
};
static_assert(sizeof(MediumRecord) == 64);

/// Rows of a medium, one after the other. kPlanck: h c / (k lambda), kelvin, only where
/// its emission is that of black bodies; kEmission is then in units of D65 for spectra
/// over their maximum.
enum class MediumRow : std::int32_t { kSigmaT, kSigmaS, kEmission, kPlanck };

/// What lies on both sides of a surface, inside being away from its normal.
struct MediumSides {
  std::int32_t inside, outside;  // medium, or kVacuum
  std::uint32_t passes;          // 1: rays go straight through (material "interface")
  std::uint32_t pad;
};

/// Cells of a majorant grid, along each axis.
inline constexpr std::int32_t kMajorantCells = 16;

/// The storage of a heterogeneous medium.
enum class MediumSource : std::int32_t {
  kDensities,  // factors on the coefficients of the record, at voxels
  kColors,     // sigma_a and sigma_s per unit of scene length, at voxels: colours, or
               // with kSpectral two VoxelSpectrum
  kCloud,      // factors, made up from noise
  kSparse      // factors, of a NanoVDB grid
};

/// The spectrum of a colour at a voxel: scale * sigmoid((c[0] t + c[1]) t + c[2]), t the
/// place of a wavelength (src/base/image/upsampling.h).
struct VoxelSpectrum {
  float c[3], scale;
};
static_assert(sizeof(VoxelSpectrum) == 4 * sizeof(float));

/// pbrt-v4's procedural cloud, in the medium's own space.
struct CloudShape {
  float density = 1, wispiness = 1, frequency = 5;
  float low[3] = {}, size[3] = {};  // of the box
};

/// A NanoVDB grid, and its index space by the medium's box: row-major 3x4.
struct PlacedSparseGrid {
  std::shared_ptr<const SparseGrid> grid;  // null: none
  float index_from_box[12] = {};
};

/// Colours of black bodies (RgbOfBlackbody) of kMinKelvin to `maximum`, evenly in the
/// logarithm of the temperature, which is (t - offset) * scale.
struct BlackbodyTable {
  float offset = 0, scale = 1;
  float entries_per_log = 0;    // entries per factor of e
  AlignedVector<float> colors;  // three each; none with kSpectral: Planck's law
};
/// Cooler black bodies emit nothing, as in pbrt.
inline constexpr float kMinKelvin = 100;

/// The factors of a medium's emission at a point; each may be empty.
struct MediumEmission {
  AlignedVector<float> values;  // at voxels
  std::int32_t size[3] = {};    // how many: those of the medium, or one
  std::int32_t channels = 1;    // of `values`: 1, or of colours 3; with kSpectral a
                                // VoxelSpectrum, 4
  AlignedVector<float> temperatures;
  PlacedSparseGrid sparse;   // of temperatures
  BlackbodyTable blackbody;  // of either

  bool heated() const { return !temperatures.empty() || sparse.grid != nullptr; }
  bool empty() const { return values.empty() && !heated(); }
};

/// A medium that varies within a box: samples at the centres of nx * ny * nz voxels, x
/// fastest, interpolated linearly, zero outside; or another source.
struct MediumGrid {
  MediumSource source = MediumSource::kDensities;
  std::int32_t size[3] = {};
  AlignedVector<float> values;  // per voxel 1, of kColors 6 or 8
  CloudShape cloud;             // kCloud
  PlacedSparseGrid sparse;      // kSparse
  MediumEmission emission;
  /// Bounds of the density, or of the largest sigma_t, in cells of the box.
  AlignedVector<float> majorants;
  float box_from_scene[12] = {};  // row-major 3x4; the box is [0, 1]^3
};

/// Entries of a table of albedos over the reflectance that they cause, evenly in it.
inline constexpr int kAlbedoTableSize = 129;

struct MediumTable {
  AlignedVector<MediumRecord> media;
  std::vector<MediumGrid> grids;
  AlignedVector<MediumSides> sides;        // of each shape that has any
  AlignedVector<std::int32_t> primitives;  // of each: index of its sides; -1 = the medium
                                           // goes on behind it; only with kMediumChanges
  AlignedVector<float> albedos;            // kAlbedoTableSize each, of textured insides
  std::int32_t camera = kVacuum;           // that camera rays start in
};

}  // namespace lanelight
