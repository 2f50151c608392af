// No strategy is biased in any tile of the shared scenes.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/bias/scene_bias.h"
#include "tests/support/shared_scenes.h"

namespace lanelight::test {
namespace {

std::vector<std::filesystem::path> SharedSceneFiles() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SharedScenes())) {
    const std::filesystem::path path = entry.path() / "reference.pbrt";
    if (std::filesystem::exists(path)) files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

TEST_CASE("shared scenes: no strategy is biased in any tile", "[bias]") {
  if (!HaveSharedScenes()) return;
  CheckSceneBias(SharedSceneFiles(), BiasCoverage::kRotating, ScreeningRounds());
}

TEST_CASE("shared scenes: no choice is biased in any tile, at length", "[bias][slow]") {
  if (!HaveSharedScenes()) return;
  CheckSceneBias(SharedSceneFiles(), BiasCoverage::kEveryChoice, LongRounds());
}

}  // namespace lanelight::test
