// Which plots the JSON of a study, a sweep or a bench can be drawn as.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/report/plot.h"

namespace lanelight {

struct PlotChoice {
  std::string name;   // what `lanelight plot --figure` calls it
  std::string shows;  // for a list
};

/// What `json` was written by, and what it can be drawn as; docs/study.md, docs/sweep.md,
/// docs/bench.md. Throws InputError, with `path` in it, where it is of none of these.
std::vector<PlotChoice> PlotsOf(const nlohmann::json& json, const std::string& path);

/// Draws one of them. `scene`: of a study or a sweep, by name; may be empty where there
/// is one only. `all`: all strategies, rather than the paper's, or the first eight of the
/// ranking and the baseline. Throws InputError for what is not there, with what would be.
Plot MakePlot(const nlohmann::json& json, const std::string& path,
              const std::string& figure, const std::string& scene, bool all);

}  // namespace lanelight
