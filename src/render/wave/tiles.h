// Splits a render into tasks (tile x sample range), independently of the number of
// threads, so that the sums of a pixel always run in the same order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

class FilmAccumulator;  // src/render/films/accumulator.h
struct PreparedScene;   // src/scene/prepare/prepared_scene.h
struct RunOptions;      // src/render/wave/run_options.h

struct TilePartition {
  int side = 16;               // pixels
  std::uint32_t samples = 32;  // per task
  std::vector<PixelRect> tiles;
};

/// Tasks of about 8192 samples: enough to amortise the drain of a wavefront at the end,
/// few enough that the sample buffer stays in the cache and threads stay busy. Tiles are
/// at least 16 pixels wide, and larger where there are few samples.
TilePartition MakePartition(const PixelRect& pixels, std::uint64_t spp);
/// Tiles for a strategy: with path reuse their size is the same for any number of
/// samples, since the paths of a tile are connected.
TilePartition MakePartition(const PixelRect& pixels, std::uint64_t spp,
                            const Strategy& strategy);

/// Returns the samples per pixel of a task whose tile has so many pixels.
std::uint32_t SamplesPerTask(std::uint64_t pixels, std::uint64_t spp);

/// Cuts the window into tiles whose sides are `side`, aligned to the image's origin.
std::vector<PixelRect> TilesOf(const PixelRect& window, int side);

/// Pixels of all tiles together.
inline std::uint64_t PixelsOf(const std::vector<PixelRect>& tiles) {
  std::uint64_t pixels = 0;
  for (const PixelRect& tile : tiles) pixels += tile.pixels();
  return pixels;
}

/// Deals tiles to ranks in proportion to their threads, in turn along a Z-order curve,
/// whose neighbours cost about the same. Where there are few tiles they are halved, down
/// to `min_side`. Parts may be empty.
std::vector<std::vector<PixelRect>> DistributeTiles(const std::vector<PixelRect>& tiles,
                                                    const std::vector<int>& threads,
                                                    int min_side);

/// Lists the pixel indices (y * image_width + x) of a tile in 4x4 blocks, so that a
/// vector of lanes starts with neighbouring rays.
void TilePixels(const PixelRect& tile, int image_width,
                std::vector<std::uint32_t>* pixels);

/// Samples [first, end()) of every pixel of one tile.
struct SampleRange {
  std::size_t tile = 0;     // index into the tiles of the run
  std::uint64_t first = 0;  // sample of a pixel, counted over the whole render
  std::uint32_t count = 0;  // samples per pixel

  std::uint64_t end() const { return first + count; }
};

/// Returns the windows or tiles that the options name, or else the image in tiles. Tasks
/// have a whole number of antithetic pairs.
TilePartition PartitionOf(const PreparedScene& scene, const RunOptions& options,
                          std::uint64_t planned_spp);

/// Returns where the pixels of a tile lie in the film: windows side by side, tiles at
/// their place in the image.
PixelRect PlaceInFilm(const RunOptions& options, const std::vector<PixelRect>& tiles,
                      std::size_t tile);

/// Divides tiles whose pixels have different numbers of samples (a run that was cut into
/// smaller tiles) until they have equally many; new tiles go to the end.
void DivideUnevenTiles(const FilmAccumulator& film, std::vector<PixelRect>& tiles);

}  // namespace lanelight
