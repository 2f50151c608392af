// No strategy is biased in any tile of our own scenes.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/bias/scene_bias.h"

namespace lanelight::test {
namespace {

// Scenes whose paths are so long that they would take most of the time: the first is held
// to a closed form (tests/scenes), the second is tested at length.
constexpr const char* kVeryLong = "albedo-0.999";
constexpr const char* kLong = "cloud";
// Camera paths alone miss its light (tests/render/train/decision_scenes_test.cc).
constexpr const char* kMissed = "caustic";

std::vector<std::filesystem::path> OwnScenes(bool with_long) {
  const auto folder = std::filesystem::path(LANELIGHT_SOURCE_DIR) / "scenes";
  std::vector<std::filesystem::path> files;
  for (const auto& place : {folder, folder / "stiff"}) {
    for (const auto& entry : std::filesystem::directory_iterator(place)) {
      const auto& path = entry.path();
      if (path.extension() != ".pbrt" || path.stem() == kVeryLong) continue;
      if (path.stem() == kMissed) continue;
      if (path.stem() == kLong && !with_long) continue;
      files.push_back(path);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

TEST_CASE("own scenes: no strategy is biased in any tile", "[bias]") {
  BiasPower power(0.03, 0.003);
  CheckSceneBias(OwnScenes(false), BiasCoverage::kRotating, ScreeningRounds(), power);
  CHECK(power.choices() > 30);
  power.Check();
}

TEST_CASE("own scenes: no choice is biased in any tile, at length", "[bias][slow]") {
  BiasPower power(0.02, 0.002);
  CheckSceneBias(OwnScenes(true), BiasCoverage::kEveryChoice, LongRounds(), power);
  CHECK(power.choices() > 30);
  power.Check();
}

}  // namespace lanelight::test
