// Participating media: coefficients per unit of scene length, grids, emission, the cost
// of dense media, and what lies beside each primitive.
#pragma once

#include <vector>

#include "src/base/core/vec.h"
#include "src/scene/compile/geometry.h"
#include "src/scene/compile/materials.h"
#include "src/scene/compile/placement.h"
#include "src/scene/compile/world_frame.h"
#include "src/scene/compiled/media.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Returns the grid of a medium that has one, in scene units.
MediumGrid CompileMediumGrid(const Medium& medium, const WorldFrame& frame,
                             Transport transport = Transport::kRgb);

/// Returns the emission of a medium: scales, colours (spectral transport: spectra) and
/// temperatures at voxels, and the colours of black bodies.
MediumEmission CompileMediumEmission(const Medium& medium, Transport transport);

/// Places a NanoVDB grid of the medium by its box.
PlacedSparseGrid PlaceSparseGrid(std::shared_ptr<const SparseGrid> grid,
                                 const Medium& medium);

/// Returns the spectrum of a colour that is not negative, as UpsampledColor does, but
/// from a table. Greys are exactly constant.
VoxelSpectrum SpectrumOfVoxel(Rgb color);
void AppendSpectrum(Rgb color, AlignedVector<float>& values);

/// Returns an upper bound over all bins, including the float32 rounding of kernels. For a
/// grey it is its value.
double LargestOf(const VoxelSpectrum& spectrum);

/// Media with more real and null collisions per path get a note.
inline constexpr double kManyCollisions = 3000;

/// Returns the mean number of collisions of a path in a body of volume V and surface S,
/// for the channel with the most. A path travels 4 V / S on average, however it scatters,
/// unless `max_depth` or absorption ends it. Media that vary add null collisions.
double MeanCollisions(const MediumRecord& medium, const MediumGrid* grid,
                      double mean_chord, int max_depth);

/// Adds a note for each medium with more than kManyCollisions. `at[i]` is the record of
/// medium i, or kVacuum.
void NoteDenseMedia(const SceneDescription& description, const Placement& placement,
                    const MediumTable& table, const std::vector<std::int32_t>& at,
                    std::vector<Note>& notes);

/// Returns the media around the camera and those that placed shapes bound, and appends
/// their phase functions to `materials`. Lists the sides of each shape that bounds a
/// medium, but not yet by primitive. Notes dense media.
MediumTable CompileMedia(const SceneDescription& description, const Placement& placement,
                         CompiledMaterials& materials, std::vector<Note>& notes);

/// Fills in MediumTable::primitives, where a shape bounds a medium.
void PlaceMedia(const Placement& placement, const CompiledGeometry& compiled,
                MediumTable& table);

/// Returns the fraction of light entering a half space along the normal that leaves it
/// again. The half space has a smooth dielectric boundary of relative index `eta`, an
/// `albedo` in [0, 1], and Henyey and Greenstein's phase function of asymmetry g. Method:
/// adding and doubling (van de Hulst 1980, "Multiple Light Scattering"), with separate
/// directions for light that the boundary transmits or reflects totally (Prahl, van
/// Gemert and Welch 1993). The phase function's peak counts as unscattered (delta-M,
/// Wiscombe 1977). Absolute error below 1e-3 for |g| <= 0.9.
double SlabReflectance(double albedo, double g, double eta);

/// The inverse of SlabReflectance, for all reflectances in [0, 1], as a table.
class SlabAlbedos {
 public:
  SlabAlbedos(double g, double eta);
  double Of(double reflectance) const;

 private:
  std::vector<double> reflectances_;  // of albedos, from 1 to 0
};

}  // namespace lanelight
