// reuse=block against a plain version of the estimator (tests/reference/reuse.h). Not
// only the means agree, as for any unbiased estimator, but also the variances of pixels
// and of the whole image. These depend on the weights of pairs, on which pairs are made,
// and on what pixels of a block have in common.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "src/base/stat/hypothesis.h"
#include "tests/reference/compare.h"
#include "tests/reference/reuse.h"
#include "tests/reference/scenes.h"
#include "tests/vocabulary/strategy/tiles.h"

namespace lanelight::test {
namespace {

constexpr int kSide = 8, kBlock = 16;
constexpr int kRenders = 256, kSamples = 16, kGroups = 32;
constexpr double kTwinFalseAlarm = 1e-6;  // of each comparison

// A room whose second vertices see some of the first ones only: a wall stands between.
SceneDescription WallInRoom() {
  SceneBuilder b(kSide, kSide);
  b.Depth(4).Perspective({0, 1, 4.4}, {0, 1, 0}, {0, 1, 0}, 36);
  const Index white = b.AddDiffuse({0.7, 0.68, 0.65});
  const Index red = b.AddDiffuse({0.6, 0.08, 0.06});
  b.AddQuad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, white);
  b.AddQuad({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, white);
  b.AddQuad({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, white);
  b.AddQuad({-1, 0, -1}, {0, 2, 0}, {0, 0, 2}, red);
  b.AddQuad({1, 0, -1}, {0, 0, 2}, {0, 2, 0}, white);
  b.AddQuad({0, 0, -1}, {0, 1.4, 0}, {0, 0, 1.6}, red);
  b.AddPoint({0.5, 1.2, 0.3}, {2, 1.5, 1});
  return b.Build();
}

// What renders of independent seeds tell, with standard errors from their scatter.
struct Reported {
  stat::MeanEstimate mean;            // of the image, all channels
  stat::MeanEstimate pixel_variance;  // of a sample of a pixel
  stat::MeanEstimate image_variance;  // of the mean of the image at one sample per pixel
};

stat::MeanEstimate Scatter(const std::vector<double>& values) {
  double mean = 0, squares = 0;
  const double n = double(values.size());
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, squares / (n * (n - 1)), n - 1};
}

double Sum(Rgb c) { return c.x + c.y + c.z; }

Reported Report(const std::vector<stat::ImageEstimate>& renders) {
  std::vector<double> means, pixels, images;
  for (const stat::ImageEstimate& render : renders) {
    double mean = 0, variance = 0;
    for (const Rgb m : render.mean) mean += Sum(m) / double(render.mean.size());
    for (const Rgb v : render.variance) {
      variance += Sum(v) * kSamples / double(render.variance.size());
    }
    means.push_back(mean);
    pixels.push_back(variance);
  }
  const std::size_t group = means.size() / kGroups;
  for (std::size_t g = 0; g < kGroups; ++g) {
    const auto begin = means.begin() + static_cast<std::ptrdiff_t>(g * group);
    const stat::MeanEstimate of =
        Scatter({begin, begin + static_cast<std::ptrdiff_t>(group)});
    images.push_back(of.variance * double(group) * kSamples);
  }
  return {Scatter(means), Scatter(pixels), Scatter(images)};
}

Reported OfTwin(const SceneDescription& scene, const ReuseTwinOptions& twin_options) {
  std::vector<stat::ImageEstimate> renders(kRenders);
  ParallelFor(renders.size(), [&](std::size_t i) {
    ReuseTwinOptions options = twin_options;
    options.samples = kSamples;
    options.seed = 1000 + i;
    renders[i] = Estimate(RenderReuseReference(scene, options));
  });
  return Report(renders);
}

Reported OfRenderer(const SceneDescription& scene) {
  std::vector<stat::ImageEstimate> renders;
  for (int i = 0; i < kRenders; ++i) {
    renders.push_back(EstimateWith(scene, "directions=bsdf,roulette=none,reuse=block:16",
                                   kSamples, 1 + i));
  }
  return Report(renders);
}

bool Alike(const stat::MeanEstimate& a, const stat::MeanEstimate& b) {
  return stat::WelchPValue(a, b, kFloatTolerance * std::abs(a.mean)) > kTwinFalseAlarm;
}

std::string ToString(const Reported& t) {
  const auto text = [](const stat::MeanEstimate& e) {
    return fmt::format("{:.5g} +- {:.2g}", e.mean, std::sqrt(e.variance));
  };
  return fmt::format("mean {}, variance of pixels {}, of the image {}", text(t.mean),
                     text(t.pixel_variance), text(t.image_variance));
}

}  // namespace

TEST_CASE("reuse=block equals the reference implementation of its estimator", "[reuse]") {
  const SceneDescription scene = WallInRoom();
  const Reported renderer = OfRenderer(scene);
  const auto twin = [&](const ReuseTwinOptions& options) {
    Reported report = OfTwin(scene, options);
    UNSCOPED_INFO("twin: " << ToString(report));
    return report;
  };
  INFO("renderer: " << ToString(renderer));
  const Reported same = twin({});
  CHECK(Alike(renderer.mean, same.mean));
  CHECK(Alike(renderer.pixel_variance, same.pixel_variance));
  CHECK(Alike(renderer.image_variance, same.image_variance));

  // Faults of the mean.
  CHECK_FALSE(Alike(renderer.mean, twin({.forgets_visibility = true}).mean));
  CHECK_FALSE(Alike(renderer.mean, twin({.counts_owner_twice = true}).mean));
  CHECK_FALSE(Alike(renderer.mean, twin({.forgets_roulette = true}).mean));
  // An estimator with the right mean that is not this one.
  CHECK_FALSE(Alike(renderer.pixel_variance, twin({.block = 8}).pixel_variance));
  CHECK_FALSE(Alike(renderer.pixel_variance, twin({.kept = 1}).pixel_variance));
  CHECK_FALSE(Alike(renderer.image_variance, twin({.kept = 0.05}).image_variance));
}

}  // namespace lanelight::test
