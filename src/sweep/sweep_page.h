// The page of a sweep: plots of its cells over its axes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/report/page.h"
#include "src/sweep/groups.h"

namespace lanelight {

/// The groups of the page, whose scenes have the names of SceneNames().
std::vector<CellGroup> GroupCells(const Sweep& sweep,
                                  const std::vector<nlohmann::json>& cells);

/// What the page shows, as docs/sweep.md says; `cells` by CellJson().
nlohmann::json SweepJson(const Sweep& sweep, const std::vector<nlohmann::json>& cells,
                         const std::vector<CellGroup>& groups);

/// The complete page: one HTML file that needs no network.
std::string SweepPage(const Sweep& sweep, const std::vector<nlohmann::json>& cells,
                      const std::vector<CellGroup>& groups,
                      const std::vector<ReportImage>& thumbnails);

}  // namespace lanelight
