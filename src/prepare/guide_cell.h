// Cells of a guide (guide.h) from how the light that arrives is spread over directions.
#pragma once

#include <cstdint>
#include <span>

#include "src/prepare/guide.h"

namespace lanelight {

inline constexpr std::size_t kGuideSquares = std::size_t{kGuideGrid} * kGuideGrid;

/// Appends a cell whose density is nearly proportional to `masses`: what arrives through
/// each square of the octahedral grid, y * kGuideGrid + x, >= 0 and finite, in any unit.
/// The share `even` in [0.01, 1] is spread evenly over the sphere instead, so that no
/// direction is left out; without any mass all of it is. `fraction` in [0, 1): with which
/// probability the guide shall propose. The quadtree begins as one square; the heaviest
/// leaf is split (the larger of equals, then the first in Z order) until there are
/// kGuideLeaves. Returns the number of the cell. Depends on its arguments alone. Throws
/// CheckFailure for others than these.
std::uint32_t AppendGuideCell(std::span<const double, kGuideSquares> masses, double even,
                              float fraction, Guide& guide);

/// A guide that knows nothing: one cell, everywhere, even, of fraction 0.
Guide UnknowingGuide();

}  // namespace lanelight
