// One process at a time keeps a state.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "src/base/core/file_lock.h"

namespace lanelight {

/// While it lives, no other process keeps the state `path`: a lock of the file PATH.lock,
/// which goes away in the end. After a SIGKILL the file stays, and means nothing.
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
  std::optional<LockFile> file_;  // none: no locks here
  std::optional<HeldLock> lock_;
};

}  // namespace lanelight
