// distances=equiangular: points around lights, in balance with those by transmittance.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/core/pi.h"
#include "src/render/plan/plan.h"
#include "src/scene/prepare/prepared_scene.h"
#include "tests/agreement/agreement.h"
#include "tests/kernels/media/scenes.h"

namespace lanelight::test {
namespace {

constexpr const char* kIndependent = "points=independent";
constexpr const char* kEquiangular = "points=independent,distances=equiangular";

// What a ray from the origin along z sees of a point light at (h, 0, a) in an endless
// medium.
struct Airlight {
  double h = 0.7, a = 2;
  Rgb sigma_a{0.05, 0.1, 0.4}, sigma_s{0.3, 0.6, 0.2};

  SceneDescription Scene() const {
    SceneBuilder b(1, 1);
    b.Depth(1).Perspective({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.01);
    b.AddPoint({h, 0, a}, Grey(3));
    b.scene().camera.medium = AddMedium(b, MakeMedium(sigma_a, sigma_s));
    return b.Build();
  }
  // Scattered once: integral of sigma_s / (4 pi) I / r^2 exp(-sigma_t (t + r)) dt, r^2 =
  // h^2 + (t - a)^2; with t = a + h tan x, dt / r^2 = dx / h.
  double Channel(double absorbed, double scattered) const {
    const double sigma_t = absorbed + scattered, first = std::atan(-a / h);
    const int steps = 100000;
    const double step = (kPi / 2 - first) / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double x = first + (i + 0.5) * step;
      sum += std::exp(-sigma_t * (a + h * std::tan(x) + h / std::cos(x))) * step;
    }
    return sum / h * 3 * scattered / (4 * kPi);
  }
  stat::ImageEstimate Known() const {
    return stat::ExpectedImage(1, 1, [&](int, int) {
      return Rgb{Channel(sigma_a.x, sigma_s.x), Channel(sigma_a.y, sigma_s.y),
                 Channel(sigma_a.z, sigma_s.z)};
    });
  }
};

void CheckAirlight(const Airlight& air, const char* strategy, std::uint64_t spp,
                   double power) {
  const auto image = RenderWavefront(air.Scene(), spp, strategy);
  stat::CheckSame(
      stat::CompareMeans(image, air.Known(), {1, 1e-6, kFloatTolerance, 1e-7}), power,
      fmt::format("{}, light at {}, {}", strategy, air.h, air.a));
}

Plan PlanOf(const SceneDescription& scene, const char* strategy) {
  SceneDescription copy = scene;
  ApplyStrategy(strategy, {}, copy.strategy);
  PlanOptions options;
  options.max_depth = 3;
  return MakePlan(PrepareScene(copy), options);
}

}  // namespace

TEST_CASE("media: single scattering from a point light", "[media][closed-form]") {
  CheckAirlight({}, kIndependent, 1 << 16, 0.03);
  CheckAirlight({}, kEquiangular, 1 << 18, 0.01);
}

// The nearer the light, the more of it comes from a short stretch, which transmittance
// hardly ever finds.
TEST_CASE("media: single scattering near and far from lights, in thin and thick media",
          "[media][closed-form]") {
  CheckAirlight({0.01, 2}, kEquiangular, 1 << 18, 0.02);
  CheckAirlight({0.02, -1}, kEquiangular, 1 << 16, 0.03);
  CheckAirlight({300, 40, {1e-5, 2e-5, 0}, {1e-3, 2e-3, 3e-3}}, kEquiangular, 1 << 16,
                0.03);
  CheckAirlight({0.5, 1, {1e-6, 1e-6, 1e-6}, {0.01, 0.02, 0.03}}, kEquiangular, 1 << 18,
                0.05);
  CheckAirlight({0.05, 0.1, {1, 3, 20}, {30, 10, 5}}, kEquiangular, 1 << 16, 0.03);
}

TEST_CASE("media: equiangular distances agree with the reference", "[media][agreement]") {
  const auto check = [](const SceneDescription& scene, std::uint64_t spp,
                        int reference_spp, double power) {
    stat::CheckSame(
        CompareWithReference(scene, spp, reference_spp, kFloatTolerance, kEquiangular),
        power);
  };
  check(Fog(), 8192, 12000, 0.09);
  check(NestedClouds(), 4096, 2500, 0.08);
  check(FilledGlass(), 4096, 2500, 0.12);
}

// Each event that lights draw can double the weight of a path.
TEST_CASE("media: equiangular distances make no rare bright samples of long paths",
          "[media]") {
  SceneBuilder b(4, 4);
  b.Depth(200).Perspective({0, -4, 0}, {0, 0, 0}, {0, 0, 1}, 25);
  b.AddSphere({0, 0, 0}, 1, AddInterface(b));
  Bound(b, AddMedium(b, MakeMedium(Grey(0.01), Grey(20))), kNone);
  b.AddPoint({2, -2, 2}, Grey(10));
  const auto variance = [&](const char* strategy) {
    const auto image = RenderWavefront(b.Build(), 4096, strategy);
    double sum = 0;
    for (const Rgb& v : image.variance) sum += v.y;
    return sum;
  };
  CHECK(variance(kEquiangular) < 4 * variance(kIndependent));
}

TEST_CASE("media: equiangular distances exist only where they have an effect",
          "[media][plan]") {
  constexpr Feature kFeature = Feature::kEquiangularDistances;
  CHECK(PlanOf(Fog(), kEquiangular).features.Has(kFeature));
  CHECK_FALSE(PlanOf(Fog(), kIndependent).features.Has(kFeature));
  CHECK_FALSE(PlanOf(SmallRoom(8, 3), kEquiangular).features.Has(kFeature));
  CHECK_FALSE(PlanOf(Smoke(), kEquiangular).features.Has(kFeature));
  SceneDescription sky = Fog();
  sky.lights.clear();
  for (Shape& shape : sky.shapes) shape.area_light = kNone;
  sky.lights.emplace_back();
  sky.lights.back().kind = LightKind::kInfinite;
  CHECK_FALSE(PlanOf(sky, kEquiangular).features.Has(kFeature));

  CHECK(PrepareScene(Fog()).chances->anchors.empty());
  SceneDescription around = Fog();
  ApplyStrategy(kEquiangular, {}, around.strategy);
  PreparedScene scene = PrepareScene(around);
  CHECK(scene.chances->anchors.size() == scene.compiled->lights.lights.size());
  scene = WithStrategy(scene, Strategy{});
  CHECK(scene.chances->anchors.empty());
}

}  // namespace lanelight::test
