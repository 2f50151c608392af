// Whatever a guide says, the image is the same: lopsided random guides, which nobody
// would want, on every material and with every choice that weighs directions.
#include <catch2/catch.hpp>

#include "src/stat/hypothesis.h"
#include "tests/guide/guided_render.h"
#include "tests/guide/random_guide.h"
#include "tests/reference/closed_forms.h"

namespace lanelight::test {
namespace {

constexpr double kFalseAlarm = 1e-4;  // of each test case

const Guide& Lopsided() {
  static const Guide guide = RandomGuide({.seed = 61, .levels = 6});
  return guide;
}

stat::ImageTestOptions Level(int tests) {
  return {8, stat::SidakLevel(kFalseAlarm, tests), kFloatTolerance, 1e-7};
}

void CheckSame(const stat::ImageEstimate& a, const stat::ImageEstimate& b, int tests,
               double power) {
  const stat::ImageTestResult result = stat::CompareMeans(a, b, Level(tests));
  INFO(result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < power);
}

stat::ImageEstimate Truth(const SceneDescription& scene, int samples) {
  return Estimate(
      RenderReference(scene, Options(ReferenceEstimator::kLightSampling, samples)));
}

}  // namespace

TEST_CASE("guided: a white furnace of every material", "[guide]") {
  const std::vector<Material> zoo = MaterialZoo();
  for (const Material& material : zoo) {
    const SceneDescription scene = Furnace(material, 3, 8);
    const stat::ImageEstimate plain = RenderGuided(scene, {.spp = 4096, .seed = 1});
    INFO(material.name);
    for (const char* directions : {"directions=bsdf", "directions=mis"}) {
      const stat::ImageEstimate guided = RenderGuided(
          scene, {.strategy = directions, .spp = 4096, .seed = 2, .guide = &Lopsided()});
      CheckSame(guided, plain, 2 * static_cast<int>(zoo.size()), 0.03);
    }
  }
}

TEST_CASE("guided: plates of every material under lights of every kind", "[guide]") {
  const std::vector<Material> zoo = MaterialZoo();
  const char* const choices[] = {"directions=bsdf", "directions=light",
                                 "directions=mis:power", "directions=mis:balance"};
  int next = 0;
  for (const Material& material : zoo) {
    const SceneDescription scene = Plate(material, 8, 3);
    const stat::ImageEstimate plain = RenderGuided(scene, {.spp = 2048, .seed = 3});
    for (int i = 0; i < 2; ++i) {
      const std::string strategy = choices[next++ % 4];
      INFO(material.name << ", " << strategy);
      CheckSame(RenderGuided(
                    scene,
                    {.strategy = strategy, .spp = 2048, .seed = 4, .guide = &Lopsided()}),
                plain, 2 * static_cast<int>(zoo.size()), 0.15);
    }
  }
}

TEST_CASE("guided: the image of the scalar reference", "[guide]") {
  const SceneDescription scene = SmallRoom(8, 3, 0.4);
  const stat::ImageEstimate truth = Truth(scene, 16384);
  const char* const strategies[] = {"directions=bsdf", "directions=light",
                                    "directions=mis", "directions=mis,roulette=constant"};
  for (const char* strategy : strategies) {
    INFO(strategy);
    CheckSame(
        RenderGuided(
            scene, {.strategy = strategy, .spp = 9216, .seed = 5, .guide = &Lopsided()}),
        truth, 4, 0.05);
  }
}

TEST_CASE("guided: one bounce, and none", "[guide]") {
  for (int depth : {0, 1}) {
    const SceneDescription scene = SmallRoom(8, depth, 0.4);
    CheckSame(RenderGuided(scene, {.spp = 32768, .seed = 8, .guide = &Lopsided()}),
              RenderGuided(scene, {.spp = 32768, .seed = 9}), 2, 0.05);
  }
}

TEST_CASE("guided: the closed room has its closed form", "[guide]") {
  const SceneDescription scene = ClosedRoom(0.9, 8);
  const auto truth = stat::KnownImage(scene.film.width, scene.film.height, [](int, int) {
    return Grey(closed_form::ClosedRoom(1, 0.9, 8));
  });
  for (const char* directions : {"directions=bsdf", "directions=mis"}) {
    CheckSame(
        RenderGuided(
            scene,
            {.strategy = directions, .spp = 16384, .seed = 10, .guide = &Lopsided()}),
        truth, 2, 0.03);
  }
}

TEST_CASE("guided: planted errors of a guide are found", "[guide]") {
  const SceneDescription scene = ClosedRoom(0.9, 4);
  const auto truth = stat::KnownImage(scene.film.width, scene.film.height, [](int, int) {
    return Grey(closed_form::ClosedRoom(1, 0.9, 4));
  });
  const auto same = [&](const Guide& guide) {
    const GuidedRender options = {.strategy = "directions=bsdf,roulette=none",
                                  .spp = 131072,
                                  .seed = 11,
                                  .guide = &guide};
    const stat::ImageTestResult result =
        stat::CompareMeans(RenderGuided(scene, options), truth, Level(1));
    UNSCOPED_INFO(result.ToString());
    return result.same;
  };
  CHECK(same(Lopsided()));
  Guide dense = Lopsided();  // the density off by 1 %
  for (float& density : dense.density) density *= 1.01f;
  CHECK_FALSE(same(dense));
  Guide stale = Lopsided();  // the density of the neighbouring cell
  std::rotate(stale.density.begin(), stale.density.begin() + kGuideSquares,
              stale.density.end());
  CHECK_FALSE(same(stale));
}

TEST_CASE("guided: a guide that knows nothing gives the image of none", "[guide]") {
  const Guide guide = UnknowingGuide();
  for (const char* directions :
       {"directions=bsdf", "directions=light", "directions=mis"}) {
    const SceneDescription scene = SmallRoom(8, 4, 0.4);
    const auto with =
        RenderGuided(scene, {.strategy = directions, .spp = 64, .guide = &guide});
    const auto without = RenderGuided(scene, {.strategy = directions, .spp = 64});
    INFO(directions);
    for (std::size_t i = 0; i < with.mean.size(); ++i) {
      CHECK(with.mean[i] == without.mean[i]);
    }
  }
}

}  // namespace lanelight::test
