#include "src/state/chunk_grid.h"

#include <algorithm>
#include <cstring>

namespace lanelight {
namespace {

constexpr std::size_t kChunkBytes = 256 << 10;  // stays in the second cache, also thrice
constexpr std::size_t kLeastPart = 64 << 10;    // below, rows are left whole

std::size_t CeilDiv(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

std::size_t Product(const std::vector<std::size_t>& shape) {
  std::size_t n = 1;
  for (std::size_t s : shape) n *= s;
  return n;
}

// Parts of one dimension.
std::vector<std::size_t> PartOf(std::vector<std::size_t> shape) {
  for (std::size_t i = 0; i + 1 < shape.size(); ++i) shape[i] = 1;
  return shape;
}

// Pieces of memory at regular distances.
struct Pieces {
  char* to;
  std::size_t to_stride;
  const char* from;
  std::size_t from_stride, count;
};

template <std::size_t kBytes>
void CopyPieces(const Pieces& p) {
  for (std::size_t i = 0; i < p.count; ++i) {
    std::memcpy(p.to + i * p.to_stride, p.from + i * p.from_stride, kBytes);
  }
}

void CopyPieces(const Pieces& p, std::size_t bytes) {
  if (p.to_stride == bytes && p.from_stride == bytes) {
    std::memcpy(p.to, p.from, p.count * bytes);
    return;
  }
  switch (bytes) {  // of three colours, mostly
    case 4:
      return CopyPieces<4>(p);
    case 8:
      return CopyPieces<8>(p);
    case 12:
      return CopyPieces<12>(p);
    case 24:
      return CopyPieces<24>(p);
    default:
      break;
  }
  for (std::size_t i = 0; i < p.count; ++i) {
    std::memcpy(p.to + i * p.to_stride, p.from + i * p.from_stride, bytes);
  }
}

}  // namespace

ChunkGrid ChunkGrid::Choose(StateType type, const std::vector<std::size_t>& shape,
                            std::size_t rows) {
  std::vector<std::size_t> part = PartOf(shape);
  if (rows * Product(part) * SizeOf(type) < kLeastPart) part = shape;
  const std::size_t blocks =
      CeilDiv(std::max<std::size_t>(1, rows) * Product(part) * SizeOf(type), kChunkBytes);
  std::vector<std::size_t> chunk = {std::max<std::size_t>(
      1, CeilDiv(rows, std::min(blocks, std::max<std::size_t>(1, rows))))};
  chunk.insert(chunk.end(), part.begin(), part.end());
  return *Of(type, shape, rows, chunk);
}

std::optional<ChunkGrid> ChunkGrid::Of(StateType type,
                                       const std::vector<std::size_t>& shape,
                                       std::size_t rows,
                                       const std::vector<std::size_t>& chunk) {
  if (chunk.size() != shape.size() + 1 || chunk[0] == 0) return std::nullopt;
  const std::vector<std::size_t> part(chunk.begin() + 1, chunk.end());
  if (part != shape && part != PartOf(shape)) return std::nullopt;
  ChunkGrid grid;
  grid.shape_ = shape;
  grid.chunk_ = chunk;
  grid.rows_ = rows;
  grid.value_bytes_ = SizeOf(type);
  grid.row_bytes_ = Product(shape) * SizeOf(type);
  grid.part_bytes_ = Product(part) * SizeOf(type);
  grid.parts_ = grid.row_bytes_ / grid.part_bytes_;
  grid.blocks_ = CeilDiv(rows, chunk[0]);
  return grid;
}

std::vector<std::size_t> ChunkGrid::Offset(std::size_t index) const {
  std::vector<std::size_t> offset(chunk_.size(), 0);
  offset[0] = index / parts_ * chunk_[0];
  std::size_t part = index % parts_;
  if (parts_ == 1) return offset;
  for (std::size_t i = shape_.size() - 1; i-- > 0;) {
    offset[i + 1] = part % shape_[i];
    part /= shape_[i];
  }
  return offset;
}

// Calls copy(row in the column, row in the chunk, rows) for rows that follow each other.
template <class Copy>
void ChunkGrid::ForRuns(std::size_t index, const TileRows* tiles,
                        const Copy& copy) const {
  const std::size_t begin = index / parts_ * chunk_[0],
                    end = std::min(rows_, begin + chunk_[0]);
  for (std::size_t row = begin; row < end;) {
    const TileRows::Run run =
        tiles != nullptr ? tiles->At(row, end - row) : TileRows::Run{row, row, end - row};
    copy(run.film, row - begin, run.count);
    row += run.count;
  }
}

void ChunkGrid::Gather(std::size_t index, const TileRows* tiles, const void* column,
                       char* values) const {
  const char* part = static_cast<const char*>(column) + index % parts_ * part_bytes_;
  std::size_t filled = 0;
  ForRuns(index, tiles, [&](std::size_t from, std::size_t to, std::size_t count) {
    CopyPieces({values + to * part_bytes_, part_bytes_, part + from * row_bytes_,
                row_bytes_, count},
               part_bytes_);
    filled += count * part_bytes_;
  });
  std::memset(values + filled, 0, chunk_bytes() - filled);
}

void ChunkGrid::Scatter(std::size_t index, const TileRows* tiles, const char* values,
                        void* column) const {
  char* part = static_cast<char*>(column) + index % parts_ * part_bytes_;
  ForRuns(index, tiles, [&](std::size_t to, std::size_t from, std::size_t count) {
    CopyPieces({part + to * row_bytes_, row_bytes_, values + from * part_bytes_,
                part_bytes_, count},
               part_bytes_);
  });
}

}  // namespace lanelight
