#include "src/core/mapped_file.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "src/core/error.h"

namespace lanelight {

MappedFile MapFile(int fd, const std::string& path, std::size_t size) {
  void* const data = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
  if (data == MAP_FAILED) {
    throw InputError(fmt::format("{}: cannot map: {}", path, std::strerror(errno)));
  }
  madvise(data, size, MADV_WILLNEED);  // all of it is read at once; fails where unknown
  const auto unmap = [size](const void* p) { munmap(const_cast<void*>(p), size); };
  std::shared_ptr<const void> owner(static_cast<const void*>(data), unmap);
  return {std::move(owner), static_cast<const char*>(data), size};
}

}  // namespace lanelight
