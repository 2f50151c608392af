#include "src/scene/prepare/cell_grid.h"

#include <algorithm>
#include <cmath>

namespace lanelight {

CellGrid CoarserGrid(const CellGrid& fine) {
  CellGrid coarse;
  for (int a = 0; a < 3; ++a)
    coarse.size[a] = (fine.size[a] + kCoarseCells - 1) / kCoarseCells;
  return coarse;
}

CellGrid MakeCellGrid(Vec3f low, Vec3f high, std::uint64_t vertices) {
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
    const double fraction = double(high[a] - low[a]) / longest;
    grid.low[a] = low[a];
    grid.size[a] = std::max(1, static_cast<std::int32_t>(std::ceil(fraction * side)));
    grid.per_unit[a] = static_cast<float>(side / longest);
  }
  return grid;
}

}  // namespace lanelight
