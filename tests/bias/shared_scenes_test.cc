// No strategy is biased in any tile of the shared scenes.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/bias/scene_bias.h"
#include "tests/support/shared_scenes.h"

namespace lanelight::test {
namespace {

// Our own scenes have the power for every choice; these add what only they have.
const BiasPower kAnyPower(1, 1);

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
  BiasPower power = kAnyPower;
  CheckSceneBias(SharedSceneFiles(), BiasCoverage::kRotating, ScreeningRounds(), power);
}

TEST_CASE("shared scenes: no choice is biased in any tile, at length", "[bias][slow]") {
  if (!HaveSharedScenes()) return;
  BiasPower power = kAnyPower;
  CheckSceneBias(SharedSceneFiles(), BiasCoverage::kEveryChoice, LongRounds(), power);
}

}  // namespace lanelight::test
