// The presets of the founding paper render each of the shared scenes.
#include "tests/scenes/every_scene.h"
#include "tests/support/shared_scenes.h"

namespace lanelight::test {

TEST_CASE("shared scenes: all presets render all of them", "[scenes][slow]") {
  if (!HaveSharedScenes()) return;
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SharedScenes())) {
    const std::filesystem::path path = entry.path() / "reference.pbrt";
    if (!std::filesystem::exists(path)) continue;
    CheckPresets(path);
    ++scenes;
  }
  CHECK(scenes >= 8);
}

}  // namespace lanelight::test
