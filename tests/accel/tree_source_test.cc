// Where trees come from, and what happens where they cannot.
#include "src/core/input_file.h"
#include "src/accel/tree_source.h"

#include <catch2/catch.hpp>

#include "src/image/atomic_file.h"
#include "tests/accel/tree_sources.h"
#include "tests/image/file_size_limit.h"

namespace lanelight {
namespace {

using Catch::Contains;

}  // namespace

TEST_CASE("a tree is built once, and then mapped", "[accel][tree-source]") {
  TreeSources s;
  const FoundTree built = s.Find();
  CHECK(built.report.origin == TreeOrigin::kBuilt);
  CHECK(built.problems.empty());
  CHECK(std::filesystem::exists(s.Path()));
  const FoundTree mapped = s.Find();
  CHECK(mapped.report.origin == TreeOrigin::kMapped);
  CHECK(mapped.problems.empty());
  CHECK(mapped.report.bytes == built.report.bytes);
  CHECK(SameNodes(mapped.accel, built.accel));

  CHECK(FindTree(s.shapes, {.quality = BuildQuality::kFast}, s.source).report.origin ==
        TreeOrigin::kBuilt);
  s.shapes = SomeShapes(0.2f);
  const FoundTree other = s.Find();
  CHECK(other.report.origin == TreeOrigin::kBuilt);
  CHECK_FALSE(SameNodes(other.accel, built.accel));
  CHECK(s.Find().report.origin == TreeOrigin::kMapped);
}

TEST_CASE("a known tree is taken if it is of the same shapes", "[accel][tree-source]") {
  TreeSources s;
  s.source.folder.path.clear();
  const Accel built = s.Find().accel;
  s.source.known =
      std::make_shared<const KnownTree>(KnownTree{KeyOf(s.shapes, {}), built});
  const FoundTree shared = s.Find();
  CHECK(shared.report.origin == TreeOrigin::kShared);
  CHECK(shared.accel.nodes.data() == built.nodes.data());
  s.shapes.triangles[1000].p[0][0] += 1;
  const FoundTree moved = s.Find();
  CHECK(moved.report.origin == TreeOrigin::kBuilt);
  CHECK_FALSE(SameNodes(moved.accel, built));
  CHECK(s.folder.Count() == 0);
}

TEST_CASE("a damaged tree file is told, and replaced", "[accel][tree-source]") {
  TreeSources s;
  const Accel built = s.Find().accel;
  std::string content = ReadWholeFile(s.Path());
  content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 1);
  WriteFileAtomically(s.Path(), content);
  const FoundTree again = s.Find();
  CHECK(again.report.origin == TreeOrigin::kBuilt);
  REQUIRE(again.problems.size() == 1);
  CHECK_THAT(again.problems[0], Contains(s.Path() + ": the tree is damaged") &&
                                    Contains("the trees were built anew"));
  CHECK(SameNodes(again.accel, built));
  CHECK(s.Find().report.origin == TreeOrigin::kMapped);
}

TEST_CASE("where no tree can be kept, it is built and told", "[accel][tree-source]") {
  TreeSources s;
  const std::string file = s.folder.Write("file", "text");
  s.source.folder.path = file;
  const FoundTree no_folder = s.Find();
  CHECK(no_folder.report.origin == TreeOrigin::kBuilt);
  REQUIRE(no_folder.problems.size() == 1);
  CHECK_THAT(no_folder.problems[0],
             Contains("Not a directory") && Contains("the trees are not kept"));
  CHECK(ReadWholeFile(file) == "text");

  s.source.folder.path = s.folder.File("full");
  {
    const FileSizeLimit limit(8192);
    const FoundTree full = s.Find();
    CHECK(full.report.origin == TreeOrigin::kBuilt);
    CHECK_FALSE(full.accel.nodes.empty());
    REQUIRE(full.problems.size() == 1);
    CHECK_THAT(full.problems[0], Contains("File too large"));
  }
  CHECK(s.Files().empty());
}

TEST_CASE("a tree file that cannot be replaced is told twice", "[accel][tree-source]") {
  TreeSources s;
  s.Find();
  std::filesystem::remove(s.Path());
  std::filesystem::create_directory(s.Path());
  const FoundTree found = s.Find();
  CHECK(found.report.origin == TreeOrigin::kBuilt);
  REQUIRE(found.problems.size() == 2);
  CHECK_THAT(found.problems[0], Contains("not a regular file"));
  CHECK_THAT(found.problems[1], Contains("the trees are not kept"));
}

}  // namespace lanelight
