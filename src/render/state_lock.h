// One process at a time keeps a state.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "src/core/file_lock.h"

namespace lanelight {

/// While it lives, no other process keeps the state `path`: a lock on the file PATH.lock,
/// which goes away in the end. After a SIGKILL the file stays, and means nothing: only
/// the lock counts, and the kernel frees that.
class StateLock {
 public:
  /// Throws InputError, which says who, if the state is being kept already. Removes what
  /// writers that were killed have left beside the state (PATH.*.*.tmp). `on_problem` is
  /// told if there are no locks here.
  StateLock(const std::string& path,
            const std::function<void(const std::string&)>& on_problem);
  ~StateLock();
  StateLock(const StateLock&) = delete;
  StateLock& operator=(const StateLock&) = delete;

 private:
  std::unique_ptr<LockFile> file_;  // locked; null: no locks here
};

}  // namespace lanelight
