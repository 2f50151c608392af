// The page of `lanelight profile --html`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/measure/profile/profile_comparison.h"
#include "src/render/films/accumulator.h"
#include "src/render/run/run.h"

namespace lanelight {

/// A finished task: samples of the pixels of a tile, and their processor time.
struct TaskCost {
  PixelRect tile;
  double samples = 0, seconds = 0;
};

/// The parts of the page that are not in the JSON of the profile. All are of the first
/// repeat.
struct ProfilePageInput {
  std::string scene;                   // name in the title
  std::string answer;                  // the first sentence of the terminal
  const std::vector<TaskCost>& tasks;  // from RunOptions::on_task
  const FilmAccumulator& film;         // the rendered image
  const RunResult& result;             // with a trace
  std::string against = {};            // the earlier profile; empty: none
  ProfileComparison comparison = {};   // with it
  std::string verdict = {};            // of the comparison
};

/// Returns a page with the JSON of a profile (docs/profile.schema.json) and these parts.
std::string ProfilePage(nlohmann::json profile, const ProfilePageInput& input);

}  // namespace lanelight
