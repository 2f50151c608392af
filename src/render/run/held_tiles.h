// Tiles on their way from one rank to another, with all that films have of their pixels.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/render/wave/films.h"

namespace lanelight {

/// A tile that a rank has, as all ranks number them.
struct HeldTile {
  std::uint64_t tile = 0;
  std::uint64_t done = 0;  // samples of each of its pixels
};

/// Appends, as bytes, which tiles these are, and their pixels in all columns of the
/// films. `tiles`: the places of all.
void PackTiles(std::span<const HeldTile> held, const std::vector<PixelRect>& tiles,
               Films& films, std::string& out);
/// Cut to be sent in pieces of some megabytes, at least one, that may be empty.
std::vector<std::span<const HeldTile>> InPieces(const std::vector<HeldTile>& held,
                                                const std::vector<PixelRect>& tiles);
/// Back, into the films; `bytes` hold nothing else.
std::vector<HeldTile> UnpackTiles(std::string_view bytes,
                                  const std::vector<PixelRect>& tiles, Films& films);

}  // namespace lanelight
