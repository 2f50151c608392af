// Cells of CellGrid (tables.h), and the coarser cells around them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/base/core/vec.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {

/// Cells per side of a coarse cell.
inline constexpr std::int32_t kCoarseCells = 4;

/// Returns the grid of a box with about as many cells on surfaces as `vertices` records
/// can fill.
inline CellGrid MakeCellGrid(Vec3f low, Vec3f high, std::uint64_t vertices) {
  // Surfaces cross about six times as many cells as a side of the grid has; a dozen
  // records tell something of a cell.
  constexpr double kRecords = 12, kLongest = 48;
  const double side =
      std::clamp(std::sqrt(double(vertices) / (6 * kRecords)), 1.0, kLongest);
  float longest = 0;
  for (int a = 0; a < 3; ++a) longest = std::max(longest, high[a] - low[a]);
  CellGrid grid;
  if (!(longest > 0) || !std::isfinite(longest)) return grid;
  for (int a = 0; a < 3; ++a) {
    const double fraction = double(high[a] - low[a]) / double(longest);
    grid.low[a] = low[a];
    grid.size[a] = std::max(1, static_cast<std::int32_t>(std::ceil(fraction * side)));
    grid.per_unit[a] = static_cast<float>(side / double(longest));
  }
  return grid;
}

/// Returns the number of cells of the grid whose cells are groups of fine ones.
inline CellGrid CoarserGrid(const CellGrid& fine) {
  CellGrid coarse;
  for (int a = 0; a < 3; ++a) {
    coarse.size[a] = (fine.size[a] + kCoarseCells - 1) / kCoarseCells;
  }
  return coarse;
}

/// Calls body(cell, coarse cell) for all cells in ascending order.
template <class Body>
void ForCells(const CellGrid& fine, const CellGrid& coarse, const Body& body) {
  std::uint32_t cell = 0;
  for (std::int32_t z = 0; z < fine.size[2]; ++z) {
    for (std::int32_t y = 0; y < fine.size[1]; ++y) {
      const std::int32_t row =
          coarse.size[0] * (y / kCoarseCells + coarse.size[1] * (z / kCoarseCells));
      for (std::int32_t x = 0; x < fine.size[0]; ++x) {
        const auto around = static_cast<std::uint32_t>(row + x / kCoarseCells) * 6;
        for (std::uint32_t face = 0; face < 6; ++face) body(cell++, around + face);
      }
    }
  }
}

}  // namespace lanelight
