// The presets of the founding paper render each of our own scenes: no figure is refused.
#include "tests/scenes/every_scene.h"

namespace lanelight::test {

TEST_CASE("own scenes: all presets render all of them", "[scenes]") {
  const std::filesystem::path folder =
      std::filesystem::path(LANELIGHT_SOURCE_DIR) / "scenes";
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".pbrt") continue;
    CheckPresets(entry.path());
    ++scenes;
  }
  CHECK(scenes >= 25);
  CHECK(AllPresets().size() == 7);
}

}  // namespace lanelight::test
