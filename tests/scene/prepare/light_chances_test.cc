// environment=compensated: when it has an effect, that it can be undone, and that it
// lowers the variance where it should.
#include "src/scene/prepare/prepared_scene.h"

#include <catch2/catch.hpp>

#include "src/base/image/exr.h"
#include "src/render/plan/plan_features.h"
#include "tests/agreement/agreement.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight::test {
namespace {

// A sky of radiance 0.5 around a sun that gives about as much light as the sky.
std::string WriteSky(const TemporaryFolder& folder) {
  constexpr int kSize = 16;
  std::vector<ExrPlane> planes = {{"R", {}, true}, {"G", {}, true}, {"B", {}, true}};
  for (int i = 0; i < kSize * kSize; ++i) {
    for (ExrPlane& plane : planes) {
      plane.values.push_back(i == 6 * kSize + 9 ? 64.0f : 0.5f);
    }
  }
  WriteExr(folder.File("sky.exr"), kSize, kSize, planes);
  return folder.File("sky.exr");
}

// A ball on a plane under that sky.
SceneDescription UnderSky(const std::string& sky) {
  SceneBuilder b(16, 16);
  b.Depth(1).Perspective({0, -4, 3}, {0, 0, 0.3}, {0, 0, 1}, 36);
  const Index ground = b.AddDiffuse(Grey(0.6));
  b.AddPlane({0, 0, 0}, {0, 0, 1}, ground);
  b.AddSphere({0, 0, 0.5}, 0.5, ground);
  b.AddEnvironment(Grey(1));
  SceneDescription scene = b.Build();
  scene.lights.back().image_path = sky;
  return scene;
}

Strategy Parsed(const std::string& text) {
  Strategy strategy;
  ApplyStrategy(text, {}, strategy);
  return strategy;
}

const EnvironmentTable& SkyOf(const PreparedScene& scene) {
  return *scene.chances->environments.at(0);
}

// Sum over the pixels of the variance of their mean.
double SumOfVariances(const Rendered& render) {
  double sum = 0;
  for (const Rgb& v : Estimate(render).variance) sum += v.x + v.y + v.z;
  return sum;
}

Rendered RenderWith(const SceneDescription& scene, const std::string& strategy) {
  TestRender options;
  options.spp = 256;
  options.strategy = strategy;
  return RenderDescription(scene, options);
}

}  // namespace

TEST_CASE("compensated environments are for directions=mis", "[strategy]") {
  const TemporaryFolder folder;
  PreparedScene scene = PrepareScene(UnderSky(WriteSky(folder)));
  const AlignedVector<float> plain = SkyOf(scene).probability;
  for (const char* directions : {"uniform", "bsdf", "light"}) {
    const std::string text = std::string("directions=") + directions;
    scene = WithStrategy(scene, Parsed(text + ",environment=compensated"));
    INFO(text);
    CHECK(SkyOf(scene).probability == plain);
    const auto notes = CheckStrategy(scene, {});
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("environment=compensated has no effect") == 0);
  }
  scene = WithStrategy(scene, Parsed("environment=compensated"));
  CHECK(CheckStrategy(scene, {}).empty());
  CHECK(SkyOf(scene).probability[6 * 16 + 9] == 1);
  scene = WithStrategy(scene, Parsed("directions=light"));
  CHECK(SkyOf(scene).probability == plain);
}

TEST_CASE("MIS compensation of a scene can be switched off", "[strategy]") {
  const TemporaryFolder folder;
  SceneDescription description = UnderSky(WriteSky(folder));
  const PreparedScene plain = PrepareScene(description);
  description.strategy.environment = EnvironmentPoints::kCompensated;
  PreparedScene scene = PrepareScene(description);
  CHECK(SkyOf(scene).probability[0] == 0);
  scene = WithStrategy(scene, {});
  CHECK(SkyOf(scene).probability == SkyOf(plain).probability);
  CHECK(SkyOf(scene).column_cdf == SkyOf(plain).column_cdf);
}

TEST_CASE("a compensated environment has a plan key of its own", "[strategy]") {
  const TemporaryFolder folder;
  PreparedScene scene = PrepareScene(UnderSky(WriteSky(folder)));
  const auto key = [&](const std::string& strategy) {
    scene = WithStrategy(scene, Parsed(strategy));
    return PlanKey(scene, MakePlan(scene, {}));
  };
  CHECK(key("environment=compensated") != key(""));
  CHECK(key("environment=compensated,directions=light") == key("directions=light"));
}

TEST_CASE("a compensated environment without an image has no effect", "[strategy]") {
  SceneDescription description = UnderSky("");
  description.strategy.environment = EnvironmentPoints::kCompensated;
  const auto notes = CheckStrategy(PrepareScene(description), {});
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("no environment image") != std::string::npos);
}

TEST_CASE("a compensated environment lowers the variance under sky and sun",
          "[strategy]") {
  const TemporaryFolder folder;
  const SceneDescription scene = UnderSky(WriteSky(folder));
  // About 190 000 degrees of freedom each: the ratio of the sums is known within 2 %,
  // heavy tails included.
  for (const char* mis : {"mis:power", "mis:balance"}) {
    const std::string text = std::string("directions=") + mis;
    const Rendered plain = RenderWith(scene, text);
    const Rendered better = RenderWith(scene, text + ",environment=compensated");
    INFO(mis << ": " << SumOfVariances(better) / SumOfVariances(plain));
    CHECK(SumOfVariances(better) < 0.85 * SumOfVariances(plain));
  }
}

}  // namespace lanelight::test
