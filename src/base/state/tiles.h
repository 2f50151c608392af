// Positions of the pixels of a state's tiles in the memory of a film.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/base/image/pixel_rect.h"

namespace lanelight {

/// "[x0, x1) x [y0, y1)".
std::string ToString(const PixelRect& rect);

/// Returns the problem of the tiles of a film with the pixels `window`, or "": each tile
/// has pixels, all in the window, none in another tile.
std::string TileProblem(const std::vector<PixelRect>& tiles, const PixelRect& window);

/// The pixels of tiles in the order of the file, tile after tile and row by row, and the
/// rows of a film's columns that they are.
class TileRows {
 public:
  /// Consecutive pixels of both.
  struct Run {
    std::size_t file, film, count;
  };

  /// `tiles` without a TileProblem.
  TileRows(const std::vector<PixelRect>& tiles, const PixelRect& window);

  std::size_t size() const { return first_.back(); }
  /// The run that begins at the pixel `file` < size(), at most `count` long.
  Run At(std::size_t file, std::size_t count) const;

 private:
  std::vector<PixelRect> tiles_;
  std::vector<std::size_t> first_;  // per tile, and the end
  PixelRect window_;
};

}  // namespace lanelight
