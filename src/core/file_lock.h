// Locks on ranges of a file's bytes, by which processes keep out of each other's way. The
// kernel frees them when their process ends, however it ends; a clock or a process number
// plays no part.
#pragma once

#include <cstdint>
#include <string>

#include "src/core/file_descriptor.h"

namespace lanelight {

enum class LockOutcome {
  kTaken,
  kBusy,     // somebody else has some of the bytes
  kUnknown,  // the file system knows no locks
};

/// A file that is there to be locked. Two objects exclude each other even in one process.
/// Its bytes need not exist: a range may stand for anything that has a number. On NFS the
/// server keeps the locks, so that they hold between machines.
class LockFile {
 public:
  /// Opens the file, or makes an empty one. Throws InputError if neither can be done.
  explicit LockFile(const std::string& path);

  /// Takes bytes [begin, begin + size), size > 0, for this object alone. Never waits.
  /// Throws InputError with the system's reason for what is none of the outcomes.
  LockOutcome TryLock(std::uint64_t begin, std::uint64_t size);
  /// Frees them. Destruction frees all.
  void Unlock(std::uint64_t begin, std::uint64_t size);

  const std::string& path() const { return path_; }
  /// False once the path names another file, or none: locks on this one then exclude
  /// nobody who comes later.
  bool IsNamed() const;

  /// Makes `text` the content, or tries to: what is read of it is meant for people.
  void SetNote(const std::string& text);
  std::string Note() const;

 private:
  std::string path_;
  FileDescriptor fd_;
};

}  // namespace lanelight
