// Every pixel belongs to exactly one tile, in every shape of window.
#include "src/wavefront/tiles.h"

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

TEST_CASE("tiles hold whole blocks from the image's origin on", "[tiles]") {
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

}  // namespace lanelight
