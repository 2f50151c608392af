// Locks between processes on any machines that share a file system. The kernel or the
// file server frees them when their process ends, however it ends.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "src/base/core/input_file.h"

namespace lanelight {

class LockFile;

/// Holds a lock while it lives; the file must outlive it.
class ScopedLock {
 public:
  ScopedLock(ScopedLock&& other) noexcept;
  ScopedLock& operator=(ScopedLock&& other) noexcept;
  ~ScopedLock();

 private:
  friend class LockFile;
  ScopedLock(const LockFile* file, std::uint64_t byte) : file_(file), byte_(byte) {}
  const LockFile* file_;  // null: nothing to free
  std::uint64_t byte_;
};

/// A file of named locks. Two objects exclude each other even in one process.
class LockFile {
 public:
  /// Opens the file, or creates it. Throws InputError if it cannot.
  explicit LockFile(const std::string& path);
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

  /// False if the file system knows no locks. Take then grants everything.
  bool supports_locks() const { return supports_locks_; }
  /// Takes a lock; empty if it is taken. Never waits. A lock is one byte of the file, by
  /// the hash of its name; two names share a byte with a probability of 2^-62. Throws
  /// InputError if the file system fails.
  std::optional<ScopedLock> TryLock(const std::string& name) const;
  /// Tries again, with pauses, while keep_waiting(seconds waited so far) holds.
  std::optional<ScopedLock> Wait(const std::string& name,
                                 const std::function<bool(double)>& keep_waiting) const;

  const std::string& path() const { return path_; }
  /// False once the path names another file, or none: locks of this one then do not
  /// exclude processes that open the path later.
  bool IsNamed() const;

  /// Tries to make `text` the content, for people who read the file.
  void SetNote(const std::string& text);
  std::string Note() const;

 private:
  friend class ScopedLock;
  std::string path_;
  FileDescriptor fd_;
  bool supports_locks_ = true;
};

}  // namespace lanelight
