// Costs of the cells of a group by seed, and the context in which strategies compete.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/base/stat/efficiency.h"
#include "src/measure/sweep/results.h"

namespace lanelight {

/// Confidence of all intervals over seeds.
inline constexpr double kSweepConfidence = 0.95;

using SeedCosts = std::map<std::string, stat::Cost>;  // by seed

/// Returns a measure of a cell by CellJson(); NaN: unknown.
double MeasureOf(const nlohmann::json& cell, const char* name);

/// Returns the costs of cells with a known error.
SeedCosts CostsOf(const CellGroup& group, const std::vector<nlohmann::json>& cells);

/// Returns the repetitions of each, for seeds that all have.
std::vector<std::vector<stat::Cost>> PairedCosts(const std::vector<SeedCosts>& all);

/// Returns the values of a group that do not belong to its strategy.
std::map<std::string, std::string> ContextOf(const CellGroup& group);

}  // namespace lanelight
