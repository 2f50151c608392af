// Trees of several who look for them in one folder: who builds, who waits, what goes.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "src/accel/tree_file.h"
#include "src/accel/tree_turn.h"
#include "tests/accel/tree_sources.h"

namespace lanelight {
namespace {

using Catch::Contains;

// Those that ask for the tree at the same time, and what they get.
struct Crowd {
  static constexpr std::size_t kSize = 4;
  std::vector<FoundTree> found = std::vector<FoundTree>(kSize);
  std::atomic<std::size_t> waiting{0};

  // Calls all_wait() once all of them do, if they do.
  Crowd(const TreeSources& sources, const std::function<void()>& all_wait) {
    TreeSource source = sources.source;
    source.folder.on_wait = [&](const std::string&) {
      if (++waiting == kSize) all_wait();
    };
    std::vector<std::thread> threads;
    for (FoundTree& tree : found) {
      threads.emplace_back([&] { tree = FindTree(sources.shapes, {}, source); });
    }
    for (std::thread& thread : threads) thread.join();
  }
  int Count(TreeOrigin origin) const {
    return static_cast<int>(std::count_if(
        found.begin(), found.end(),
        [&](const FoundTree& tree) { return tree.report.origin == origin; }));
  }
};

}  // namespace

TEST_CASE("one builds for all who come at the same time", "[accel][tree-source]") {
  TreeSources s;
  std::filesystem::create_directories(s.source.folder.path);
  auto builder = std::make_unique<TreeTurn>(s.source.folder, KeyOf(s.shapes, {}), 1000);
  // That one dies without a tree: the next one builds, and the others go on waiting.
  const Crowd crowd(s, [&] { builder.reset(); });
  CHECK(crowd.waiting == Crowd::kSize);
  CHECK(crowd.Count(TreeOrigin::kBuilt) == 1);
  CHECK(crowd.Count(TreeOrigin::kMapped) == Crowd::kSize - 1);
  for (const FoundTree& tree : crowd.found) {
    CHECK(tree.problems.empty());
    CHECK(SameNodes(tree.accel, crowd.found[0].accel));
  }
  CHECK(s.Files().size() == 2);  // the tree, and what it is locked by
}

TEST_CASE("a tree that another process has built meanwhile is mapped",
          "[accel][tree-source]") {
  TreeSources s;
  std::filesystem::create_directories(s.source.folder.path);
  const Accel tree = BuildAccel(s.shapes, {});
  auto builder = std::make_unique<TreeTurn>(s.source.folder, KeyOf(s.shapes, {}), 1000);
  const Crowd crowd(s, [&] {
    WriteTreeFile(s.Path(), KeyOf(s.shapes, {}), tree);
    builder.reset();
  });
  CHECK(crowd.Count(TreeOrigin::kMapped) == Crowd::kSize);
}

TEST_CASE("who needs no tree waits for nobody", "[accel][tree-source]") {
  TreeSources s;
  s.Find();
  s.source.folder.on_wait = [](const std::string&) { FAIL("waits"); };
  const TreeTurn builder(s.source.folder, KeyOf(s.shapes, {}), 1000);
  CHECK(s.Find().report.origin == TreeOrigin::kMapped);
}

TEST_CASE("a tree that is written makes room for itself", "[accel][tree-source]") {
  TreeSources s;
  const std::uint64_t most = [&] {
    s.Find();
    return std::filesystem::file_size(s.Path()) * 5 / 2;
  }();
  const std::string first = s.Path();
  s.source.folder.most_bytes = most;
  std::vector<std::string> paths = {first};
  for (const float edge : {0.11f, 0.12f}) {
    // The clock of a file system may be slow.
    const auto used = std::filesystem::last_write_time(paths.back());
    std::filesystem::last_write_time(paths.back(), used - std::chrono::hours(9));
    s.shapes = SomeShapes(edge);
    CHECK(s.Find().problems.empty());
    paths.push_back(s.Path());
  }
  CHECK_FALSE(std::filesystem::exists(paths[0]));
  CHECK(std::filesystem::exists(paths[1]));
  CHECK(std::filesystem::exists(paths[2]));
  // What is mapped is used.
  const auto old = std::filesystem::last_write_time(s.Path()) - std::chrono::hours(5);
  std::filesystem::last_write_time(s.Path(), old);
  CHECK(s.Find().report.origin == TreeOrigin::kMapped);
  CHECK(std::filesystem::last_write_time(s.Path()) > old);
}

TEST_CASE("without locks the tree is built, kept and told", "[accel][tree-source]") {
  TreeSources s;
  s.source.folder.path = s.folder.File("trees");
  std::filesystem::create_directories(s.source.folder.path + "/locks");
  const FoundTree found = s.Find();
  CHECK(found.report.origin == TreeOrigin::kBuilt);
  REQUIRE(found.problems.size() == 1);
  CHECK_THAT(found.problems[0], Contains("/locks: cannot open: Is a directory"));
  CHECK(s.Find().report.origin == TreeOrigin::kMapped);
}

}  // namespace lanelight
