// The sample buffer of a task whose paths split: each sample has kMostCopies rows, row
// sample * kMostCopies + copy, of which unused ones stay zero.
#pragma once

#include <cstdint>

namespace lanelight {

/// Adds up the copies of each sample, in place and in their order, so that the sum does
/// not depend on which copy ended first: rows sample * kMostCopies + copy of a plane of
/// `rows` become rows `sample` of a plane of rows / kMostCopies. The first three planes
/// and the three from `difference` on are summed; the others are the first copy's.
void FoldCopies(float* values, std::uint32_t rows, int planes, int difference);

}  // namespace lanelight
