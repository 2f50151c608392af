// Which pixels make a block of reuse=block.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "src/render/wave/block_reuse.h"
#include "src/render/wave/tiles.h"

namespace lanelight {
namespace {

BlockOrder OrderOf(const BlockKey& key, BlockLayout layout, std::uint32_t paths) {
  BlockOrder order;
  LayOutBlocks(key, layout, paths, order);
  return order;
}

constexpr BlockLayout kLayouts[] = {BlockLayout::kRandom, BlockLayout::kCompact};

struct Point {
  int x, y;
};

// Of the members of the first block, in the tile.
std::vector<Point> FirstBlock(const PixelRect& tile, BlockLayout layout) {
  std::vector<std::uint32_t> pixels;
  TilePixels(tile, 1000, &pixels);
  const BlockOrder order = OrderOf({tile, 1, 5}, layout, 16);
  std::vector<Point> points;
  for (std::uint32_t i = 0; i < order.ends[0]; ++i) {
    const auto pixel = static_cast<int>(pixels[order.places[i]]);
    points.push_back({pixel % 1000 - tile.x0, pixel / 1000 - tile.y0});
  }
  return points;
}

}  // namespace

TEST_CASE("every pixel of a tile is in exactly one block of limited size", "[reuse]") {
  for (const BlockLayout layout : kLayouts) {
    for (const PixelRect tile : {PixelRect{16, 32, 32, 48}, PixelRect{0, 0, 1, 1},
                                 PixelRect{0, 0, 16, 3}, PixelRect{3, 5, 14, 14}}) {
      for (const std::uint32_t paths : {2u, 8u, 16u, 32u, 64u}) {
        const BlockOrder order = OrderOf({tile, 1, 7}, layout, paths);
        std::vector<std::uint32_t> places = order.places;
        std::sort(places.begin(), places.end());
        REQUIRE(places.size() == tile.pixels());
        for (std::uint32_t i = 0; i < places.size(); ++i) CHECK(places[i] == i);
        std::uint32_t begin = 0;
        for (const std::uint32_t end : order.ends) {
          CHECK((end > begin && end - begin <= paths));
          begin = end;
        }
        CHECK(begin == places.size());
        REQUIRE(order.numbers.size() == order.ends.size());
        for (const float u : order.numbers) CHECK((u >= 0 && u < 1));
      }
    }
  }
}

TEST_CASE("blocks differ between samples, seeds and tiles", "[reuse]") {
  const PixelRect tile = {16, 32, 32, 48}, other = {32, 32, 48, 48};
  for (const BlockLayout layout : kLayouts) {
    const BlockOrder order = OrderOf({tile, 1, 7}, layout, 16);
    CHECK(OrderOf({tile, 1, 7}, layout, 16).places == order.places);
    // One of 256 grids may be the same by chance; not all of these.
    int same = 0;
    for (const BlockKey& key : {BlockKey{tile, 1, 8}, BlockKey{tile, 1, 9},
                                BlockKey{tile, 2, 7}, BlockKey{other, 1, 7}}) {
      same += OrderOf(key, layout, 16).places == order.places;
    }
    CHECK(same <= 1);
  }
}

TEST_CASE("compact blocks consist of neighbours", "[reuse]") {
  const PixelRect tile = {16, 32, 32, 48};
  const std::vector<Point> compact = FirstBlock(tile, BlockLayout::kCompact);
  REQUIRE(compact.size() == 16);
  std::set<int> columns, rows;
  for (const Point& p : compact) columns.insert(p.x), rows.insert(p.y);
  CHECK((columns.size() == 4 && rows.size() == 4));
}

TEST_CASE("any two pixels of a tile share a random block equally often", "[reuse]") {
  const PixelRect tile = {0, 0, 8, 8};
  constexpr std::uint32_t kPaths = 16, kSamples = 4096;
  std::vector<int> met(64 * 64, 0);
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    const BlockOrder order = OrderOf({tile, 3, s}, BlockLayout::kRandom, kPaths);
    for (std::uint32_t i = 0; i < 64; ++i) {
      for (std::uint32_t j = i / kPaths * kPaths; j < (i / kPaths + 1) * kPaths; ++j) {
        ++met[order.places[i] * 64 + order.places[j]];
      }
    }
  }
  const double p = 15.0 / 63, mean = kSamples * p;
  const double six_sigma = 6 * std::sqrt(kSamples * p * (1 - p));
  for (std::size_t i = 0; i < 64; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      CHECK(std::abs(met[i * 64 + j] - mean) < six_sigma);
  }
}

}  // namespace lanelight
