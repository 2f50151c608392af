#include "src/wavefront/tile_columns.h"

#include <cstring>
#include <utility>

#include "src/core/check.h"

namespace lanelight {

TileColumns::TileColumns(std::vector<MutableStateColumn> columns, const PixelRect& window)
    : columns_(std::move(columns)), window_(window) {
  for (const MutableStateColumn& column : columns_) {
    LL_CHECK_EQ(column.rows, window.pixels());
  }
}

std::size_t TileColumns::BytesOf(const PixelRect& tile) const {
  std::size_t bytes = 0;
  for (const MutableStateColumn& column : columns_) bytes += column.RowBytes();
  return bytes * tile.pixels();
}

// Calls run(address, bytes) for each row of the tile in each column.
template <class Do>
void TileColumns::ForEachRun(const PixelRect& tile, Do&& run) const {
  LL_CHECK(tile.x0 >= window_.x0 && tile.x1 <= window_.x1);
  LL_CHECK(tile.y0 >= window_.y0 && tile.y1 <= window_.y1);
  for (const MutableStateColumn& column : columns_) {
    const std::size_t size = column.RowBytes();
    for (int y = tile.y0; y < tile.y1; ++y) {
      const auto row = static_cast<std::size_t>(y - window_.y0) *
                           static_cast<std::size_t>(window_.width()) +
                       static_cast<std::size_t>(tile.x0 - window_.x0);
      run(static_cast<char*>(column.data) + row * size,
          static_cast<std::size_t>(tile.width()) * size);
    }
  }
}

void TileColumns::Append(const PixelRect& tile, std::string& bytes) const {
  ForEachRun(tile, [&](char* at, std::size_t size) { bytes.append(at, size); });
}

void TileColumns::Put(const PixelRect& tile, std::string_view bytes) const {
  LL_CHECK_EQ(bytes.size(), BytesOf(tile));
  ForEachRun(tile, [&](char* at, std::size_t size) {
    std::memcpy(at, bytes.data(), size);
    bytes.remove_prefix(size);
  });
}

}  // namespace lanelight
