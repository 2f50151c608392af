// The pixels of a tile out of the columns of films, as bytes, and back into other films:
// how a tile with its samples goes from process to process.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/core/column.h"
#include "src/image/pixel_rect.h"

namespace lanelight {

class TileColumns {
 public:
  /// Of columns of the pixels of `window`, row by row; refers to their memory.
  TileColumns(std::vector<MutableStateColumn> columns, const PixelRect& window);

  std::size_t BytesOf(const PixelRect& tile) const;
  /// Appends what the columns hold of the pixels of `tile`, of the full image.
  void Append(const PixelRect& tile, std::string& bytes) const;
  /// Puts back what Append of columns of the same kind has written. `bytes`:
  /// BytesOf(tile).
  void Put(const PixelRect& tile, std::string_view bytes) const;

 private:
  template <class Do>
  void ForEachRun(const PixelRect& tile, Do&& run) const;

  std::vector<MutableStateColumn> columns_;
  PixelRect window_;
};

}  // namespace lanelight
