// Trees that need not be built: of the scene that was compiled before, or of a file.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "src/accel/accel.h"
#include "src/accel/tree_folder.h"
#include "src/accel/tree_key.h"

namespace lanelight {

struct KnownTree {
  TreeKey key;
  Accel accel;
};

/// Where to look for a tree before it is built.
struct TreeSource {
  TreeFolder folder;                       // of tree files, to be filled
  std::shared_ptr<const KnownTree> known;  // may be null
};

enum class TreeOrigin { kBuilt, kMapped, kShared };  // anew, of a file, of KnownTree
/// "built", "mapped", "shared".
const char* Name(TreeOrigin origin);

struct TreeReport {
  TreeOrigin origin = TreeOrigin::kBuilt;
  double seconds = 0;     // finding or building, hashing the shapes and waiting included
  std::size_t bytes = 0;  // of the tree
};

struct FoundTree {
  Accel accel;
  TreeReport report;
  /// Why a file was not used, or none was written; each begins with its path.
  std::vector<std::string> problems;
};

/// The tree of `known` if it is of the same shapes; else of the folder's file; else
/// BuildAccel's, which is written there, and then files that are too many go
/// (PruneTrees). Of processes that come at the same time one builds, and the others wait
/// for its file (TreeTurn): 10 s and 20 us for each shape at most, several times as long
/// as building takes. The folder is made if it is missing. Whatever is wrong with it or
/// the file costs the time of building and is told in `problems`. Throws Interrupted if
/// folder.stop ends waiting.
FoundTree FindTree(const Geometry& geometry, const AccelOptions& options,
                   const TreeSource& source);

}  // namespace lanelight
