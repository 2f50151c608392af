#include "src/accel/tree_turn.h"

#include <unistd.h>

#include "src/core/error.h"
#include "src/core/error_text.h"
#include "src/core/interrupted.h"

namespace lanelight {
namespace {

constexpr double kSilence = 0.5;  // seconds

}  // namespace

TreeTurn::TreeTurn(const TreeFolder& folder, const TreeKey& key, double patience) {
  std::string why;
  try {
    file_.emplace(folder.path + "/locks");
    why = Wait(folder, key, patience);
  } catch (const InputError& error) {
    why = WithoutPrefix(error);
  }
  if (why.empty()) return;
  problem_ = why + (waited_ ? "; the trees were built here too"
                            : "; processes that start at once build the same trees");
}

void TreeTurn::Abandon() {
  if (file_ && file_->IsNamed()) unlink(file_->path().c_str());
}

// Why there is no waiting; empty: it is over.
std::string TreeTurn::Wait(const TreeFolder& folder, const TreeKey& key,
                           double patience) {
  if (!file_->locking()) return file_->path() + ": this file system knows no locks";
  const std::string path = TreePath(folder, key);
  bool told = !folder.on_wait, abandoned = false;
  lock_ = file_->Wait(key.Hex(), [&](double waited) {
    waited_ = true;
    abandoned = !file_->IsNamed();  // or somebody has emptied the folder
    if (abandoned) return false;
    if (folder.stop != nullptr && *folder.stop) {
      throw Interrupted("stopped while another process was building " + path);
    }
    if (waited >= patience) return false;
    if (!told && waited > kSilence) {
      folder.on_wait(fmt::format(
          "waiting for another process to build {}, {:.0f} s at most", path, patience));
      told = true;
    }
    return true;
  });
  if (lock_ || abandoned) return "";
  return fmt::format("{}: another process has been building it for {:.0f} s and more",
                     path, patience);
}

}  // namespace lanelight
