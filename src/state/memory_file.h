// An HDF5 file in memory that hands over its bytes without a copy.
#pragma once

#include <cstddef>
#include <string_view>

#include "src/state/hdf5.h"

namespace lanelight {

class MemoryFile {
 public:
  MemoryFile() = default;
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// A new file behind `user_block` bytes of zeros (a power of two, 512 at least). It may
  /// be used until Finish.
  hdf5::Handle Create(std::size_t user_block);
  /// Closes the file; its bytes are complete then.
  void Finish(hdf5::Handle file, std::size_t user_block);

  char* data() { return data_; }
  std::string_view bytes() const { return {data_, size_}; }

 private:
  static void* Resize(void* memory, std::size_t size, H5FD_file_image_op_t operation,
                      void* self);
  char* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace lanelight
