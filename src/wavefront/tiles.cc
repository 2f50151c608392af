#include "src/wavefront/tiles.h"

#include <algorithm>

namespace lanelight {

namespace {
constexpr std::uint64_t kSamplesPerTask = 8192;
constexpr int kBlock = 4;
}  // namespace

TilePartition MakePartition(const PixelRect& pixels, std::uint64_t spp) {
  TilePartition partition;
  partition.samples = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(spp, 1, 32));
  partition.side = 16;
  while (partition.side < 64 &&
         std::uint64_t(partition.side) * partition.side * 4 * partition.samples <=
             kSamplesPerTask) {
    partition.side *= 2;
  }
  // A small window takes longer sample ranges instead of larger tiles.
  const std::uint64_t area = std::min<std::uint64_t>(
      pixels.pixels(), std::uint64_t(partition.side) * partition.side);
  const std::uint64_t per_task = std::max<std::uint64_t>(kSamplesPerTask / area, 1);
  partition.samples = static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(per_task, 1, std::max<std::uint64_t>(spp, 1)));
  for (int y = pixels.y0; y < pixels.y1; y += partition.side) {
    for (int x = pixels.x0; x < pixels.x1; x += partition.side) {
      partition.tiles.push_back({x, y, std::min(x + partition.side, pixels.x1),
                                 std::min(y + partition.side, pixels.y1)});
    }
  }
  return partition;
}

void TilePixels(const PixelRect& tile, int image_width,
                std::vector<std::uint32_t>* pixels) {
  pixels->clear();
  for (int by = tile.y0; by < tile.y1; by += kBlock) {
    for (int bx = tile.x0; bx < tile.x1; bx += kBlock) {
      for (int y = by; y < std::min(by + kBlock, tile.y1); ++y) {
        for (int x = bx; x < std::min(bx + kBlock, tile.x1); ++x) {
          pixels->push_back(static_cast<std::uint32_t>(y) *
                                static_cast<std::uint32_t>(image_width) +
                            static_cast<std::uint32_t>(x));
        }
      }
    }
  }
}

}  // namespace lanelight
