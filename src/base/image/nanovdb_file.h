// NanoVDB files (.nvdb) as a row of segments: which grids they hold, and one of them,
// unpacked. What a grid itself says is not looked at: nanovdb_check.h.
#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "src/base/core/aligned.h"

namespace lanelight {

/// Memory as NanoVDB needs it, of exactly so many bytes, none of which has a value yet.
class GridBytes {
 public:
  GridBytes() = default;
  explicit GridBytes(std::size_t size)
      : data_(static_cast<std::uint8_t*>(::operator new(size, kAlignment)),
              [](std::uint8_t* data) { ::operator delete(data, kAlignment); }),
        size_(size) {}
  std::uint8_t* data() { return data_.get(); }
  const std::uint8_t* data() const { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  static constexpr std::align_val_t kAlignment{kCacheLine};
  std::shared_ptr<std::uint8_t> data_;
  std::size_t size_ = 0;
};

/// A grid as it lies in memory.
struct StoredGrid {
  GridBytes bytes;
  std::uint64_t place = 0;  // byte of the file where it begins, packed or not
};

/// The first grid of that name, whole or compressed by zip or blosc; nothing if the file
/// has none. A file that ends too early, or that claims more than it can hold:
/// InputError, which says at which byte, but not of which file.
std::optional<StoredGrid> ReadStoredGrid(std::istream& file, const std::string& name);

}  // namespace lanelight
