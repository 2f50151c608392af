// Our own scenes with a closed form in their header render to it, at reduced resolution.
#include <catch2/catch.hpp>

#include "tests/agreement/agreement.h"
#include "tests/reference/closed_forms.h"

namespace lanelight::test {
namespace {

SceneDescription LoadScene(const std::string& name, int width, int height) {
  SceneDescription scene =
      ParseScene(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/" + name + ".pbrt");
  scene.film.width = width;
  scene.film.height = height;
  return scene;
}

stat::ImageTestResult CompareScene(const std::string& name, int size, std::uint64_t spp,
                                   const std::function<Rgb(int, int)>& exact,
                                   double tolerance = kFloatTolerance) {
  const auto image = RenderWavefront(LoadScene(name, size, size), spp);
  return stat::CompareMeans(image, stat::ExpectedImage(size, size, exact),
                            {4, 1e-6, tolerance, 0});
}

void CheckConstant(const std::string& name, int size, std::uint64_t spp, double value,
                   double power) {
  const auto result =
      CompareScene(name, size, spp, [=](int, int) { return Grey(value); });
  INFO(name << ": " << result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < power);
}

}  // namespace

TEST_CASE("own scenes: furnace and closed rooms conserve energy", "[scenes]") {
  CheckConstant("furnace", 24, 256, 1, 0.02);
  CheckConstant("closed-room", 16, 256, 2, 0.02);
  CheckConstant("white-balance", 16, 64, 1, 0.02);
  CheckConstant("stiff/albedo-0.999", 4, 128, 1000, 0.2);
}

TEST_CASE("own scenes: a light of 1e-5 of the scene", "[scenes]") {
  constexpr int kSize = 16, kSub = 8;
  const auto result = CompareScene(
      "stiff/tiny-light", kSize, 256,
      [&](int x, int y) {
        double sum = 0;
        for (int i = 0; i < kSub * kSub; ++i) {
          const double a = 2 * (x + (i % kSub + 0.5) / kSub) / kSize - 1;
          const double b = 2 * (y + (i / kSub + 0.5) / kSub) / kSize - 1;
          const double distance = std::sqrt(1 + a * a + b * b);
          sum += closed_form::PointLightOnPlane(Scattering::kLambertian, 0.5, 3, distance,
                                                1 / distance);
        }
        return Grey(sum / (kSub * kSub));
      },
      1e-3);
  INFO(result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < 0.01);
}

TEST_CASE("own scenes: twelve decades of radiance are exact", "[scenes]") {
  const auto image = RenderWavefront(LoadScene("stiff/twelve-decades", 260, 20), 4);
  for (int k = 0; k <= 12; ++k) {
    const double exact = std::pow(10, k - 6);
    CHECK(image.mean[10 * 260 + 249 - 20 * k].y == Approx(exact).epsilon(1e-6));
    CHECK(image.mean[10 * 260 + 259 - 20 * k].y == 0);
  }
}

TEST_CASE("own scenes: two plates with a gap of 1e-4", "[scenes]") {
  const auto result = CompareScene(
      "stiff/thin-gap", 8, 1024,
      [](int, int y) { return Grey(y < 4 ? 4.0 / 3 : 2.0 / 3); }, 1e-3);
  INFO(result.ToString());
  CHECK(result.same);
  CHECK(result.detectable_bias < 0.02);
}

TEST_CASE("own scenes: units and distance from the origin do not matter", "[scenes]") {
  const auto mean = [](const stat::ImageEstimate& image) {
    Rgb sum;
    for (const Rgb& m : image.mean) sum += m / static_cast<double>(image.mean.size());
    return sum;
  };
  const auto unit = RenderWavefront(LoadScene("stiff/scale-1", 32, 32), 128);
  for (const char* name : {"stiff/scale-1e-9", "stiff/scale-1e9", "stiff/far-away"}) {
    const auto other = RenderWavefront(LoadScene(name, 32, 32), 128);
    // The random numbers are the same, so nearly all paths are: the means agree far
    // better than their noise.
    INFO(name);
    for (int c = 0; c < 3; ++c) {
      CHECK(mean(other)[c] == Approx(mean(unit)[c]).epsilon(1e-3));
    }
    stat::CheckSame(stat::CompareMeans(unit, other));
  }
}

}  // namespace lanelight::test
