// Images of one scene and strategy, one for each seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/core/vec.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight::test {

/// Pixels row by row.
struct SeedImage {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;
};

/// Which images: `count` seeds from `first` on, `spp` samples per pixel each.
struct SeedRange {
  std::uint64_t first = 1;
  int count = 16;
  std::uint64_t spp = 8;
};

/// Renders the scene with `strategy` on top of its own, once per seed. Throws InputError
/// where the scene refuses the strategy; requires that no sample is bad.
std::vector<SeedImage> RenderSeeds(const PreparedScene& scene,
                                   const std::string& strategy, const SeedRange& seeds);

}  // namespace lanelight::test
