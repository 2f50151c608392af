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

/// The grid of a medium that has one, in scene units, for paths of this kind.
MediumGrid CompileMediumGrid(const Medium& medium, const WorldFrame& frame,
                             Transport transport = Transport::kRgb);

/// Scales, colours and temperatures of the description, and the black bodies' colours;
/// of paths that carry wavelengths spectra of the colours at voxels.
MediumEmission CompileMediumEmission(const Medium& medium, Transport transport);

/// Places a NanoVDB grid of the medium by its box.
PlacedSparseGrid PlaceSparseGrid(std::shared_ptr<const SparseGrid> grid,
                                 const Medium& medium);

/// The spectrum of a colour without bound, no channel below 0, as UpsampledColor has it,
/// but by the table: looked up, not fitted. Greys are constant to the last bit.
VoxelSpectrum SpectrumOfVoxel(Rgb color);
void AppendSpectrum(Rgb color, AlignedVector<float>& values);

/// Returns an upper bound over all bins, including the float32 rounding of kernels. For a
/// grey it is its value.
double LargestOf(const VoxelSpectrum& spectrum);

/// Collisions, real and null ones, beyond which a medium is noted.
inline constexpr double kManyCollisions = 3000;

/// Mean number of collisions of a path of each channel in a body of volume V and surface
/// S, the largest of all channels. A path that enters anywhere goes 4 V / S on average,
/// however it scatters, unless `max_depth` or absorption ends it. Media that vary have
/// null collisions besides.
double MeanCollisions(const MediumRecord& medium, const MediumGrid* grid,
                      double mean_chord, int max_depth);

/// A note for each medium, `at` its record or kVacuum, with more than kManyCollisions.
void NoteDenseMedia(const SceneDescription& description, const Placement& placement,
                    const MediumTable& table, const std::vector<std::int32_t>& at,
                    std::vector<Note>& notes);

/// The media that the camera stands in or that a placed shape bounds, with a phase
/// function for each appended to `materials`; nothing if there are none. Lists the sides
/// of each shape that bounds a medium, but not yet by primitive. Notes dense media.
MediumTable CompileMedia(const SceneDescription& description, const Placement& placement,
                         CompiledMaterials& materials, std::vector<Note>& notes);

/// Fills in MediumTable::primitives, where a shape bounds a medium.
void PlaceMedia(const Placement& placement, const CompiledGeometry& compiled,
                MediumTable& table);

}  // namespace lanelight
