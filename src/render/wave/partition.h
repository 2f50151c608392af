// The tiles of a run, by what of the image it renders and what it has of it already.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/render/films/accumulator.h"
#include "src/render/wave/run_options.h"
#include "src/render/wave/run_result.h"
#include "src/render/wave/tiles.h"

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// All windows, or tiles, that the options name, or else the image in tiles. Tasks have a
/// whole number of antithetic pairs.
TilePartition PartitionOf(const PreparedScene& scene, const RunOptions& options,
                          std::uint64_t planned_spp);

/// Where the pixels of a tile lie in the film: windows side by side, all else where it is
/// in the image.
PixelRect PlaceInFilm(const RunOptions& options, const std::vector<PixelRect>& tiles,
                      std::size_t tile);

/// Pixels of a tile have equally many samples. Those of a run that was cut into smaller
/// tiles need not: then the tile is divided until they have; all but one of its parts go
/// to the end.
void DivideUnevenTiles(const FilmAccumulator& film, std::vector<PixelRect>& tiles);

}  // namespace lanelight
