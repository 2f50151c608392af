#include "src/accel/tree_turn.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "src/core/error.h"
#include "src/core/error_text.h"
#include "src/core/interrupted.h"

namespace lanelight {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kFirstPause(1e-3), kLongestPause(50e-3), kSilence(0.5);

// Bytes beyond the end of a file can be locked too.
std::uint64_t ByteOf(const TreeKey& key) {
  return key.low & ((std::uint64_t{1} << 62) - 1);
}

}  // namespace

TreeTurn::TreeTurn(const TreeFolder& folder, const TreeKey& key, double patience) {
  std::string why;
  try {
    lock_.emplace(folder.path + "/locks");
    why = Wait(folder, key, patience);
  } catch (const InputError& error) {
    why = WithoutPrefix(error);
  }
  if (why.empty()) return;
  problem_ = why + (waited_ ? "; the trees were built here too"
                            : "; processes that start at once build the same trees");
  lock_.reset();
}

void TreeTurn::Abandon() {
  if (lock_ && lock_->IsNamed()) unlink(lock_->path().c_str());
}

// Why there is no waiting; empty: it is over.
std::string TreeTurn::Wait(const TreeFolder& folder, const TreeKey& key,
                           double patience) {
  const auto start = std::chrono::steady_clock::now();
  const std::string path = TreePath(folder, key);
  bool told = !folder.on_wait;
  for (Seconds pause = kFirstPause;; pause = std::min(2 * pause, kLongestPause)) {
    const LockOutcome outcome = lock_->TryLock(ByteOf(key), 1);
    if (outcome == LockOutcome::kTaken) return "";
    if (outcome == LockOutcome::kUnknown) {
      return lock_->path() + ": this file system knows no locks";
    }
    waited_ = true;
    if (!lock_->IsNamed()) {  // abandoned, or somebody has emptied the folder
      lock_.reset();
      return "";
    }
    if (folder.stop != nullptr && *folder.stop) {
      throw Interrupted("stopped while another process was building " + path);
    }
    const Seconds waited = std::chrono::steady_clock::now() - start;
    if (waited.count() >= patience) {
      return fmt::format("{}: another process has been building it for {:.0f} s and more",
                         path, patience);
    }
    if (!told && waited > kSilence) {
      folder.on_wait(
          fmt::format("waiting for another process to build {}, {:.0f} s at "
                      "most",
                      path, patience));
      told = true;
    }
    // Not F_OFD_SETLKW, which signals do not end where they restart system calls.
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace lanelight
