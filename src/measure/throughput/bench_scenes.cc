#include "src/measure/throughput/bench_scenes.h"

#include <algorithm>

#include "src/scene/parse/parse.h"

namespace lanelight {

namespace {

// Null for a scene file.
const BenchScene* Find(const std::string& scene) {
  const auto& known = BenchScenes();
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const BenchScene& s) { return scene == s.name; });
  return found == known.end() ? nullptr : &*found;
}

}  // namespace

std::uint64_t BenchSpp(const std::string& scene) {
  const BenchScene* const found = Find(scene);
  return found == nullptr ? kFileSpp : found->spp;
}

SceneDescription ReadBenchScene(const std::string& scene) {
  const BenchScene* const found = Find(scene);
  if (found == nullptr) return ParseScene(scene, {});
  return ParseSceneText(found->text, scene + ".pbrt", ".");
}

}  // namespace lanelight
