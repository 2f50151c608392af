#include "src/accel/tree_folder.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string_view>
#include <vector>

#include "src/core/error.h"
#include "src/image/atomic_file.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTreeEnd = ".tree";
constexpr std::size_t kKeyDigits = 32;
// A writer touches its file all the time: what is this old has none.
constexpr auto kLeftBehind = std::chrono::hours(24);

struct KeptTree {
  fs::path path;
  fs::file_time_type used;
  std::uintmax_t bytes;
};

struct FolderContent {
  std::vector<KeptTree> trees;
  std::vector<fs::path> left_behind;
};

// "<32 digits>.tree", as TreePath names them.
bool IsTreeName(std::string_view name) {
  return name.size() == kKeyDigits + kTreeEnd.size() && name.ends_with(kTreeEnd) &&
         name.find_first_not_of("0123456789abcdef") == kKeyDigits;
}

bool IsTemporaryTree(const std::string& name) {
  const std::string tree = name.substr(0, kKeyDigits + kTreeEnd.size());
  return IsTreeName(tree) && IsTemporaryOf(name, tree);
}

// Other processes add and remove files meanwhile: those that vanish count for nothing.
FolderContent ContentOf(const std::string& folder) {
  FolderContent content;
  std::error_code error, vanished;
  const auto now = fs::file_time_type::clock::now();
  for (fs::directory_iterator i(folder, error), end; !error && i != end;
       i.increment(error)) {
    if (i->symlink_status(vanished).type() != fs::file_type::regular) continue;
    const KeptTree file = {i->path(), i->last_write_time(vanished),
                           i->file_size(vanished)};
    if (vanished) continue;
    const std::string name = file.path.filename();
    if (IsTreeName(name)) content.trees.push_back(file);
    if (IsTemporaryTree(name) && now - file.used > kLeftBehind) {
      content.left_behind.push_back(file.path);
    }
  }
  if (error) {
    throw InputError(
        fmt::format("{}: cannot look for old trees: {}", folder, error.message()));
  }
  return content;
}

// What has to go for the rest to fit, the least recently used first.
std::vector<fs::path> TooMany(std::vector<KeptTree> trees, std::uint64_t most_bytes,
                              const fs::path& keep) {
  std::sort(trees.begin(), trees.end(),
            [](const KeptTree& a, const KeptTree& b) { return a.used < b.used; });
  std::uintmax_t bytes = 0;
  for (const KeptTree& tree : trees) bytes += tree.bytes;
  std::vector<fs::path> out;
  for (const KeptTree& tree : trees) {
    if (bytes <= most_bytes) break;
    if (tree.path.filename() == keep.filename()) continue;
    bytes -= tree.bytes;
    out.push_back(tree.path);
  }
  return out;
}

}  // namespace

std::string TreePath(const TreeFolder& folder, const TreeKey& key) {
  return folder.path + "/" + key.Hex() + std::string(kTreeEnd);
}

void MarkUsed(const std::string& path) {
  [[maybe_unused]] const int result = utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
}

void PruneTrees(const TreeFolder& folder, const std::string& keep) {
  FolderContent content = ContentOf(folder.path);
  std::vector<fs::path> remove = std::move(content.left_behind);
  if (folder.most_bytes > 0) {
    const auto old = TooMany(std::move(content.trees), folder.most_bytes, keep);
    remove.insert(remove.end(), old.begin(), old.end());
  }
  std::string problem;
  for (const fs::path& path : remove) {
    std::error_code error;  // none if another process was faster
    fs::remove(path, error);
    if (error && problem.empty()) {
      problem = fmt::format("{}: cannot remove: {}", path.string(), error.message());
    }
  }
  if (!problem.empty()) throw InputError(problem);
}

}  // namespace lanelight
