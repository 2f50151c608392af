#include "src/wavefront/tiles.h"

#include <algorithm>

namespace lanelight {

namespace {
constexpr std::uint64_t kSamplesOfTask = 8192;
constexpr int kBlock = 4;
}  // namespace

namespace {

TilePartition Partition(const PixelRect& pixels, std::uint64_t spp, int most_side) {
  TilePartition partition;
  partition.samples = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(spp, 1, 32));
  partition.side = 16;
  while (partition.side < most_side &&
         std::uint64_t(partition.side) * partition.side * 4 * partition.samples <=
             kSamplesOfTask) {
    partition.side *= 2;
  }
  partition.tiles = TilesOf(pixels, partition.side);
  // A small window takes longer sample ranges instead of larger tiles.
  partition.samples =
      SamplesPerTask(std::min<std::uint64_t>(
                         pixels.pixels(), std::uint64_t(partition.side) * partition.side),
                     spp);
  return partition;
}

}  // namespace

TilePartition MakePartition(const PixelRect& pixels, std::uint64_t spp) {
  return Partition(pixels, spp, 64);
}

TilePartition MakePartition(const PixelRect& pixels, std::uint64_t spp,
                            const Strategy& strategy) {
  return Partition(pixels, spp, strategy.MayReuse() ? kReuseTile : 64);
}

std::uint32_t SamplesPerTask(std::uint64_t pixels, std::uint64_t spp) {
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(
      kSamplesOfTask / pixels, 1, std::max<std::uint64_t>(spp, 1)));
}

std::vector<PixelRect> TilesOf(const PixelRect& window, int side) {
  std::vector<PixelRect> tiles;
  for (int y = window.y0 / side * side; y < window.y1; y += side) {
    for (int x = window.x0 / side * side; x < window.x1; x += side) {
      tiles.push_back({std::max(x, window.x0), std::max(y, window.y0),
                       std::min(x + side, window.x1), std::min(y + side, window.y1)});
    }
  }
  return tiles;
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
