// Cells that differ in their seed only, which are repetitions of one render: means with
// intervals, and efficiencies.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/measure/sweep/sweep_file.h"

namespace lanelight {

/// Of all intervals over seeds.
inline constexpr double kSweepConfidence = 0.95;

struct CellGroup {
  /// Texts by axis, without the seed: the strategy's family, and its open parts as axes
  /// of their own.
  std::map<std::string, std::string> values;
  std::string strategy;            // its text; empty where the sweep has no such axis
  std::size_t context = 0;         // the same for groups that differ in strategy only
  std::vector<std::size_t> cells;  // finished ones, by index
};

/// All groups in the order of the grid, also those without finished cells. A strategy
/// that stands in several places (Sweep::places) is in several groups. `scenes`: names by
/// what the file says.
std::vector<CellGroup> GroupCells(const Sweep& sweep,
                                  const std::vector<nlohmann::json>& cells,
                                  const std::map<std::string, std::string>& scenes);

/// Each group that has a finished cell: "values", "strategy", "cells", for several cells
/// "measured" (intervals of means over them), and "efficiency" relative to the baseline
/// with the same seeds (src/base/stat/efficiency.h), null where it is not known.
nlohmann::json GroupsJson(const std::vector<CellGroup>& groups,
                          const std::vector<nlohmann::json>& cells,
                          const std::string& baseline);

/// For the last context of each scene that has several strategies of known error: which
/// is the most efficient, and how many may be as efficient; docs/sweep.md.
nlohmann::json LeadersJson(const std::vector<CellGroup>& groups,
                           const std::vector<nlohmann::json>& cells,
                           const std::string& baseline);

/// "default", or else the first strategy of the grid; empty without any.
std::string BaselineOf(const Sweep& sweep);

}  // namespace lanelight
