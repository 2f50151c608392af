#include "src/render/wave/partition.h"

#include <algorithm>
#include <bit>

#include "src/base/core/check.h"
#include "src/scene/compiled/view.h"
#include "src/scene/description/film.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

TilePartition PartitionOfWindows(const std::vector<PixelRect>& windows,
                                 std::uint64_t planned_spp) {
  const PixelRect& first = windows.front();
  // Small enough for one tile each, wherever they are.
  TilePartition partition =
      MakePartition({0, 0, first.width(), first.height()}, planned_spp);
  LL_CHECK_EQ(partition.tiles.size(), 1u);
  partition.tiles = windows;
  for (const PixelRect& w : windows) {
    LL_CHECK(w.width() == first.width() && w.height() == first.height());
  }
  return partition;
}

TilePartition PartitionOfTiles(const std::vector<PixelRect>& tiles,
                               std::uint64_t planned_spp) {
  TilePartition partition;
  partition.tiles = tiles;
  std::uint64_t most = 1;
  for (const PixelRect& tile : tiles) most = std::max(most, tile.pixels());
  partition.samples = SamplesPerTask(most, planned_spp);
  return partition;
}

TilePartition AnyPartition(const PreparedScene& scene, const RunOptions& options,
                           std::uint64_t planned_spp) {
  if (!options.windows.empty()) return PartitionOfWindows(options.windows, planned_spp);
  if (!options.tiles.empty()) return PartitionOfTiles(options.tiles, planned_spp);
  return MakePartition(RenderedPixels(scene.view->film), planned_spp, scene.strategy);
}

bool IsEven(const FilmAccumulator& film, const PixelRect& tile) {
  const std::uint64_t samples = film.Samples(tile.x0, tile.y0);
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      if (film.Samples(x, y) != samples) return false;
    }
  }
  return true;
}

}  // namespace

TilePartition PartitionOf(const PreparedScene& scene, const RunOptions& options,
                          std::uint64_t planned_spp) {
  TilePartition partition = AnyPartition(scene, options, planned_spp);
  // A pair must not straddle two tasks.
  if (scene.strategy.pairs == Pairs::kAntithetic) {
    partition.samples += partition.samples & 1;
  }
  return partition;
}

PixelRect PlaceInFilm(const RunOptions& options, const std::vector<PixelRect>& tiles,
                      std::size_t tile) {
  const PixelRect& t = tiles[tile];
  if (options.windows.empty()) return t;
  const int x = static_cast<int>(tile) * t.width();
  return {x, 0, x + t.width(), t.height()};
}

void DivideUnevenTiles(const FilmAccumulator& film, std::vector<PixelRect>& tiles) {
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    while (!IsEven(film, tiles[i])) {
      const int longer = std::max(tiles[i].width(), tiles[i].height());
      const auto side = std::bit_floor(static_cast<unsigned>(longer - 1));
      const std::vector<PixelRect> parts = TilesOf(tiles[i], static_cast<int>(side));
      tiles[i] = parts.front();
      tiles.insert(tiles.end(), parts.begin() + 1, parts.end());
    }
  }
}

}  // namespace lanelight
