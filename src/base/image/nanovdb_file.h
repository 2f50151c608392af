// Reads one grid of a NanoVDB file (.nvdb), unpacked. Its content is checked later
// (nanovdb_check.h).
#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "src/base/core/aligned.h"

namespace lanelight {

/// Aligned memory for NanoVDB, not initialised.
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

/// Returns the first grid of that name, uncompressed or compressed by zip or blosc; empty
/// if the file has none. InputError, with the byte but not the file, for a file that ends
/// too early or claims more than it can hold.
std::optional<StoredGrid> ReadStoredGrid(std::istream& file, const std::string& name);

}  // namespace lanelight
