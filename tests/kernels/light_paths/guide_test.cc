// Light subpaths from infinity start where a training pass has found light; those that a
// trial run chooses leave caustics of lights without extent out.
#include <catch2/catch.hpp>

#include "src/render/plan/plan_features.h"
#include "src/render/train/training.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/compiled/scene.h"
#include "src/scene/prepare/emission_guide.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/kernels/reuse/same_light.h"

namespace lanelight::test {
namespace {

constexpr std::uint64_t kGuidedSpp = 8192;

// A room with a window of a twentieth of a wall.
SceneBuilder Room(int depth) {
  SceneBuilder b(8, 8);
  b.Depth(depth).Perspective({0, -0.9, 1}, {-0.3, 0.5, 0.6}, {0, 0, 1}, 70);
  const Index white = b.AddDiffuse({0.7, 0.6, 0.5}), red = b.AddDiffuse({0.8, 0.3, 0.2});
  b.AddQuad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, red);
  b.AddQuad({-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, white);
  for (const double side : {-1.0, 1.0}) {
    b.AddQuad({-1, side, 0}, {2, 0, 0}, {0, 0, 2}, white);
  }
  b.AddQuad({-1, -1, 0}, {0, 2, 0}, {0, 0, 2}, white);
  // The wall of the window: below, above and beside it.
  b.AddQuad({1, -1, 0}, {0, 2, 0}, {0, 0, 1.1}, white);
  b.AddQuad({1, -1, 1.6}, {0, 2, 0}, {0, 0, 0.4}, white);
  b.AddQuad({1, -1, 1.1}, {0, 0.8, 0}, {0, 0, 0.5}, white);
  b.AddQuad({1, 0.2, 1.1}, {0, 0.8, 0}, {0, 0, 0.5}, white);
  return b;
}

// The same, and wide ground outside.
SceneBuilder Outdoors(int depth) {
  SceneBuilder b = Room(depth);
  b.AddQuad({-9, -9, -1}, {18, 0, 0}, {0, 18, 0}, b.AddDiffuse({0.5, 0.4, 0.3}));
  return b;
}

void AddSun(SceneBuilder& b) { b.AddDistant({0.8, 0.1, 0.4}, {6, 5, 4}); }

// Returns the guide after a short training.
EmissionGuide GuideOf(const SceneBuilder& b) {
  PreparedScene scene = PrepareScene(b.Build());
  Strategy strategy = scene.strategy;
  ApplyStrategy("light-paths=splats", {}, strategy);
  scene = WithStrategy(scene, strategy);
  PlanOptions options;
  options.max_depth = 4;
  options.target = TestTarget();
  const Plan plan = MakePlan(scene, options);
  REQUIRE(plan.features.Has(Feature::kGuidedEmission));
  StrategyTables tables;
  TrainingOptions training;
  training.planned_samples = 1 << 20;
  Train({scene, plan, 3, training, tables});
  return tables.emission;
}

}  // namespace

TEST_CASE("subpaths from the sun and the sky learn to pass a window", "[light_paths]") {
  SceneBuilder b = Outdoors(4);
  AddSun(b);
  b.AddEnvironment({0.5, 0.7, 1});
  const EmissionGuide guide = GuideOf(b);
  REQUIRE(guide.has_learned());
  // The disk is 26 wide, the window 0.6 x 0.5: of its cells few are seen.
  int likely = 0;
  double most = 0;
  for (std::uint32_t i = 0; i < EmissionGuide::kSunSide * EmissionGuide::kSunSide; ++i) {
    const double pmf = double(guide.pmf[i]);
    if (pmf > 1e-3) ++likely, most += pmf;
  }
  CHECK(most > 0.9);
  CHECK(likely < 100);
  // Both lights bring much, and none of them is given up.
  for (const float pmf : guide.lights.pmf) CHECK(pmf > 0.01f);
}

TEST_CASE("splats: guided subpaths from the sun and the sky through a window",
          "[light_paths]") {
  SceneBuilder b = Outdoors(4);
  AddSun(b);
  ReuseScene sun = {b.Build(), kGuidedSpp, 0.05};
  CheckSame(sun, "points=sobol", "light-paths=splats:1");
  b.AddEnvironment({0.5, 0.7, 1});
  b.AddQuad({-0.3, -0.3, 1.99}, {0.2, 0, 0}, {0, -0.2, 0}, 0, b.AddEmission({3, 2, 1}));
  ReuseScene both = {b.Build(), kGuidedSpp, 0.05};
  CheckSame(both, "points=sobol", "light-paths=splats:1");
  // A sun that no window lets in: the sky's share is far above that by power.
  SceneBuilder dark = Room(4);
  dark.AddDistant({-0.8, 0.1, 0.4}, {60, 50, 40});
  dark.AddEnvironment({0.5, 0.7, 1});
  ReuseScene sky = {dark.Build(), 2 * kGuidedSpp, 0.05};
  CheckSame(sky, "points=sobol", "light-paths=splats:1");
}

// The image of a strategy that a trial run has chosen.
TEST_CASE("subpaths that a trial run chooses find what camera paths find",
          "[light_paths][decision]") {
  SceneBuilder b = Room(4);
  AddSun(b);
  b.AddPoint({0.2, 0.3, 1.5}, {0.4, 0.5, 0.6});
  b.AddSphere({-0.3, 0.3, 0.7}, 0.3, b.AddDielectric(1.5));
  b.AddQuad({-0.99, -1, 0}, {0, 1, 0}, {0, 0, 1}, b.AddConductor(Grey(1e-3), Grey(1e4)));
  const SceneDescription description = b.Build();
  const auto render = [&](bool caustics, std::uint64_t seed) {
    std::vector<stat::ImageEstimate> images;
    for (int i = 0; i < 16; ++i) {
      TestRender options;
      options.spp = kGuidedSpp / 16;
      options.seed = 16 * seed + std::uint64_t(i);
      options.strategy = caustics ? "light-paths=splats:1" : "decide=pilot";
      options.chosen = caustics ? "" : "light-paths=splats:1,decide=none";
      images.push_back(Estimate(RenderDescription(description, options)));
    }
    return images;
  };
  const auto truth = RenderOften(description, "points=sobol", 4 * kGuidedSpp, 1);
  const auto chosen = render(false, 3), asked = render(true, 5);
  for (const int tile : {8, 2}) {
    const stat::ImageTestResult result = stat::CompareMeans(
        TilesOf(chosen, tile), TilesOf(truth, tile), {1, 1e-6, kFloatTolerance, 1e-7});
    INFO(result.ToString());
    CHECK(result.same);
    CHECK(result.detectable_bias < 0.2);
  }
  CHECK(TilesOf(asked, 8).mean[0][1] > 1.05 * TilesOf(truth, 8).mean[0][1]);
}

}  // namespace lanelight::test
