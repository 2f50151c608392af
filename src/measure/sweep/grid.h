// The cells of a sweep: every combination of the values of its axes, less what is
// excluded.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/base/core/source_location.h"
#include "src/measure/sweep/axes.h"
#include "src/measure/sweep/strategy_pattern.h"

namespace lanelight {

inline constexpr std::size_t kMostCells = 1000000;

struct GridValue {
  std::string text;  // see CanonicalValue()
  SourceLocation where;
  std::vector<StrategyPlace> places = {};  // of a strategy
};

/// Values of some axes: [grid], or a table of [[include]] or [[exclude]].
struct SubGrid {
  SourceLocation where;
  std::map<Axis, std::vector<GridValue>> axes;
};

struct SweepCell {
  std::size_t index = 0;  // in grid order
  AxisValues values;
  /// Its directory's: readable, and of these values alone, so that it stays when the grid
  /// grows or shrinks. No two are the same.
  std::string name;

  bool operator==(const SweepCell&) const = default;
};

/// Every cell of the first grid and then of the others, once, unless a table of `exclude`
/// has all its axes among the listed values. Throws InputError for more than kMostCells,
/// for a table of `exclude` that says nothing or applies to no cell, and if no cell is
/// left.
std::vector<SweepCell> ExpandGrid(const std::vector<SubGrid>& grids,
                                  const std::vector<SubGrid>& exclude);

/// For example "box_64x48_points=pmj02_16spp_seed1-83a1c09b52".
std::string CellName(const AxisValues& values);

}  // namespace lanelight
