#include "src/accel/tree_source.h"

#include <filesystem>
#include <system_error>

#include "src/accel/tree_file.h"
#include "src/accel/tree_turn.h"
#include "src/core/check.h"
#include "src/core/error.h"
#include "src/core/error_text.h"
#include "src/core/stopwatch.h"
#include "src/geometry/geometry.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// These errors end nothing.
void Tell(const InputError& error, const char* consequence, FoundTree& tree) {
  tree.problems.push_back(WithoutPrefix(error) + consequence);
}

// True if the tree was in the file. That there is none is no problem.
bool MapTree(const std::string& path, const TreeKey& key, FoundTree& tree) {
  std::error_code error;
  if (fs::status(path, error).type() == fs::file_type::not_found) return false;
  try {
    tree.accel = ReadTreeFile(path, key);
    tree.report.origin = TreeOrigin::kMapped;
    MarkUsed(path);
    return true;
  } catch (const InputError& refusal) {
    Tell(refusal, "; the trees were built anew", tree);
    return false;
  }
}

// The same once more: what is wrong with a file that is there still has been told.
bool MapTreeSince(const std::string& path, const TreeKey& key, FoundTree& tree) {
  const std::vector<std::string> told = tree.problems;
  const bool mapped = MapTree(path, key, tree);
  tree.problems = told;
  return mapped;
}

// True if the tree is in its file now.
bool KeepTree(const TreeFolder& folder, const TreeKey& key, FoundTree& tree) {
  const std::string path = TreePath(folder, key);
  try {
    WriteTreeFile(path, key, tree.accel);
  } catch (const InputError& failure) {
    Tell(failure, "; the trees are not kept", tree);
    return false;
  }
  try {
    PruneTrees(folder, path);
  } catch (const InputError& failure) {
    Tell(failure, "; the trees there may take more than --build-cache-size", tree);
  }
  return true;
}

// Seconds: long for whoever builds, short for whoever waits for one that was stopped.
double Patience(const Geometry& g) {
  return 10 + 20e-6 * double(g.triangles.size() + g.spheres.size() + g.disks.size() +
                             g.curves.size() + g.instances.size());
}

void FindInFolder(const Geometry& geometry, const AccelOptions& options,
                  const TreeFolder& folder, const TreeKey& key, FoundTree& tree) {
  const std::string path = TreePath(folder, key);
  if (MapTree(path, key, tree)) return;
  std::error_code error;  // that there is no directory is what writing says, with reason
  fs::create_directories(folder.path, error);
  TreeTurn turn(folder, key, Patience(geometry));
  if (MapTreeSince(path, key, tree)) return;
  tree.accel = BuildAccel(geometry, options);
  const bool kept = KeepTree(folder, key, tree);
  if (!kept) turn.Abandon();
  // Where nothing can be written, nothing can be locked: that has been said.
  if (!turn.problem().empty() && (kept || turn.Waited())) {
    tree.problems.push_back(turn.problem());
  }
}

void Find(const Geometry& geometry, const AccelOptions& options, const TreeSource& source,
          FoundTree& tree) {
  if (source.folder.path.empty() && !source.known) {
    tree.accel = BuildAccel(geometry, options);
    return;
  }
  const TreeKey key = KeyOf(geometry, options);
  if (source.known && source.known->key == key) {
    tree.accel = source.known->accel;
    tree.report.origin = TreeOrigin::kShared;
  } else if (source.folder.path.empty()) {
    tree.accel = BuildAccel(geometry, options);
  } else {
    FindInFolder(geometry, options, source.folder, key, tree);
  }
}

}  // namespace

const char* Name(TreeOrigin origin) {
  switch (origin) {
    case TreeOrigin::kBuilt:
      return "built";
    case TreeOrigin::kMapped:
      return "mapped";
    case TreeOrigin::kShared:
      return "shared";
  }
  LL_CHECK(false);
  return "";
}

FoundTree FindTree(const Geometry& geometry, const AccelOptions& options,
                   const TreeSource& source) {
  const Stopwatch watch;
  FoundTree tree;
  Find(geometry, options, source, tree);
  tree.report.seconds = watch.Seconds();
  tree.report.bytes = tree.accel.Bytes();
  return tree;
}

}  // namespace lanelight
