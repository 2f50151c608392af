#include "src/render/wave/tiles.h"

#include <algorithm>
#include <bit>

#include "src/base/core/check.h"
#include "src/render/films/accumulator.h"
#include "src/render/wave/run_options.h"
#include "src/scene/compiled/view.h"
#include "src/scene/description/film.h"
#include "src/scene/prepare/prepared_scene.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kSamplesOfTask = 8192;
constexpr int kBlock = 4;
constexpr int kLargestTile = 64;
// Tiles of a part: with as many, parts of uneven scenes differ by a few percent.
constexpr std::size_t kTilesPerPart = 64;

// The bits of v, with a zero before each.
std::uint64_t SpreadBits(int v) {
  std::uint64_t bits = 0;
  for (int i = 0; i < 32; ++i) bits |= std::uint64_t(v >> i & 1) << (2 * i);
  return bits;
}

std::uint64_t AlongZ(const PixelRect& tile) {
  return SpreadBits(tile.x0) | SpreadBits(tile.y0) << 1;
}

TilePartition Partition(const PixelRect& pixels, std::uint64_t spp, int max_side) {
  TilePartition partition;
  partition.samples = std::uint32_t(std::clamp<std::uint64_t>(spp, 1, 32));
  partition.side = 16;
  while (partition.side < max_side &&
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

// Cut into smaller ones until there are enough, along the curve.
std::vector<PixelRect> CutTiles(const std::vector<PixelRect>& tiles, std::size_t wanted,
                                int min_side) {
  std::vector<PixelRect> all = tiles;
  for (int side = kLargestTile; side > min_side && all.size() < wanted;) {
    side /= 2;
    all.clear();
    for (const PixelRect& tile : tiles) {
      const std::vector<PixelRect> parts = TilesOf(tile, side);
      all.insert(all.end(), parts.begin(), parts.end());
    }
  }
  std::ranges::sort(
      all, [](const PixelRect& a, const PixelRect& b) { return AlongZ(a) < AlongZ(b); });
  return all;
}

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
  std::uint64_t maximum = 1;
  for (const PixelRect& tile : tiles) maximum = std::max(maximum, tile.pixels());
  partition.samples = SamplesPerTask(maximum, planned_spp);
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

TilePartition MakePartition(const PixelRect& pixels, std::uint64_t spp) {
  return Partition(pixels, spp, kLargestTile);
}

TilePartition MakePartition(const PixelRect& pixels, std::uint64_t spp,
                            const Strategy& strategy) {
  return Partition(pixels, spp, strategy.MayShare() ? kReuseTile : kLargestTile);
}

std::uint32_t SamplesPerTask(std::uint64_t pixels, std::uint64_t spp) {
  return std::uint32_t(std::clamp<std::uint64_t>(kSamplesOfTask / pixels, 1,
                                                 std::max<std::uint64_t>(spp, 1)));
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

std::vector<std::vector<PixelRect>> DistributeTiles(const std::vector<PixelRect>& tiles,
                                                    const std::vector<int>& threads,
                                                    int min_side) {
  // Each rank has as many turns as threads.
  std::vector<std::size_t> owners;
  const int maximum = *std::ranges::max_element(threads);
  for (int t = 0; t < maximum; ++t) {
    for (std::size_t r = 0; r < threads.size(); ++r) {
      if (t < threads[r]) owners.push_back(r);
    }
  }
  std::vector<std::vector<PixelRect>> parts(threads.size());
  const std::size_t wanted = parts.size() > 1 ? kTilesPerPart * parts.size() : 0;
  const std::vector<PixelRect> all = CutTiles(tiles, wanted, min_side);
  for (std::size_t i = 0; i < all.size(); ++i) {
    parts[owners[i % owners.size()]].push_back(all[i]);
  }
  return parts;
}

void TilePixels(const PixelRect& tile, int image_width,
                std::vector<std::uint32_t>* pixels) {
  pixels->clear();
  for (int by = tile.y0; by < tile.y1; by += kBlock) {
    for (int bx = tile.x0; bx < tile.x1; bx += kBlock) {
      for (int y = by; y < std::min(by + kBlock, tile.y1); ++y) {
        for (int x = bx; x < std::min(bx + kBlock, tile.x1); ++x) {
          pixels->push_back(std::uint32_t(y) * std::uint32_t(image_width) +
                            std::uint32_t(x));
        }
      }
    }
  }
}

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
  const int x = int(tile) * t.width();
  return {x, 0, x + t.width(), t.height()};
}

void DivideUnevenTiles(const FilmAccumulator& film, std::vector<PixelRect>& tiles) {
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    while (!IsEven(film, tiles[i])) {
      const int longer = std::max(tiles[i].width(), tiles[i].height());
      const auto side = std::bit_floor(static_cast<unsigned>(longer - 1));
      const std::vector<PixelRect> parts = TilesOf(tiles[i], int(side));
      tiles[i] = parts.front();
      tiles.insert(tiles.end(), parts.begin() + 1, parts.end());
    }
  }
}

}  // namespace lanelight
