// Cells of CellGrid (tables.h), and the coarser cells around them.
#pragma once

#include <cstdint>

#include "src/base/core/vec.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {

/// Cells per side of a coarse cell.
inline constexpr std::int32_t kCoarseCells = 4;

/// Returns the grid of a box with about as many cells on surfaces as `vertices` records
/// can fill.
CellGrid MakeCellGrid(Vec3f low, Vec3f high, std::uint64_t vertices);

/// Returns the number of cells of the grid whose cells are groups of fine ones.
CellGrid CoarserGrid(const CellGrid& fine);

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
