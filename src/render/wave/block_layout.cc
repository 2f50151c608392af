#include "src/render/wave/block_reuse.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace lanelight {
namespace {

// A hash of PCG's output function (O'Neill 2014), chained.
struct Random {
  std::uint64_t state;

  std::uint32_t Next() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    const auto shifted = std::uint32_t(((state >> 18) ^ state) >> 27);
    return std::rotr(shifted, int(state >> 59));
  }
  /// In [0, n).
  std::uint32_t Below(std::uint32_t n) {
    return std::uint32_t((std::uint64_t{Next()} * n) >> 32);
  }
};

Random RandomOf(const BlockKey& key) {
  const auto tile = std::uint64_t(key.tile.y0) << 32 | std::uint32_t(key.tile.x0);
  Random random{tile * 0x9e3779b97f4a7c15ull ^
                (std::uint64_t{key.seed} << 32 | key.sample)};
  random.Next();
  random.Next();
  return random;
}

void EndEvery(std::uint32_t paths, BlockOrder& order) {
  const auto pixels = std::uint32_t(order.places.size());
  for (std::uint32_t end = paths; end < pixels; end += paths) order.ends.push_back(end);
  order.ends.push_back(pixels);
}

void Shuffle(Random& random, std::vector<std::uint32_t>& places) {
  for (auto i = std::uint32_t(places.size()); i > 1; --i) {
    std::swap(places[i - 1], places[random.Below(i)]);
  }
}

// Returns the place of a pixel in TilePixels (4x4 blocks, cut off at the right and lower
// edge).
std::uint32_t PlaceOf(int x, int y, int width, int height) {
  constexpr int kSide = 4;
  const int bx = x / kSide * kSide, by = y / kSide * kSide;
  const int rows = std::min(kSide, height - by), columns = std::min(kSide, width - bx);
  return std::uint32_t(by * width + bx * rows + (y - by) * columns + x - bx);
}

// Rectangles of 2^n pixels, nearly square, on a grid that is shifted by chance and wraps
// around in the tile.
void Rectangles(Random& random, const PixelRect& tile, BlockOrder& order,
                std::uint32_t paths) {
  const int log = std::countr_zero(paths);
  const int block_width = 1 << ((log + 1) / 2), block_height = 1 << (log / 2);
  const int width = tile.width(), height = tile.height();
  const auto shift_x = int(random.Below(std::uint32_t(width)));
  const auto shift_y = int(random.Below(std::uint32_t(height)));
  order.keys.clear();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int u = (x + shift_x) % width, v = (y + shift_y) % height;
      const auto block = std::uint64_t(v / block_height * width + u / block_width);
      order.keys.push_back(block << 32 | PlaceOf(x, y, width, height));
    }
  }
  std::ranges::sort(order.keys);
  order.places.clear();
  for (std::size_t i = 0; i < order.keys.size(); ++i) {
    if (i > 0 && order.keys[i] >> 32 != order.keys[i - 1] >> 32) {
      order.ends.push_back(std::uint32_t(i));
    }
    order.places.push_back(std::uint32_t(order.keys[i]));
  }
  order.ends.push_back(std::uint32_t(order.keys.size()));
}

}  // namespace

void LayOutBlocks(const BlockKey& key, BlockLayout layout, std::uint32_t paths,
                  BlockOrder& order) {
  Random random = RandomOf(key);
  order.ends.clear();
  if (layout == BlockLayout::kRandom) {
    order.places.resize(std::size_t(key.tile.pixels()));
    std::iota(order.places.begin(), order.places.end(), 0u);
    Shuffle(random, order.places);
    EndEvery(paths, order);
  } else {
    Rectangles(random, key.tile, order, paths);
  }
  order.numbers.resize(order.ends.size());
  for (float& u : order.numbers) u = float(random.Next() >> 8) * 0x1p-24f;
}

}  // namespace lanelight
