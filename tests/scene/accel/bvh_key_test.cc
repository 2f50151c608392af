// What a tree is keyed by: all that it depends on, and nothing else.
#include "src/scene/accel/build.h"

#include <catch2/catch.hpp>

#include <functional>
#include <set>

#include "src/base/core/parallel.h"
#include "tests/support/brute_force.h"

namespace lanelight {
namespace {

Geometry AllShapes() {
  brute::Random random(64);
  Geometry g = brute::Soup(random, 20000, 1, 0.1f);
  g.groups = {{0, 15000}, {15000, 20000}};
  g.spheres.resize(3);
  g.disks.resize(4);
  g.instances.resize(2);
  g.instance_group = {1, 1};
  g.ranges = {20000, 20003, 20007, 20007, 20007};
  return g;
}

std::pair<std::uint64_t, std::uint64_t> WordsOf(const Geometry& g,
                                                const AccelOptions& options = {}) {
  const BvhKey key = KeyOf(g, options);
  return {key.low, key.high};
}

}  // namespace

TEST_CASE("the key of a BVH covers everything that it depends on", "[accel][tree-key]") {
  const Geometry plain = AllShapes();
  const std::vector<std::function<void(Geometry&)>> changes = {
      [](Geometry& g) { g.triangles[0].p[0][0] += 1; },
      [](Geometry& g) { g.triangles[8191].p[1][1] += 1; },
      [](Geometry& g) { g.triangles[8192].p[2][2] += 1; },
      [](Geometry& g) { g.triangles[19999].p[2][2] += 1; },
      [](Geometry& g) { std::swap(g.triangles[5], g.triangles[6]); },
      [](Geometry& g) { g.triangles.pop_back(); },
      [](Geometry& g) { g.groups[0].end = g.groups[1].begin = 14999; },
      [](Geometry& g) { g.groups.push_back({}); },
      [](Geometry& g) { g.spheres[2].center[2] = 1; },
      [](Geometry& g) { g.spheres[1].radius = 1; },
      [](Geometry& g) { g.spheres.emplace_back(); },
      [](Geometry& g) { g.disks[3].center[0] = 1; },
      [](Geometry& g) { g.disks[0].radius = 1; },
      [](Geometry& g) { g.disks[0].inner_radius = 1; },
      [](Geometry& g) { g.disks[0].normal[1] = 1; },
      [](Geometry& g) { g.instances[1].object_from_scene[11] = 1; },
      [](Geometry& g) { g.instances[0].scene_from_object[0] = 1; },
      [](Geometry& g) { g.motions.resize(1); },
      [](Geometry& g) { g.instance_group[1] = 0; },
      [](Geometry& g) { ++g.ranges.spheres; },
      [](Geometry& g) { ++g.ranges.disks; }};
  std::set<std::pair<std::uint64_t, std::uint64_t>> keys = {WordsOf(plain)};
  for (const auto& change : changes) {
    Geometry changed = plain;
    change(changed);
    keys.insert(WordsOf(changed));
  }
  keys.insert(WordsOf(plain, {.quality = BuildQuality::kFast}));
  keys.insert(WordsOf(plain, {.few_triangles = 1}));
  keys.insert(WordsOf(plain, {.few_round = 1}));
  keys.insert(WordsOf(plain, {.leaf_triangles = SmallLeaf::kLanes}));
  CHECK(keys.size() == 1 + changes.size() + 4);
}

TEST_CASE("the key of a BVH ignores the appearance of shapes", "[accel][tree-key]") {
  const Geometry plain = AllShapes();
  Geometry other = plain;
  other.triangles[7].material = 3;
  other.triangles[7].light = 5;
  other.triangles[7].flags = kAlphaTested;
  other.spheres[0].normal_sign = -1;
  other.disks[0].material = 2;
  other.normals.resize(9 * 20000, 1);
  other.planes.emplace_back();
  CHECK(WordsOf(other) == WordsOf(plain));
}

TEST_CASE("the key of a BVH does not depend on the number of threads",
          "[accel][tree-key]") {
  const Geometry plain = AllShapes();
  const auto key = WordsOf(plain);
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    CHECK(WordsOf(plain) == key);
  }
}

}  // namespace lanelight
