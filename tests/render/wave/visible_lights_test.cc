// seen-lights=apart: what the camera sees of a lamp's edge is its share of the pixel, to
// less noise than paths give, and nothing changes where there are no edges.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "src/render/plan/plan_features.h"
#include "src/render/wave/visible_lights.h"
#include "tests/reference/scenes.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight::test {
namespace {

constexpr int kSize = 8;
constexpr double kRadiance = 40, kEdge = 0.317;  // the lamp covers x < kEdge

// A black lamp that covers part of an orthographic film from -1 to 1, whose left edge is
// that of the film; its right one cuts through pixels, at an angle.
SceneDescription Lamp(double slope) {
  SceneBuilder b(kSize, kSize);
  b.Depth(3).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  const Index dark = b.AddDiffuse(Grey(0)), lamp = b.AddEmission(Grey(kRadiance), true);
  b.AddQuad({-3, -3, 0}, {3 + kEdge - 3 * slope, 0, 0}, {6 * slope, 6, 0}, dark, lamp);
  return b.Build();
}

double SumOfMeans(const FilmAccumulator& film) {
  double sum = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) sum += film.Mean(x, y).y;
  }
  return sum;
}
double SumOfVariances(const FilmAccumulator& film) {
  double sum = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) sum += film.Variance(x, y).y;
  }
  return sum;
}

Rendered RenderLamp(const std::string& strategy, std::uint64_t spp, double slope = 0.3) {
  TestRender t;
  t.strategy = strategy;
  t.spp = spp;
  return RenderDescription(Lamp(slope), t);
}

}  // namespace

TEST_CASE("rays of a light's edge are assigned once, to their own replicate",
          "[seen-lights]") {
  for (const SampleGroups groups :
       {SampleGroups{1, false}, {2, false}, {1, true}, {2, true}}) {
    const VisibleLightSamples samples{groups, 4};
    const std::uint64_t n = 24;
    std::multiset<std::uint64_t> used;
    for (std::uint64_t i = 0; i < n; ++i) {
      samples.ForEach(i, [&](std::uint64_t s) {
        used.insert(s);
        if (groups.replicates) CHECK(groups.Replicate(s) == groups.Replicate(i));
        CHECK(s >= samples.Begin(i));
        CHECK(s < samples.End(i + 1));
      });
    }
    // Paths of one unit share theirs.
    CHECK(used.size() == n * 4 * groups.unit);
    for (std::uint64_t s = 0; s < n * 4; ++s) CHECK(used.count(s) == groups.unit);
  }
}

TEST_CASE("pixels at a light's edge contain its covered fraction", "[seen-lights]") {
  // Area of the lamp within the film, in pixels: the edge leans about its middle.
  const double exact = kRadiance * kSize * kSize * (1 + kEdge) / 2;
  for (const char* points : {"independent", "sobol", "stratified", "halton"}) {
    for (const char* pairs : {"none", "antithetic"}) {
      for (std::uint64_t spp : {7, 64}) {
        const std::string rest = std::string(",points=") + points + ",pairs=" + pairs;
        INFO(rest << " " << spp);
        const Rendered apart = RenderLamp("seen-lights=apart" + rest, spp);
        const Rendered paths = RenderLamp("seen-lights=paths" + rest, spp);
        // Six standard errors, of the independent samples that a pixel has at least: a
        // false alarm in 10^8. Half a pixel of a lamp's edge is 0.25 radiance^2 a sample.
        const double error =
            kRadiance * std::sqrt(0.25 * 2 * kSize / (double(spp) * kVisibleLightRays));
        CHECK(std::abs(SumOfMeans(apart.film) - exact) < 6 * error);
        CHECK(apart.result.rays_closest > 2 * paths.result.rays_closest);
        if (spp < 64) continue;
        CHECK(SumOfVariances(apart.film) < 0.3 * SumOfVariances(paths.film));
      }
    }
  }
  // What a path's own camera ray sees, left in: all edge pixels twice as bright.
  CHECK(6 * kRadiance * std::sqrt(0.25 * 2 * kSize / (7.0 * kVisibleLightRays)) <
        0.25 * kRadiance * kSize);
}

TEST_CASE("scenes without visible light edges are bit-identical to path tracing",
          "[seen-lights]") {
  SceneBuilder b(kSize, kSize);
  b.Depth(3).Perspective({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 20);
  b.AddQuad({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, b.AddDiffuse(Grey(0.5)));
  b.AddQuad({-1, -1, 8}, {0, 2, 0}, {2, 0, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission(Grey(5)));  // behind the camera
  b.AddEnvironment(Grey(1));
  TestRender t;
  t.strategy = "seen-lights=apart";
  const Rendered apart = RenderDescription(b.Build(), t);
  t.strategy = "seen-lights=paths";
  const Rendered paths = RenderDescription(b.Build(), t);
  CHECK(Identical(apart.film, paths.film));
  CHECK(apart.result.rays_closest == paths.result.rays_closest);
}

TEST_CASE("only scenes with directly visible lights have stages for their edges",
          "[seen-lights]") {
  SceneBuilder b(kSize, kSize);
  b.AddQuad({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, b.AddDiffuse(Grey(0.5)));
  b.AddPoint({0, 0, 2}, Grey(1));
  CHECK(MakePlan(PrepareScene(b.Build(), {}), {}).Find(PhaseId::kVisibleLights) ==
        nullptr);
  b.AddEnvironment(Grey(1));
  const PreparedScene scene = PrepareScene(b.Build(), {});
  const Plan plan = MakePlan(scene, {});
  const Phase* const visible = plan.Find(PhaseId::kVisibleLights);
  REQUIRE(visible != nullptr);
  CHECK(plan.Find(PhaseId::kFindEdges) == nullptr);  // the scene is not spectral
  // Stages that shade or sample lights are not among them; all of them are stages of the
  // paths.
  for (const PlannedStage& seen : visible->stages) {
    INFO(seen.stage.name);
    CHECK(std::any_of(plan.paths().stages.begin(), plan.paths().stages.end(),
                      [&](const PlannedStage& planned) {
                        return std::string(planned.stage.name) == seen.stage.name;
                      }));
    CHECK(seen.stage.input != ShadeQueue(ShadeKind::kDiffuse));
    CHECK(seen.stage.input != QueueId::kShadow);
  }
}

TEST_CASE("a profile lists the stages of light edges", "[seen-lights]") {
  TestRender t;
  t.spp = 8;
  for (const bool apart : {true, false}) {
    t.strategy = apart ? "seen-lights=apart" : "seen-lights=paths";
    const Rendered rendered = RenderDescription(Lamp(0.3), t);
    std::uint64_t generated = 0, rows = 0;
    for (const StageProfile& row : rendered.result.stages) {
      if (!row.name.starts_with(InfoOf(PhaseId::kVisibleLights).prefix)) continue;
      ++rows;
      CHECK(row.seconds >= 0);
      if (row.name == "visible: generate") generated = row.items;
    }
    CHECK((rows > 0) == apart);
    // The rays that look for edges, and 17 for each sample of those found.
    CHECK((generated > kSize * kSize * 8) == apart);
  }
}

TEST_CASE("a lamp smaller than a pixel is found where the camera projects it",
          "[seen-lights]") {
  SceneBuilder b(64, 48);
  b.Perspective({1, -6, 2}, {0, 0, 1}, {0, 0, 1}, 40);
  const Index dark = b.AddDiffuse(Grey(0)), lamp = b.AddEmission(Grey(1e4));
  b.AddSphere({0.5, 0.3, 1.4}, 0.004, dark, lamp);
  b.AddSphere({1.2, -9, 2}, 0.004, dark, lamp);  // behind the camera
  const PreparedScene scene = PrepareScene(b.Build(), {});
  const auto places = PlacesOfSmallLights(scene);
  REQUIRE(!places.empty());
  CHECK(places.size() <= 4);
  // Rendered by force: the brightest pixel is one of them.
  TestRender t;
  t.spp = 4096;
  t.strategy = "seen-lights=paths";
  const Rendered rendered = RenderDescription(b.Build(), t);
  std::uint32_t brightest = 0;
  for (std::uint32_t p = 0; p < 64 * 48; ++p) {
    const auto mean = [&](std::uint32_t i) {
      return rendered.film.Mean(static_cast<int>(i % 64), static_cast<int>(i / 64)).y;
    };
    if (mean(p) > mean(brightest)) brightest = p;
  }
  REQUIRE(rendered.film
              .Mean(static_cast<int>(brightest % 64), static_cast<int>(brightest / 64))
              .y > 0);
  CHECK(std::count(places.begin(), places.end(), brightest) == 1);
}

}  // namespace lanelight::test
