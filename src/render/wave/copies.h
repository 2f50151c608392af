// The sample buffer of a task whose paths split: each sample has kMostCopies rows, row
// sample * kMostCopies + copy, of which unused ones stay zero.
#pragma once

#include <cstdint>

#include "src/vocabulary/path/sample_planes.h"

namespace lanelight {

/// Adds up the copies of each sample, in place and in their order, so that the sum does
/// not depend on which copy ended first: rows sample * kMostCopies + copy of a plane of
/// `rows` become rows `sample` of a plane of rows / kMostCopies. Planes that are not sums
/// (SamplePlanes::Sums) are the first copy's.
void FoldCopies(float* values, std::uint32_t rows, const SamplePlanes& planes);

}  // namespace lanelight
