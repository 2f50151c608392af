// Who builds a tree, of processes that want the same one at once: the first. The others
// wait, and find it in its file.
#pragma once

#include <optional>
#include <string>

#include "src/accel/tree_folder.h"
#include "src/core/file_lock.h"

namespace lanelight {

/// A lock of the folder's file `locks`, by the name of the key.
class TreeTurn {
 public:
  /// Returns at once if nobody else has the turn for `key`. If somebody has, waits until
  /// that is through or dead, or gives up (Abandon), for `patience` seconds at most: it
  /// may have been stopped, or hang. In each case the tree may be there by then. Throws
  /// Interrupted if folder.stop is set while it waits.
  TreeTurn(const TreeFolder& folder, const TreeKey& key, double patience);

  /// Trees cannot be kept here (a full disk): those who wait shall all build at once, and
  /// not one after the other. Removes the file that they have their locks on.
  void Abandon();

  /// True if others wait for this object's end.
  bool IsOurs() const { return lock_.has_value(); }
  bool Waited() const { return waited_; }
  /// Why there is no waiting, or not to the end; begins with a path. Mostly empty.
  const std::string& problem() const { return problem_; }

 private:
  std::string Wait(const TreeFolder& folder, const TreeKey& key, double patience);

  std::optional<LockFile> file_;
  std::optional<HeldLock> lock_;
  bool waited_ = false;
  std::string problem_;
};

}  // namespace lanelight
