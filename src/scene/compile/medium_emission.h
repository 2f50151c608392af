// The factors of the emission of heterogeneous media.
#pragma once

#include "src/scene/compiled/media.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// Scales, colours and temperatures of the description, and the black bodies' colours;
/// of paths that carry wavelengths spectra of the colours at voxels.
MediumEmission CompileMediumEmission(const Medium& medium, Transport transport);

/// Places a NanoVDB grid of the medium by its box.
PlacedSparseGrid PlaceSparseGrid(std::shared_ptr<const SparseGrid> grid,
                                 const Medium& medium);

}  // namespace lanelight
