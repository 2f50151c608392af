// control=regression in renders: the variance that theory says goes, the mean stays.
#include <catch2/catch.hpp>

#include "src/scene/parse/parse.h"
#include "tests/kernels/control/control_scenes.h"
#include "tests/reference/closed_forms.h"

namespace lanelight::test {

TEST_CASE("regression: renders of smooth light", "[control]") {
  const int size = 32;
  const std::vector<Vec3d> corners = PolygonCorners();
  const auto exact = stat::ExpectedImage(size, size, [&](int x, int y) {
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      const Vec3d p = FilmPoint(x + (k % 2 + 0.5) / 2, y + (k / 2 + 0.5) / 2, size);
      sum += closed_form::PolygonIrradiance(3, corners, p, {0, 0, 1}) / 4;
    }
    return Grey(0.5 / std::numbers::pi * sum);
  });
  const SceneDescription scene = PolygonLight(size);
  const Rendered plain = RenderWith(scene, "directions=light", 128);
  const Rendered fitted = RenderWith(scene, "directions=light,control=regression", 128);
  INFO(MeanVariance(plain) << " " << MeanVariance(fitted));
  CHECK(MeanVariance(fitted) < 0.65 * MeanVariance(plain));
  stat::CheckSame(stat::CompareMeans(Estimate(fitted), exact, {8, 1e-6, 5e-4, 1e-6}));
}

TEST_CASE("regression: reflection and transmission of glass", "[control]") {
  // Radiance 1 behind a sheet and 5 in front of it: all of the variance is the choice.
  Material sheet;
  sheet.kind = MaterialKind::kThinDielectric;
  SceneBuilder b(8, 8);
  b.Depth(2).Orthographic({0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 0.5);
  b.AddDisk({0, 0, 0}, {0, 0, 1}, 2, b.AddMaterial(sheet));
  b.AddQuad({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}, b.AddDiffuse(Grey(0)),
            b.AddEmission(Grey(1)));
  b.AddEnvironment(Grey(5));
  const double once = closed_form::Fresnel(1, 1.5), reflected = 2 * once / (1 + once);
  const auto exact =
      stat::ExpectedImage(8, 8, [&](int, int) { return Grey(1 + 4 * reflected); });
  const Rendered plain = RenderWith(b.Build(), "", 32);
  const Rendered fitted = RenderWith(b.Build(), "control=regression", 32);
  CHECK(stat::CompareMeans(Estimate(plain), exact, {8, 1e-6, 1e-6, 1e-7}).same);
  const auto result = stat::CompareMeans(Estimate(fitted), exact, {8, 1e-6, 1e-6, 1e-7});
  INFO(result.ToString() << "; " << MeanVariance(plain) << " " << MeanVariance(fitted));
  CHECK(result.same);
  CHECK(result.detectable_bias < 0.01);
  CHECK(MeanVariance(fitted) < 0.1 * MeanVariance(plain));
}

TEST_CASE("regression: the founding paper's scene", "[control]") {
  SceneDescription scene = ParseScene(LANELIGHT_SOURCE_DIR "/scenes/paper.pbrt");
  scene.film.width = 24, scene.film.height = 15;
  stat::CheckSame(
      CompareWithReference(scene, 1024, 1024, kFloatTolerance, "paper-control"), 0.03);
  CHECK(MeanVariance(RenderWith(scene, "paper-control", 64)) <
        0.7 * MeanVariance(RenderWith(scene, "paper-plain", 64)));
}

TEST_CASE("regression: few samples, many images of a room", "[control]") {
  const SceneDescription scene = SmallRoom(8);
  const Rendered plain = RenderWith(scene, "", 2048, 99);
  for (const char* strategy :
       {"control=regression", "control=regression,points=sobol,pairs=antithetic"}) {
    stat::ImageEstimate sum;
    constexpr int kImages = 24;
    for (std::uint64_t seed = 0; seed < kImages; ++seed) {
      const stat::ImageEstimate one = Estimate(RenderWith(scene, strategy, 24, seed));
      if (seed == 0) sum = stat::ExpectedImage(8, 8, [](int, int) { return Rgb(); });
      sum.observations += one.observations;
      for (std::size_t i = 0; i < one.mean.size(); ++i) {
        sum.mean[i] += one.mean[i] / kImages;
        sum.variance[i] += one.variance[i] / (double(kImages) * kImages);
      }
    }
    stat::CheckSame(
        stat::CompareMeans(sum, Estimate(plain), {8, 1e-6, kFloatTolerance, 1e-7}),
        strategy);
  }
}

TEST_CASE("regression: images do not depend on threads and wavefront", "[control]") {
  CheckDeterminism(SmallRoom(20), "control=regression", 40);
}

}  // namespace lanelight::test
