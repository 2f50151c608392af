// Who renders which cell, among any number of processes on any machines that share a file
// system: locks of open file descriptions on single bytes of one empty file. The kernel,
// or the file server, gives a lock back when its process ends in whatever way, so that
// claims need no heartbeat, no clock and no clearing up.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "src/core/file_lock.h"

namespace lanelight {

class Claims {
 public:
  /// A lock, as long as it lives.
  class Claim {
   public:
    Claim(Claim&& other) noexcept;
    Claim& operator=(Claim&&) = delete;
    ~Claim();

   private:
    friend class Claims;
    Claim(LockFile* file, std::uint64_t byte) : file_(file), byte_(byte) {}
    LockFile* file_;  // null: nothing to give back
    std::uint64_t byte_;
  };

  /// Opens or makes the file. Throws InputError if that fails, and, unless `optional`, if
  /// its file system has no locks. With `optional` every claim is then granted.
  explicit Claims(const std::string& path, bool optional = false);

  /// Empty if another process has it. Keys become bytes by their hash: two keys may share
  /// one with a probability of 2^-62, and are then not claimed at once. Throws InputError
  /// if the file system fails.
  std::optional<Claim> Take(const std::string& key) const;
  /// Waits for it; empty if `stop` is set before.
  std::optional<Claim> Wait(const std::string& key,
                            const std::atomic<bool>* stop = nullptr) const;

  bool locking() const { return locking_; }

 private:
  mutable LockFile file_;
  bool locking_ = true;
};

}  // namespace lanelight
