#include "src/state/memory_file.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace lanelight {

// HDF5 asks for a little more memory again and again, and clears it: little, so that it
// is still in the cache when it is written. Behind that the memory grows by halves, which
// costs nothing before it is used.
namespace {
constexpr std::size_t kIncrement = 1 << 20;
}

MemoryFile::~MemoryFile() { std::free(data_); }

void* MemoryFile::Resize(void* /*memory*/, std::size_t size, H5FD_file_image_op_t,
                         void* self) {
  MemoryFile& file = *static_cast<MemoryFile*>(self);
  if (size > file.capacity_) {
    const std::size_t capacity = std::max(size, file.capacity_ + file.capacity_ / 2);
    void* data = std::realloc(file.data_, capacity);
    if (data == nullptr) return nullptr;
    file.data_ = static_cast<char*>(data);
    file.capacity_ = capacity;
  }
  return file.data_;
}

hdf5::Handle MemoryFile::Create(std::size_t user_block) {
  const hdf5::Handle access = hdf5::NewProperties(H5P_FILE_ACCESS);
  hdf5::Check(H5Pset_fapl_core(access.get(), kIncrement, false), "a file in memory");
  // The memory is ours: HDF5 does not free it when the file is closed.
  H5FD_file_image_callbacks_t callbacks = {
      [](std::size_t, H5FD_file_image_op_t, void*) -> void* { return nullptr; },
      [](void*, const void*, std::size_t, H5FD_file_image_op_t, void*) -> void* {
        return nullptr;
      },
      &MemoryFile::Resize,
      [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; },
      [](void* self) { return self; },
      [](void*) -> herr_t { return 0; },
      this};
  hdf5::Check(H5Pset_file_image_callbacks(access.get(), &callbacks), "its memory");
  const hdf5::Handle creation = hdf5::NewProperties(H5P_FILE_CREATE);
  hdf5::Check(H5Pset_userblock(creation.get(), user_block), "the user block");
  return hdf5::Handle(H5Fcreate("state", H5F_ACC_TRUNC, creation.get(), access.get()),
                      H5Fclose, "a file in memory");
}

void MemoryFile::Finish(hdf5::Handle file, std::size_t user_block) {
  hdf5::Check(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "flush");
  // Of HDF5's part of the file; the memory is longer.
  const ssize_t size =
      hdf5::Check(H5Fget_file_image(file.get(), nullptr, 0), "the size of the file");
  file.Close("close");
  size_ = user_block + static_cast<std::size_t>(size);
  std::memset(data_, 0, user_block);
}

}  // namespace lanelight
