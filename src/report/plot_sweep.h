// What the sweep.json of `lanelight sweep` can be drawn as.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/report/plot_figures.h"

namespace lanelight {

/// Error against samples and time, efficiencies, rates, and efficiency against each
/// numeric part of the strategies (docs/sweep.md).
std::vector<PlotChoice> SweepPlots(const nlohmann::json& sweep);

/// Draws SweepPlots()[at]. `scene`: by name, may be empty where there is one only. Throws
/// InputError where there is nothing to draw.
Plot SweepPlot(const nlohmann::json& sweep, const std::string& path, std::size_t at,
               const std::string& scene);

}  // namespace lanelight
