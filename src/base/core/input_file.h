// Opens files for reading; regular files only. A FIFO would wait for a writer, and a
// device may have no end.
#pragma once

#include <cstddef>
#include <string>

#include "src/base/core/error.h"
#include "src/base/core/file_descriptor.h"

namespace lanelight {

/// Reports a file that cannot be read: "path: cannot read: reason".
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

/// Describes a path that is no regular file: "a FIFO (a pipe)", "a device", ...; empty
/// for a regular file or a missing one.
std::string SpecialFile(const std::string& path);

/// Opens a regular file; never waits. Throws Unreadable with the system's reason, or with
/// what it is instead.
InputFile OpenInputFile(const std::string& path);

/// Returns the content of a file. A file that grows meanwhile is read up to the end
/// found. Throws Unreadable.
std::string ReadWholeFile(const std::string& path);

}  // namespace lanelight
