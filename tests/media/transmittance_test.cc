// transmittance=delta: shadow rays through media that vary end at real collisions.
#include <catch2/catch.hpp>

#include "src/prepare/prepare_scene.h"
#include "src/wavefront/plan.h"
#include "tests/media/scenes.h"
#include "tests/wavefront/agreement.h"

namespace lanelight::test {
namespace {

constexpr const char* kDelta = "points=independent,transmittance=delta";

double MeanVariance(const stat::ImageEstimate& image) {
  double sum = 0;
  for (const Rgb v : image.variance) sum += v.x + v.y + v.z;
  return sum;
}

}  // namespace

TEST_CASE("media: delta tracking sees what the reference sees", "[media][agreement]") {
  for (const SceneDescription& scene : {Smoke(), NestedSmoke()}) {
    const auto result = CompareWithReference(scene, 4096, 3000, kFloatTolerance, kDelta);
    INFO(result.ToString());
    CHECK(result.same);
    CHECK(result.detectable_bias < 0.12);
  }
}

// Of the same collisions ratio tracking keeps the mean: delta tracking can only add
// variance (Novak, Selle and Jarosz 2014).
TEST_CASE("media: delta tracking is what is chosen, and noisier", "[media]") {
  const auto ratio = RenderWavefront(Smoke(), 4096);
  const auto delta = RenderWavefront(Smoke(), 4096, kDelta);
  CHECK(MeanVariance(delta) > MeanVariance(ratio));
}

TEST_CASE("media: delta tracking only where media vary", "[media][plan]") {
  const auto has = [](const SceneDescription& scene) {
    PlanOptions options;
    options.max_depth = 3;
    options.changes = kDelta;
    return MakePlan(PrepareScene(scene), options)
        .features.Has(Feature::kDeltaTransmittance);
  };
  CHECK(has(Smoke()));
  CHECK_FALSE(has(Fog()));
  CHECK_FALSE(has(SmallRoom(8, 3)));
}

}  // namespace lanelight::test
