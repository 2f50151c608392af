// Cells of a guide (guide.h) from how the light that arrives is spread over directions.
#pragma once

#include <cstdint>
#include <span>

#include "src/prepare/guide.h"

namespace lanelight {

/// Of the quadtree of a cell.
inline constexpr int kGuideLeaves = 64;

/// Appends a cell whose density is nearly proportional to `masses`: the light that comes
/// through each square, row * kGuideGrid + column, times the cosine; >= 0 and finite, in
/// any unit. The share `even` in [0.01, 1] is distributed like the cosine instead, so
/// that no direction is left out; without any mass all of it is. `fraction` in [0, 1):
/// with which probability the guide shall propose. Squares of little mass are taken
/// together: a quadtree begins as one square, and the heaviest leaf is split (the larger
/// of equals, then the first in Z order) until there are kGuideLeaves. Returns the number
/// of the cell. Depends on its arguments alone. Throws CheckFailure for others than
/// these.
std::uint32_t AppendGuideCell(std::span<const double, kGuideSquares> masses, double even,
                              float fraction, Guide& guide);

/// Densities of a cell whose bounds are set.
void SetGuideDensities(Guide& guide, std::uint32_t cell);

/// A guide that knows nothing: one cell, everywhere, the cosine alone, of fraction 0.
Guide UnknowingGuide();

}  // namespace lanelight
