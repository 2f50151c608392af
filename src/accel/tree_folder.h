// The folder of --build-cache: which files in it are ours, and which of them go when they
// are too many.
//
//   KEY.tree           a tree (src/accel/tree_file.h); its time is that of its last use
//
//   KEY.tree.N.N.tmp   one that is being written, or whose writer was killed
//
//   locks              nothing; its bytes are locked by those who build (tree_turn.h)
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "src/accel/tree_key.h"

namespace lanelight {

/// Of all tree files in a folder: those of 200 to 370 million triangles.
inline constexpr std::uint64_t kTreeFolderBytes = 10'000'000'000;

struct TreeFolder {
  std::string path;  // empty: none
  /// Of its tree files; 0: as many as there are.
  std::uint64_t most_bytes = kTreeFolderBytes;
  /// Told, in a line of text, what is waited for; once a tree, after half a second.
  std::function<void(const std::string&)> on_wait = {};
  const std::atomic<bool>* stop = nullptr;  // ends waiting; may be null
};

/// Where the folder has the tree of `key`.
std::string TreePath(const TreeFolder& folder, const TreeKey& key);

/// Makes the file of a tree the one that was used last. Where that is not allowed
/// (another user's file) it stays as old as it was, and goes earlier.
void MarkUsed(const std::string& path);

/// Removes the tree files that were used least recently until all of them together fit in
/// `folder.most_bytes`, and what writers that were killed have left for a day. `keep`,
/// the path of one, stays, however large. Other files are not touched. Whoever has mapped
/// a file keeps its content. Throws InputError, which begins with a path, if the folder
/// cannot be read, or if something that should go cannot be removed; the rest is then
/// removed nevertheless.
void PruneTrees(const TreeFolder& folder, const std::string& keep);

}  // namespace lanelight
