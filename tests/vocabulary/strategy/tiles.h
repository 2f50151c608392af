// Renders as estimates that tests compare: pixel by pixel, or tile by tile where pixels
// depend on each other.
#pragma once

#include <string>
#include <vector>

#include "src/scene/prepare/tables.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {

inline stat::ImageEstimate EstimateWith(const SceneDescription& scene,
                                        const std::string& strategy, std::uint64_t spp,
                                        std::uint64_t seed) {
  TestRender options;
  options.spp = spp;
  options.seed = seed;
  options.strategy = strategy;
  options.planned_samples = kMinTrainingSamples;  // what is learned need not be good
  const Rendered render = RenderDescription(scene, options);
  CHECK(render.result.health.Total() == 0);
  return Estimate(render);
}

// Pixels of a block depend on each other, so that tiles are what several renders tell of:
// an image of one pixel for each.
inline stat::ImageEstimate TilesOf(const stat::ImageEstimate& image, int tile) {
  const int width = image.width / tile, height = image.height / tile;
  stat::ImageEstimate out = {width, height, image.observations, {}, {}};
  const double pixels = tile * tile;
  for (int i = 0; i < width * height; ++i) {
    Rgb mean, variance;
    for (int p = 0; p < tile * tile; ++p) {
      const int x = i % width * tile + p % tile, y = i / width * tile + p / tile;
      const auto at = static_cast<std::size_t>(y * image.width + x);
      mean += image.mean[at] / pixels;
      variance += image.variance[at] / (pixels * pixels);
    }
    out.mean.push_back(mean);
    out.variance.push_back(variance);
  }
  return out;
}

/// Renders of different seeds, `spp` in all.
inline std::vector<stat::ImageEstimate> RenderOften(const SceneDescription& scene,
                                                    const std::string& strategy,
                                                    std::uint64_t spp,
                                                    std::uint64_t seed) {
  constexpr int kRenders = 16;
  std::vector<stat::ImageEstimate> renders;
  for (int i = 0; i < kRenders; ++i) {
    renders.push_back(EstimateWith(scene, strategy, spp / kRenders, kRenders * seed + i));
  }
  return renders;
}

inline stat::ImageEstimate TilesOf(const std::vector<stat::ImageEstimate>& renders,
                                   int tile) {
  std::vector<stat::ImageEstimate> tiles;
  for (const stat::ImageEstimate& render : renders) {
    tiles.push_back(TilesOf(render, tile));
  }
  const double n = double(tiles.size());
  stat::ImageEstimate out = tiles[0];
  out.observations = tiles.size();
  for (std::size_t p = 0; p < out.mean.size(); ++p) {
    Rgb sum, squares;
    for (const auto& render : tiles) sum += render.mean[p];
    out.mean[p] = sum / n;
    for (const auto& render : tiles) {
      const Rgb d = render.mean[p] - out.mean[p];
      squares += d * d;
    }
    out.variance[p] = squares / (n * (n - 1));
  }
  return out;
}

inline stat::ImageEstimate RenderTiles(const SceneDescription& scene,
                                       const std::string& strategy, std::uint64_t spp,
                                       std::uint64_t seed, int tile) {
  return TilesOf(RenderOften(scene, strategy, spp, seed), tile);
}

}  // namespace lanelight::test
