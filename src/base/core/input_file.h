// The one way to a file that is read: regular ones only. A FIFO would wait for somebody
// to write, and a device may have no end.
#pragma once

#include <cstddef>
#include <string>

#include "src/base/core/error.h"
#include "src/base/core/file_descriptor.h"

namespace lanelight {

/// What cannot be read: "path: cannot read: reason".
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

/// What stands there that is no regular file: "a FIFO (a pipe)", "a device", ...; empty
/// for a regular file, and where nothing is.
std::string SpecialFile(const std::string& path);

/// Opens a regular file; never waits. Throws Unreadable with the system's reason, or with
/// what it is instead.
InputFile OpenInputFile(const std::string& path);

/// What is in it. One that grows meanwhile is read as far as it went. Throws Unreadable.
std::string ReadWholeFile(const std::string& path);

}  // namespace lanelight
