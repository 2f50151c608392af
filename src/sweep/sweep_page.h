// The page of a sweep: plots of its cells over any two axes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/sweep/sweep_file.h"

namespace lanelight {

/// What the page shows, as docs/sweep.md says; `cells` by CellJson().
nlohmann::json SweepJson(const Sweep& sweep, const std::vector<nlohmann::json>& cells);

/// The complete page: one HTML file that needs no network.
std::string SweepPage(const Sweep& sweep, const std::vector<nlohmann::json>& cells);

}  // namespace lanelight
