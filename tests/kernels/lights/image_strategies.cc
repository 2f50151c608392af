#include "tests/kernels/lights/image_strategies.h"

#include <catch2/catch.hpp>
#include <iterator>

#include "src/base/core/error.h"
#include "src/base/stat/hypothesis.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight::test {
namespace {

// All ways to sample lights that know of their emission.
constexpr const char* kStrategies[] = {
    "directions=mis",
    "directions=light,light-selection=tree",
    "directions=bsdf,seen-lights=paths",
    "light-points=solid-angle,light-candidates=resampled:4",
    "light-points=projected,directions=light",
    "environment=compensated"};

}  // namespace

stat::ImageEstimate RenderBy(const SceneDescription& scene, const char* strategy) {
  TestRender options;
  options.spp = 2048;
  options.strategy = strategy;
  const Rendered render = RenderDescription(scene, options);
  CHECK(render.result.health.Total() == 0);
  return Estimate(render);
}

namespace {

bool Refused(const SceneDescription& scene, const char* strategy) {
  SceneDescription copy = scene;
  ApplyStrategy(strategy, {}, copy.strategy);
  try {
    MakePlan(PrepareScene(copy), {});
    return false;
  } catch (const InputError&) {
    return true;
  }
}

}  // namespace

void CheckStrategies(const SceneDescription& scene) {
  const reference::Textures textures(scene.textures);
  const auto reference = [&](ReferenceEstimator estimator) {
    return Estimate(RenderReference(scene, TexturedOptions(textures, estimator, 8192)));
  };
  const auto truth = reference(ReferenceEstimator::kLightSampling);
  const auto other = reference(ReferenceEstimator::kMaterialSampling);
  const stat::ImageTestOptions test = {
      4, stat::SidakLevel(1e-5, int(std::size(kStrategies)) + 1), kFloatTolerance, 1e-7};
  stat::CheckSame(stat::CompareMeans(truth, other, test));
  for (const char* strategy : kStrategies) {
    if (Refused(scene, strategy)) continue;
    stat::CheckSame(stat::CompareMeans(RenderBy(scene, strategy), truth, test), 0.2,
                    strategy);
  }
}

}  // namespace lanelight::test
