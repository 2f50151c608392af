// How a render is cut into tasks: (tile x sample range), independent of the number of
// threads, so that the sums of a pixel always run in the same order.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

struct TilePartition {
  int side = 16;               // pixels
  std::uint32_t samples = 32;  // per task
  std::vector<PixelRect> tiles;
};

/// Tasks of about 8192 samples: enough to amortise the drain of a wavefront at the end,
/// few enough that the sample buffer stays in the cache and threads stay busy. Tiles are
/// at least 16 pixels wide, and larger where there are few samples.
TilePartition MakePartition(const PixelRect& pixels, std::uint64_t spp);
/// The same for a strategy: paths of reuse=block serve their tile, which must be the same
/// for any number of samples.
TilePartition MakePartition(const PixelRect& pixels, std::uint64_t spp,
                            const Strategy& strategy);

/// Samples of a task of a tile of so many pixels.
std::uint32_t SamplesPerTask(std::uint64_t pixels, std::uint64_t spp);

/// The window in tiles whose sides are `side`, from the image's origin on.
std::vector<PixelRect> TilesOf(const PixelRect& window, int side);

/// Tiles in parts, one for each of so many threads, whose cost is expected to be in
/// proportion to these: dealt out in turn along a Z-order curve, which passes neighbours,
/// whose cost is alike, one after the other. Where there are few tiles for the parts they
/// are halved, down to `least_side`. Parts may be empty.
std::vector<std::vector<PixelRect>> DealTiles(const std::vector<PixelRect>& tiles,
                                              const std::vector<int>& threads,
                                              int least_side);

/// Pixel indices (y * image_width + x) of a tile in 4x4 blocks, so that a vector of lanes
/// starts with neighbouring rays.
void TilePixels(const PixelRect& tile, int image_width,
                std::vector<std::uint32_t>* pixels);

}  // namespace lanelight
