// Every pixel belongs to exactly one tile, in every shape of window.
#include "src/render/wave/tiles.h"

#include <algorithm>
#include <catch2/catch.hpp>

namespace lanelight {

TEST_CASE("tiles cover the window once", "[tiles]") {
  for (const PixelRect window : {PixelRect{0, 0, 256, 144}, PixelRect{3, 5, 4, 6},
                                 PixelRect{10, 20, 75, 101}, PixelRect{0, 0, 17, 1}}) {
    for (std::uint64_t spp : {1, 2, 16, 100, 200000}) {
      const TilePartition partition = MakePartition(window, spp);
      std::vector<std::uint32_t> all, pixels;
      for (const PixelRect& tile : partition.tiles) {
        TilePixels(tile, 1000, &pixels);
        all.insert(all.end(), pixels.begin(), pixels.end());
        // The sample buffer of a task is bounded whatever the number of samples.
        CHECK(pixels.size() * partition.samples <= 16384);
      }
      CHECK(partition.samples >= 1);
      CHECK(partition.samples <= spp);
      std::sort(all.begin(), all.end());
      REQUIRE(all.size() == std::size_t(window.width()) * window.height());
      CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
      CHECK(all.front() == std::uint32_t(window.y0) * 1000 + std::uint32_t(window.x0));
    }
  }
}

TEST_CASE("tiles contain whole blocks counted from the image's origin", "[tiles]") {
  for (const PixelRect window : {PixelRect{0, 0, 256, 144}, PixelRect{3, 5, 4, 6},
                                 PixelRect{10, 20, 75, 101}, PixelRect{33, 70, 97, 99}}) {
    for (std::uint64_t spp : {1, 4, 32, 100}) {
      const TilePartition partition = MakePartition(window, spp);
      CHECK(partition.side % 16 == 0);
      for (const PixelRect& t : partition.tiles) {
        CHECK((t.x0 % partition.side == 0 || t.x0 == window.x0));
        CHECK((t.y0 % partition.side == 0 || t.y0 == window.y0));
        CHECK((t.x1 % partition.side == 0 || t.x1 == window.x1));
        CHECK((t.y1 % partition.side == 0 || t.y1 == window.y1));
      }
    }
  }
}

TEST_CASE("parts cover all tiles once, in proportion to threads", "[tiles]") {
  const std::vector<PixelRect> tiles = TilesOf({3, 5, 203, 105}, 16);
  for (const std::vector<int>& threads : {std::vector<int>{4},
                                          {1, 1},
                                          {2, 2, 2},
                                          {1, 3},
                                          {8, 0, 8},
                                          std::vector<int>(40, 2)}) {
    for (const int minimum : {1, 16}) {
      const auto parts = DistributeTiles(tiles, threads, minimum);
      REQUIRE(parts.size() == threads.size());
      std::vector<std::uint32_t> all, pixels;
      int seats = 0;
      for (const int t : threads) seats += t;
      for (std::size_t r = 0; r < parts.size(); ++r) {
        std::uint64_t of_part = 0;
        for (const PixelRect& tile : parts[r]) {
          TilePixels(tile, 1000, &pixels);
          all.insert(all.end(), pixels.begin(), pixels.end());
          of_part += pixels.size();
        }
        // Whole tiles, some of which the window cuts off.
        if (minimum == 1)
          CHECK(of_part == Approx(20000.0 * threads[r] / seats).margin(900));
        if (minimum == 16) CHECK(parts[r].size() >= tiles.size() * threads[r] / seats);
      }
      std::sort(all.begin(), all.end());
      CHECK(all.size() == 20000);
      CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
    }
  }
}

TEST_CASE("parts alternate between neighbouring tiles and have enough tiles", "[tiles]") {
  const std::vector<PixelRect> tiles = TilesOf({0, 0, 64, 64}, 16);
  const auto parts = DistributeTiles(tiles, {1, 1, 1, 1}, 1);
  for (const auto& part : parts) CHECK(part.size() == 64);
  // Tiles of 4 x 4 pixels: of each block of 8 x 8 every part has one.
  CHECK(parts[0][5].x0 / 8 == parts[3][5].x0 / 8);
  CHECK(parts[0][5].y0 / 8 == parts[3][5].y0 / 8);
  // The tiles of reuse=block stay whole, whoever has none then.
  const auto whole = DistributeTiles(tiles, std::vector<int>(20, 1), 16);
  CHECK(whole[15].size() == 1);
  CHECK(whole[16].empty());
}

}  // namespace lanelight
