// What the page of a sweep and `lanelight plot` show: its cells over its axes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/measure/sweep/groups.h"

namespace lanelight {

/// The groups of the page, whose scenes have the names of SceneNames().
std::vector<CellGroup> GroupCells(const Sweep& sweep,
                                  const std::vector<nlohmann::json>& cells);

/// sweep.json, as docs/sweep.md says; `cells` by CellJson().
nlohmann::json SweepJson(const Sweep& sweep, const std::vector<nlohmann::json>& cells,
                         const std::vector<CellGroup>& groups);

}  // namespace lanelight
