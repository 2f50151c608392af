// Strategies of the synthetic study.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/measure/report/page.h"

namespace lanelight {

inline constexpr int kRepetitions = 5;  // of the synthetic study

/// The recipe for the numbers and images of a strategy.
struct Recipe {
  std::string name, text;
  int figure;      // 0: none
  double noise;    // relative standard deviation of one sample
  double order;    // of the RMSE
  double seconds;  // of one sample per pixel
  double bias;     // planted, relative
};

/// A strategy without results.
nlohmann::json BareStrategy(const std::string& name, const std::string& text,
                            const std::string& status);

/// A strategy with levels at `counts`, stages, tiles, and images (added to `images`,
/// their names beginning with `prefix`). Not `repeated`: intervals without bounds, and
/// null where repetitions are needed.
nlohmann::json MakeStrategy(const Recipe& recipe, const std::string& prefix,
                            const std::vector<int>& counts, int seed, bool repeated,
                            std::vector<ReportImage>& images);

}  // namespace lanelight
