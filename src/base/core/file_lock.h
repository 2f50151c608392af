// Locks by which processes on any machines that share a file system keep out of each
// other's way. The kernel, or the file server, frees them when their process ends,
// however it ends: no heartbeat, clock, process number or clearing up plays a part.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "src/base/core/file_descriptor.h"

namespace lanelight {

class LockFile;

/// A lock, as long as it lives; the file must outlive it.
class HeldLock {
 public:
  HeldLock(HeldLock&& other) noexcept;
  HeldLock& operator=(HeldLock&& other) noexcept;
  ~HeldLock();

 private:
  friend class LockFile;
  HeldLock(const LockFile* file, std::uint64_t byte) : file_(file), byte_(byte) {}
  const LockFile* file_;  // null: nothing to free
  std::uint64_t byte_;
};

/// A file that is there for its locks, each of which has a name. Two objects exclude each
/// other even in one process.
class LockFile {
 public:
  /// Opens the file, or makes an empty one. Throws InputError if neither can be done.
  explicit LockFile(const std::string& path);
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

  /// False if the file system knows no locks. Take then grants everything.
  bool locking() const { return locking_; }
  /// Returns the lock, or nothing if another process has it. Never waits. A lock is one
  /// byte of the file, present or not, chosen by the hash of its name; two names share
  /// one with a probability of 2^-62. Throws InputError with the system's reason if the
  /// file system fails.
  std::optional<HeldLock> Take(const std::string& name) const;
  /// Tries again, with pauses, as long as go_on(seconds that it has waited) holds.
  std::optional<HeldLock> Wait(const std::string& name,
                               const std::function<bool(double)>& go_on) const;

  const std::string& path() const { return path_; }
  /// False once the path names another file, or none: locks of this one then exclude no
  /// later process.
  bool IsNamed() const;

  /// Makes `text` the content, or tries to: what is read of it is meant for people.
  void SetNote(const std::string& text);
  std::string Note() const;

 private:
  friend class HeldLock;
  std::string path_;
  FileDescriptor fd_;
  bool locking_ = true;
};

}  // namespace lanelight
