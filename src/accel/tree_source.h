// Trees that need not be built: of the scene that was compiled before, or of a file.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "src/accel/accel.h"
#include "src/accel/tree_key.h"

namespace lanelight {

struct KnownTree {
  TreeKey key;
  Accel accel;
};

/// Where to look for a tree before it is built.
struct TreeSource {
  std::string directory;                   // of tree files, to be filled; empty: none
  std::shared_ptr<const KnownTree> known;  // may be null
};

enum class TreeOrigin { kBuilt, kMapped, kShared };  // anew, of a file, of KnownTree
/// "built", "mapped", "shared".
const char* Name(TreeOrigin origin);

struct TreeReport {
  TreeOrigin origin = TreeOrigin::kBuilt;
  double seconds = 0;     // finding or building, the hash of the shapes included
  std::size_t bytes = 0;  // of the tree
};

struct FoundTree {
  Accel accel;
  TreeReport report;
  /// Why a file was not used, or none was written; each begins with its path.
  std::vector<std::string> problems;
};

/// The tree of `known` if it is of the same shapes; else of directory/KEY.tree; else
/// BuildAccel's, which is written there. The directory is made if it is missing. Whatever
/// is wrong with it or the file costs the time of building and is told in `problems`.
FoundTree FindTree(const Geometry& geometry, const AccelOptions& options,
                   const TreeSource& source);

}  // namespace lanelight
