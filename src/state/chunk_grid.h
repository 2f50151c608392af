// How a column is cut into the chunks of its dataset, and the way of rows into chunks and
// back.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "src/core/column.h"
#include "src/state/tiles.h"

namespace lanelight {

/// Chunks hold some rows of a column. Rows of more than one dimension, {4, 3}, are cut as
/// well, into parts of the last one, {1, 3}: one quantity a chunk, so that zeros do not
/// stand among noise. Chunks follow each other by rows, then by parts.
class ChunkGrid {
 public:
  /// Chunks of about 256 KiB.
  static ChunkGrid Choose(StateType type, const std::vector<std::size_t>& shape,
                          std::size_t rows);
  /// The grid of a dataset with such chunks; none if it is no grid of this kind.
  static std::optional<ChunkGrid> Of(StateType type,
                                     const std::vector<std::size_t>& shape,
                                     std::size_t rows,
                                     const std::vector<std::size_t>& chunk);

  /// 0 without rows.
  std::size_t chunks() const { return blocks_ * parts_; }
  /// Dimensions of a chunk: rows, then those of the part of a row.
  const std::vector<std::size_t>& chunk() const { return chunk_; }
  std::size_t value_bytes() const { return value_bytes_; }
  std::size_t chunk_bytes() const { return chunk_[0] * part_bytes_; }
  /// Position of a chunk's first value in the dataset.
  std::vector<std::size_t> Offset(std::size_t index) const;

  /// Copies the rows of a chunk from a column to `values` (chunk_bytes()); what a last
  /// chunk has too much becomes zero. `tiles` says where the rows of a film lie; null:
  /// they are in order.
  void Gather(std::size_t index, const TileRows* tiles, const void* column,
              char* values) const;
  /// Copies them back.
  void Scatter(std::size_t index, const TileRows* tiles, const char* values,
               void* column) const;

 private:
  template <class Copy>
  void ForRuns(std::size_t index, const TileRows* tiles, const Copy& copy) const;

  std::vector<std::size_t> shape_, chunk_;
  std::size_t rows_ = 0, value_bytes_ = 0, row_bytes_ = 0, part_bytes_ = 0, blocks_ = 0,
              parts_ = 1;
};

}  // namespace lanelight
