// Renders with and without reuse=block are compared by tiles, whose pixels depend on each
// other.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "src/base/stat/hypothesis.h"
#include "tests/reference/scenes.h"
#include "tests/vocabulary/strategy/tiles.h"

namespace lanelight::test {

struct ReuseScene {
  SceneDescription description;
  std::uint64_t spp = 8192;
  double power = 0.02;  // relative error of the image that is found
  std::vector<stat::ImageEstimate> truths = {};  // rendered by the first comparison
};

inline constexpr double kReuseFalseAlarm = 1e-6;  // of each comparison

// Neighbours may gain what others lose: the image as a whole, and tile by tile, each for
// itself, as tiles depend on each other too.
inline constexpr int kServedTile = 2;

inline stat::ImageEstimate OfPixel(const stat::ImageEstimate& image, std::size_t pixel) {
  return {1, 1, image.observations, {image.mean[pixel]}, {image.variance[pixel]}};
}

/// Compares a render with path reuse with renders without it. All comparisons of a scene
/// share these: every strategy without reuse has the same mean.
inline void CheckSame(ReuseScene& scene, const std::string& alone,
                      const std::string& reuse) {
  const int side = scene.description.film.width;
  if (scene.truths.empty()) {
    scene.truths = RenderOften(scene.description, "points=sobol", 4 * scene.spp, 1);
  }
  const auto images = RenderOften(scene.description, alone + "," + reuse, scene.spp, 7);
  for (const int tile : {side, kServedTile}) {
    const stat::ImageEstimate truth = TilesOf(scene.truths, tile);
    const stat::ImageEstimate image = TilesOf(images, tile);
    const auto tiles = static_cast<int>(image.mean.size());
    for (std::size_t i = 0; i < image.mean.size(); ++i) {
      const stat::ImageTestResult result =
          stat::CompareMeans(OfPixel(image, i), OfPixel(truth, i),
                             {1, kReuseFalseAlarm / tiles, kFloatTolerance, 1e-7});
      INFO(alone << "," << reuse << ", tile " << i << ": " << result.ToString());
      CHECK(result.same);
      if (tile == side) CHECK(result.detectable_bias < scene.power);
    }
  }
}

// Under a lamp as large as the ceiling, side walls, the materials behind the first, that
// are made of something else.
inline ReuseScene WithSides(const Material& sides, int max_depth) {
  ReuseScene room = {SmallRoom(8, max_depth, 0.95)};
  for (const std::size_t i : {1u, 2u}) room.description.materials[i] = sides;
  return room;
}

}  // namespace lanelight::test
