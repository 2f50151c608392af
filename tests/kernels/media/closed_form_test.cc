// Media whose images are known.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/agreement/agreement.h"
#include "tests/kernels/media/scenes.h"

namespace lanelight::test {
namespace {

// No noise at all: what absorbers leave is a product.
void CheckExact(const SceneDescription& scene, const std::function<Rgb(int, int)>& f) {
  const auto image = RenderWavefront(scene, 4);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb found = image.mean[static_cast<std::size_t>(y) * image.width + x];
      const Rgb expected = f(x, y);
      INFO("pixel " << x << ", " << y);
      CHECK(found.x == Approx(expected.x).epsilon(2e-5));
      CHECK(found.y == Approx(expected.y).epsilon(2e-5));
      CHECK(found.z == Approx(expected.z).epsilon(2e-5));
    }
  }
}

Rgb Left(Rgb sigma, double length) {
  return {std::exp(-sigma.x * length), std::exp(-sigma.y * length),
          std::exp(-sigma.z * length)};
}

constexpr Rgb kSigma = {0.3, 1, 2.5};

}  // namespace

TEST_CASE("media: transmittance through a slab", "[media][closed-form]") {
  SceneBuilder b(4, 4);
  b.Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  b.AddBox({-3, -3, -0.4}, {3, 3, 0.4}, AddInterface(b));
  Bound(b, AddMedium(b, MakeMedium(kSigma, {})), kNone);
  b.AddEnvironment({1, 2, 3});
  CheckExact(b.Build(), [](int, int) { return Rgb{1, 2, 3} * Left(kSigma, 0.8); });
}

// Averaged over pixels, so by the closed form of the mean over the disk: chords of length
// 2 sqrt(1 - r^2) give 2 (1 - (1 + s) e^-s) / s^2 with s = 2 sigma.
TEST_CASE("media: transmittance through a sphere", "[media][closed-form]") {
  SceneBuilder b(1, 1);
  b.Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  b.AddSphere({0, 0, 0}, 1, AddInterface(b));
  Bound(b, AddMedium(b, MakeMedium(kSigma, {})), kNone);
  b.AddEnvironment(Grey(1));
  const auto image = RenderWavefront(b.Build(), 1 << 14);
  const double disk = std::numbers::pi / 4;
  const auto mean = [&](double sigma) {
    const double s = 2 * sigma;
    return 1 - disk + disk * 2 * (1 - (1 + s) * std::exp(-s)) / (s * s);
  };
  const auto known = stat::ExpectedImage(1, 1, [&](int, int) {
    return Rgb{mean(kSigma.x), mean(kSigma.y), mean(kSigma.z)};
  });
  stat::CheckSame(stat::CompareMeans(image, known, {1, 1e-6, kFloatTolerance, 1e-7}),
                  0.03);
}

TEST_CASE("media: emission of a slab", "[media][closed-form]") {
  SceneBuilder b(4, 4);
  b.Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  b.AddBox({-3, -3, -0.4}, {3, 3, 0.4}, AddInterface(b));
  Bound(b, AddMedium(b, MakeMedium(kSigma, {}, 0, {2, 2, 2})), kNone);
  CheckExact(b.Build(),
             [](int, int) { return 2.0 * (Rgb{1, 1, 1} - Left(kSigma, 0.8)); });
}

// A ball that scatters all light and absorbs none cannot be seen in front of a uniform
// environment, whatever its phase function: behind an interface, and behind a dielectric
// of index 1.
TEST_CASE("media: a white furnace", "[media][closed-form]") {
  for (const bool dielectric : {false, true}) {
    SceneBuilder b(4, 4);
    b.Depth(400).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.7);
    b.AddSphere({0, 0, 0}, 1, dielectric ? b.AddDielectric(1) : AddInterface(b));
    Bound(b, AddMedium(b, MakeMedium({}, {1, 3, 6}, 0.5)), kNone);
    b.AddEnvironment(Grey(1));
    const auto known = stat::ExpectedImage(4, 4, [](int, int) { return Grey(1); });
    stat::CheckSame(stat::CompareMeans(RenderWavefront(b.Build(), 4096), known,
                                       {4, 1e-6, kFloatTolerance, 1e-7}),
                    0.05, fmt::format("dielectric {}", dielectric));
  }
}

}  // namespace lanelight::test
