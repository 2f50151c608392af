// Tiles as bytes, with all that the films have of their pixels: how they move between
// ranks.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/render/schedule/scheduler.h"
#include "src/render/wave/films.h"

namespace lanelight {

/// Appends these tiles and their pixels in all columns of the films. `tiles`: the places
/// of all tiles.
void PackTiles(std::span<const TileProgress> packed, const std::vector<PixelRect>& tiles,
               Films& films, std::string& out);
/// Divides tiles into pieces of some megabytes; at least one piece, which may be empty.
std::vector<std::span<const TileProgress>> InPieces(
    const std::vector<TileProgress>& owned, const std::vector<PixelRect>& tiles);
/// Copies the pixels into the films and returns the tiles. `bytes` must hold nothing
/// else.
std::vector<TileProgress> UnpackTiles(std::string_view bytes,
                                      const std::vector<PixelRect>& tiles, Films& films);

}  // namespace lanelight
