// Large files in memory.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace lanelight {

/// A whole file, to be read; unmapped with the last pointer. Its pages are those that the
/// system keeps of the file anyway, once for all processes that map it.
struct MappedFile {
  std::shared_ptr<const void> owner;
  const char* data = nullptr;
  std::size_t size = 0;
};

/// `fd` is open for reading and has `size` > 0 bytes. Throws InputError, which begins
/// with `path`, if it cannot be mapped. If the file is cut short while it is mapped, or
/// can no longer be read, touching it ends the process (SIGBUS): what is replaced by
/// renaming stays as it was.
MappedFile MapFile(int fd, const std::string& path, std::size_t size);

}  // namespace lanelight
