// Reads files, compressed ones as well. Only regular ones: a FIFO would block until it is
// written to, and a device may have no end.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "src/base/core/error.h"

namespace lanelight {

/// A file descriptor that is closed in the end.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() { Close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  int get() const { return fd_; }
  /// False with errno if the system reports a late failure of a write.
  bool Close() { return fd_ < 0 || close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

/// A file that cannot be read: "path: cannot read: reason".
class Unreadable : public InputError {
 public:
  Unreadable(const std::string& path, const std::string& reason);
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

struct InputFile {
  FileDescriptor fd;
  std::size_t size;
};

/// Returns the kind of a file that is not regular: "a FIFO (a pipe)", "a device", ...;
/// empty for a regular file, or none.
std::string SpecialFile(const std::string& path);

/// Opens a regular file; never waits. Throws Unreadable with the system's reason or the
/// kind of the file.
InputFile OpenInputFile(const std::string& path);

/// Returns the content; of a file that grows meanwhile, up to its size at the start.
/// Throws Unreadable.
std::string ReadWholeFile(const std::string& path);

/// True for content that begins like gzip data, and for files named .gz whatever they
/// hold.
bool IsGzip(std::string_view path, std::string_view content);

/// Returns the maximum number of bytes that a file of `packed` bytes may unpack to: 100
/// times its size, at least 256 MiB, at most 4 GiB. A small hostile file cannot fill the
/// memory.
std::size_t MaxUnpackedSize(std::size_t packed);

/// Returns what the gzip members in `packed` hold, one after the other. Throws InputError
/// without a place: no gzip data, truncated, a wrong checksum, more than `max_size`
/// bytes.
std::string Gunzip(std::string_view packed, std::size_t max_size);

}  // namespace lanelight
