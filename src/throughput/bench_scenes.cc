#include "src/throughput/bench_scenes.h"

#include <algorithm>

#include "src/parse/parse.h"

namespace lanelight {

SceneDescription ReadBenchScene(const std::string& scene) {
  const auto& known = BenchScenes();
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const BenchScene& s) { return scene == s.name; });
  if (found == known.end()) return ParseScene(scene, {});
  return ParseSceneText(found->text, scene + ".pbrt", ".");
}

}  // namespace lanelight
