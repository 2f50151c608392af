// Memory nodes as the system lists them, and threads on their processors.
#include "src/core/memory_nodes.h"

#include <sched.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "tests/image/temporary_folder.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Processors that this process may run on.
std::vector<int> OwnProcessors() {
  cpu_set_t set;
  REQUIRE(sched_getaffinity(0, sizeof(set), &set) == 0);
  std::vector<int> out;
  for (int p = 0; p < CPU_SETSIZE; ++p) {
    if (CPU_ISSET(p, &set)) out.push_back(p);
  }
  return out;
}

// A node of its own for each of them.
MemoryNodes NodePerProcessor() {
  std::vector<std::vector<int>> processors;
  for (const int p : OwnProcessors()) processors.push_back({p});
  return MemoryNodes(std::move(processors));
}

// Where the work on each node runs.
std::vector<int> NodesOfWork(const MemoryNodes& nodes) {
  std::vector<int> ran(static_cast<std::size_t>(nodes.size()), -1);
  nodes.OnEach([&](int node) { ran[static_cast<std::size_t>(node)] = nodes.Here(); });
  return ran;
}

}  // namespace

TEST_CASE("nodes are what the system lists, but for those where nothing can run",
          "[core][nodes]") {
  const TemporaryFolder folder;
  const fs::path root = folder.File("node");
  const std::vector<int> own = OwnProcessors();
  // Node 0 is for others, node 2 is memory alone; the rest are no nodes or processors.
  for (const char* path : {"node0/cpu7000", "node0/cpumap", "node2/memory3",
                           "node2/cpulist", "power", "nodes", "node3x/cpu1"}) {
    fs::create_directories(root / path);
  }
  for (const int p : own) {
    const char* const node = p == own[0] ? "node10" : "node9";
    fs::create_directories(root / node / ("cpu" + std::to_string(p)));
  }
  std::ofstream(root / "online") << "0,10";
  const MemoryNodes nodes = MemoryNodes::OfMachine(root);
  CHECK(nodes.size() == (own.size() > 1 ? 2 : 1));
  // By their numbers, not by their names: 9 before 10.
  const std::vector<int> two = {0, 1}, one = {0};
  CHECK(NodesOfWork(nodes) == (own.size() > 1 ? two : one));
}

TEST_CASE("a system that lists no nodes has one", "[core][nodes]") {
  const TemporaryFolder folder;
  const MemoryNodes nodes = MemoryNodes::OfMachine(folder.File("missing"));
  CHECK(nodes.size() == 1);
  CHECK(nodes.Here() == 0);
  int calls = 0;
  nodes.OnEach([&](int node) { calls += node == 0; });
  CHECK(calls == 1);
  CHECK(NodesOfMachine().size() >= 1);
}

TEST_CASE("work on each node runs on its processors", "[core][nodes]") {
  const MemoryNodes nodes = NodePerProcessor();
  std::vector<int> all(OwnProcessors().size());
  std::iota(all.begin(), all.end(), 0);
  CHECK(NodesOfWork(nodes) == all);
}

TEST_CASE("processors that no node has are of the first", "[core][nodes]") {
  const MemoryNodes nodes({{7000}, {7001}});
  CHECK(nodes.Here() == 0);
  std::vector<int> calls(2, 0);
  // Nor can anything run on these: it runs all the same.
  nodes.OnEach([&](int node) { ++calls[static_cast<std::size_t>(node)]; });
  CHECK(calls == std::vector<int>{1, 1});
}

TEST_CASE("what fails on a node fails the caller, once all have ended", "[core][nodes]") {
  const MemoryNodes nodes({{0}, {1}});
  bool ended = false;
  const auto work = [&](int node) {
    if (node == 0) throw std::runtime_error("no memory");
    ended = true;
  };
  CHECK_THROWS_WITH(nodes.OnEach(work), "no memory");
  CHECK(ended);
}

}  // namespace lanelight
