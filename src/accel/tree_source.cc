#include "src/accel/tree_source.h"

#include <chrono>
#include <filesystem>
#include <string_view>

#include "src/accel/tree_file.h"
#include "src/core/check.h"
#include "src/core/error.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// These errors end nothing.
void Tell(const InputError& error, const char* consequence, FoundTree& tree) {
  constexpr std::string_view kPrefix = "error: ";
  std::string text = error.what();
  if (text.starts_with(kPrefix)) text.erase(0, kPrefix.size());
  tree.problems.push_back(text + consequence);
}

// True if the tree was in the file. That there is none is no problem.
bool MapTree(const std::string& path, const TreeKey& key, FoundTree& tree) {
  std::error_code error;
  if (fs::status(path, error).type() == fs::file_type::not_found) return false;
  try {
    tree.accel = ReadTreeFile(path, key);
    tree.report.origin = TreeOrigin::kMapped;
    return true;
  } catch (const InputError& refusal) {
    Tell(refusal, "; the trees were built anew", tree);
    return false;
  }
}

void KeepTree(const std::string& path, const TreeKey& key, FoundTree& tree) {
  std::error_code error;  // that there is no directory is what writing says, with reason
  fs::create_directories(fs::path(path).parent_path(), error);
  try {
    WriteTreeFile(path, key, tree.accel);
  } catch (const InputError& failure) {
    Tell(failure, "; the trees are not kept", tree);
  }
}

void Find(const Geometry& geometry, const AccelOptions& options, const TreeSource& source,
          FoundTree& tree) {
  if (source.directory.empty() && !source.known) {
    tree.accel = BuildAccel(geometry, options);
    return;
  }
  const TreeKey key = KeyOf(geometry, options);
  if (source.known && source.known->key == key) {
    tree.accel = source.known->accel;
    tree.report.origin = TreeOrigin::kShared;
    return;
  }
  const std::string path = source.directory + "/" + key.Hex() + ".tree";
  if (!source.directory.empty() && MapTree(path, key, tree)) return;
  tree.accel = BuildAccel(geometry, options);
  if (!source.directory.empty()) KeepTree(path, key, tree);
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
  const auto start = std::chrono::steady_clock::now();
  FoundTree tree;
  Find(geometry, options, source, tree);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  tree.report.seconds = time.count();
  tree.report.bytes = tree.accel.Bytes();
  return tree;
}

}  // namespace lanelight
