// Which files of --build-cache go, and which stay.
#include "src/accel/tree_folder.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <set>

#include "src/core/error.h"
#include "tests/image/temporary_folder.h"

namespace lanelight {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

// A folder of trees that are said to be of 100 bytes and were used so many hours ago.
struct Trees {
  TemporaryFolder temporary;
  TreeFolder folder = {.path = temporary.File("")};

  static TreeKey Key(std::uint64_t n) { return {n, 0xabcdef0123456789u}; }
  std::string Path(std::uint64_t n) const { return TreePath(folder, Key(n)); }
  std::string Name(std::uint64_t n) const { return Key(n).Hex() + ".tree"; }

  void Add(const std::string& name, int hours) const {
    const std::string path = temporary.Write(name, std::string(100, 'x'));
    fs::last_write_time(path,
                        fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }
  void AddTrees(const std::vector<int>& hours) const {
    for (std::size_t n = 0; n < hours.size(); ++n) Add(Name(n), hours[n]);
  }
  // Which of the trees are there.
  std::set<std::uint64_t> Left() const {
    std::set<std::uint64_t> left;
    for (std::uint64_t n = 0; n < 10; ++n) {
      if (fs::exists(Path(n))) left.insert(n);
    }
    return left;
  }
};

using Numbers = std::set<std::uint64_t>;

}  // namespace

TEST_CASE("the trees that were used least recently go, until the rest fits",
          "[accel][tree-folder]") {
  Trees t;
  t.AddTrees({3, 5, 1, 4, 2});
  t.folder.most_bytes = 500;
  PruneTrees(t.folder, t.Path(2));
  CHECK(t.Left() == Numbers{0, 1, 2, 3, 4});
  t.folder.most_bytes = 499;
  PruneTrees(t.folder, t.Path(2));
  CHECK(t.Left() == Numbers{0, 2, 3, 4});
  t.folder.most_bytes = 250;
  PruneTrees(t.folder, t.Path(2));
  CHECK(t.Left() == Numbers{2, 4});
}

TEST_CASE("a tree that is mapped again is not the oldest any more",
          "[accel][tree-folder]") {
  Trees t;
  t.AddTrees({3, 2, 1});
  MarkUsed(t.Path(0));
  t.folder.most_bytes = 200;
  PruneTrees(t.folder, t.Path(2));
  CHECK(t.Left() == Numbers{0, 2});
  MarkUsed(t.Path(7));  // which is not there
  CHECK(t.Left() == Numbers{0, 2});
}

TEST_CASE("the tree that was just written stays, however old and large",
          "[accel][tree-folder]") {
  Trees t;
  t.AddTrees({3, 2, 1});
  t.folder.most_bytes = 1;
  PruneTrees(t.folder, t.Path(0));
  CHECK(t.Left() == Numbers{0});
}

TEST_CASE("a limit of 0 is none", "[accel][tree-folder]") {
  Trees t;
  t.AddTrees({3, 2, 1});
  t.folder.most_bytes = 0;
  PruneTrees(t.folder, t.Path(0));
  CHECK(t.Left() == Numbers{0, 1, 2});
}

TEST_CASE("files that are not trees neither go nor count", "[accel][tree-folder]") {
  Trees t;
  t.AddTrees({1, 2});
  const std::string hex = Trees::Key(8).Hex();
  const std::vector<std::string> foreign = {
      "locks",
      "scene.tree",
      "notes.txt",
      hex,
      hex + ".tree.bak",
      hex.substr(1) + ".tree",
      "0" + hex + ".tree",
      "ABCDEF" + hex.substr(6) + ".tree",
      hex.substr(1) + "g.tree",
      hex + ".tree.tmp",
      hex + ".tree.1.tmp",
      "scene.tree.1.2.tmp",
  };
  for (const std::string& name : foreign) t.Add(name, 1000);
  fs::create_directory(t.Path(8));
  fs::create_symlink(t.temporary.File("notes.txt"), t.Path(9));
  t.folder.most_bytes = 200;
  PruneTrees(t.folder, t.Path(0));
  CHECK(t.Left() == Numbers{0, 1, 8, 9});
  t.folder.most_bytes = 1;
  PruneTrees(t.folder, t.Path(0));
  CHECK(t.Left() == Numbers{0, 8, 9});
  for (const std::string& name : foreign) {
    CAPTURE(name);
    CHECK(fs::exists(t.temporary.File(name)));
  }
}

TEST_CASE("what killed writers have left goes after a day", "[accel][tree-folder]") {
  Trees t;
  t.AddTrees({1});
  t.Add(t.Name(1) + ".12.3.tmp", 23);
  t.Add(t.Name(1) + ".12.4.tmp", 25);
  t.folder.most_bytes = 0;
  PruneTrees(t.folder, t.Path(0));
  CHECK(fs::exists(t.Path(1) + ".12.3.tmp"));
  CHECK_FALSE(fs::exists(t.Path(1) + ".12.4.tmp"));
  CHECK(t.Left() == Numbers{0});
}

TEST_CASE("a folder that cannot be looked through is told", "[accel][tree-folder]") {
  Trees t;
  t.folder.path = t.temporary.Write("file", "text");
  CHECK_THROWS_WITH(PruneTrees(t.folder, "x"),
                    Contains(t.folder.path + ": cannot look for old trees: Not a dir"));
}

}  // namespace lanelight
