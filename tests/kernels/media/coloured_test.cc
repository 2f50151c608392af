// Media whose channels scatter at different rates: paths are sampled for all channels
// together, and remember how likely each would have made them.
#include <catch2/catch.hpp>
#include <string>

#include "tests/agreement/agreement.h"
#include "tests/kernels/media/scenes.h"

namespace lanelight::test {
namespace {

// Shells of two white media around each other, whose colours are opposite, in an even sky
// of radiance 1: nothing of them can be seen.
SceneDescription WhiteShells(bool grid) {
  SceneBuilder b(4, 4);
  b.Depth(4000).Orthographic({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.7);
  const Index interface = AddInterface(b);
  const Index red = AddMedium(b, MakeMedium({}, {9, 3, 1}, 0.3));
  Medium other = MakeMedium({}, {1, 4, 12}, -0.2);
  if (grid) {
    other.kind = MediumKind::kUniformGrid;
    other.grid_size[0] = other.grid_size[1] = 1, other.grid_size[2] = 8;
    other.grid = {0.2f, 2, 0.1f, 1, 0.5f, 3, 0.3f, 1};
    other.box_min = {-2, -2, -1};
    other.box_max = {2, 2, 1};
  }
  const Index blue = AddMedium(b, other);
  for (int i = 0; i < 6; ++i) {
    b.AddSphere({0, 0, 0}, 1 - 0.15 * i, interface);
    const bool odd = i % 2 != 0;
    Bound(b, odd ? blue : red, i == 0 ? kNone : odd ? red : blue);
  }
  b.AddEnvironment(Grey(1));
  return b.Build();
}

stat::ImageEstimate RenderPlainPaths(const SceneDescription& scene, std::uint64_t spp) {
  TestRender options;
  options.spp = spp;
  options.strategy = "directions=bsdf,roulette=none";
  const Rendered render = RenderDescription(scene, options);
  CHECK(render.result.health.Total() == 0);
  return Estimate(render);
}

}  // namespace

TEST_CASE("media: shells of opposite colours in a white furnace", "[media]") {
  const auto known = stat::ExpectedImage(4, 4, [](int, int) { return Grey(1); });
  for (const bool grid : {false, true}) {
    stat::CheckSame(stat::CompareMeans(RenderPlainPaths(WhiteShells(grid), 16384), known,
                                       {4, 1e-6, kFloatTolerance, 1e-7}),
                    0.02, fmt::format("grid {}", grid));
  }
}

// By the balance heuristic over whole paths a throughput is 3 at most, however many
// events there are. So samples of mean m in a sky of radiance 1 vary by m (3 - m) at
// most: no statistics.
TEST_CASE("media: throughputs are three at most", "[media]") {
  for (const bool grid : {false, true}) {
    const auto image = RenderPlainPaths(WhiteShells(grid), 1024);
    const double n = image.observations;
    for (std::size_t i = 0; i < image.mean.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const double mean = image.mean[i][c], variance = n * image.variance[i][c];
        INFO("grid " << grid << ", pixel " << i << ", channel " << c);
        CHECK(variance > 0);
        CHECK(variance <= 1.001 * n / (n - 1) * mean * (3 - mean));
      }
    }
  }
}

}  // namespace lanelight::test
