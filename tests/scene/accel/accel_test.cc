// Structure of trees whose triangles are not cut (those that are: spatial_split_test.cc):
// every shape in exactly one leaf, boxes that contain what is below them, the same tree
// for any number of threads.
#include "src/scene/geometry/accel.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

#include "src/base/core/parallel.h"
#include "src/scene/accel/partition.h"
#include "src/scene/accel/shape_items.h"
#include "tests/scene/accel/leaves.h"
#include "tests/support/brute_force.h"

namespace lanelight {
namespace {

using brute::Random;

constexpr int kSmall = SmallLeaf::kLanes;
constexpr AccelOptions kBuilds[] = {
    {.few_triangles = 0},
    {.few_triangles = 0, .quality = BuildQuality::kFast},
    {.few_triangles = 0, .leaf_triangles = kSmall},
    {.few_triangles = 0, .quality = BuildQuality::kFast, .leaf_triangles = kSmall}};

// All ids, checking that each vertex of triangles that are whole lies in the boxes on the
// way, with room for rounding (tests/scene/accel/spatial_split_test.cc looks at cut
// ones).
std::multiset<std::uint32_t> IdsOf(const Accel& accel, int& outside) {
  std::multiset<std::uint32_t> ids;
  const std::vector<LeafView> leaves = LeavesOf(accel);
  for (const LeafView& leaf : leaves) ids.insert(leaf.prim.begin(), leaf.prim.end());
  for (const LeafView& leaf : leaves) {
    for (std::size_t i = 0; i < leaf.prim.size(); ++i) {
      if (ids.count(leaf.prim[i]) > 1) continue;
      for (const Vec3f& p : leaf.corner[i]) {
        for (int a = 0; a < 3; ++a) {
          const float room = 0.9f * kShapeSlack * std::abs(p[a]);
          outside += p[a] - room < leaf.box.lo[a] || p[a] + room > leaf.box.hi[a];
        }
      }
    }
  }
  return ids;
}

// Nodes on the longest path.
int DepthOf(const Accel& accel, std::uint32_t ref) {
  if (ref == kEmptyRef || (ref & kLeafBit)) return 0;
  int below = 0;
  for (const std::uint32_t child : accel.nodes[ref].child) {
    below = std::max(below, DepthOf(accel, child));
  }
  return 1 + below;
}

}  // namespace

TEST_CASE("every triangle is in a leaf, those in one inside its boxes", "[accel]") {
  Random random(61);
  std::vector<Geometry> cases;
  for (const int n : {0, 1, 2, 7, 8, 9, 65, 5000, 20000}) {
    cases.push_back(brute::Soup(random, n, 1, 0.1f));
  }
  cases.push_back(brute::Soup(random, 3000, 0, 0));  // all at the origin
  Geometry line;                                     // exponentially spaced: deep trees
  for (int i = 0; i < 1000; ++i) {
    const float x = std::ldexp(1.0f, -i % 120);
    line.triangles.push_back(MakeTriangle({x, 0, 0}, {x, x, 0}, {x, 0, x}));
  }
  cases.push_back(line);
  for (const Geometry& g : cases) {
    const std::uint32_t n = static_cast<std::uint32_t>(g.triangles.size());
    CAPTURE(n);
    for (const AccelOptions& options : kBuilds) {
      const CompiledScene scene = MakeScene(g, options);
      int outside = 0;
      const auto ids = IdsOf(scene.accel, outside);
      CHECK(outside == 0);
      const bool may_cut = options.quality == BuildQuality::kHigh;
      CHECK(ids.size() <= n + (may_cut ? n / 4 : 0));
      CHECK(std::set<std::uint32_t>(ids.begin(), ids.end()).size() == n);
      const Bvh& bvh = scene.accel.groups[0];
      CHECK(bvh.depth == DepthOf(scene.accel, bvh.root));
      CHECK(bvh.depth * (kBvhWidth - 1) + 1 < kTraversalStack);
    }
  }
}

TEST_CASE("triangles with infinite or NaN vertices are left out", "[accel]") {
  Random random(62);
  Geometry g = brute::Soup(random, 100, 1, 0.1f);
  g.triangles[10].p[1][2] = INFINITY;
  g.triangles[20].p[0][0] = NAN;
  const CompiledScene scene = MakeScene(g);
  int outside = 0;
  const auto ids = IdsOf(scene.accel, outside);
  CHECK(ids.size() == 98);
  CHECK(ids.count(10) + ids.count(20) == 0);
  CHECK(outside == 0);
}

TEST_CASE("the tree does not depend on the number of threads", "[accel]") {
  Random random(63);
  const Geometry g = brute::Soup(random, 3 * kPart, 1, 0.05f);
  for (const AccelOptions& options : kBuilds) {
    const auto build = [&](int threads) {
      const ThreadLimit limit(threads);
      return MakeScene(g, options).accel;
    };
    const Accel one = build(1), two = build(2);
    CHECK(SameBytes(one.nodes, two.nodes));
    CHECK(SameBytes(one.triangle_blocks, two.triangle_blocks));
  }
}

TEST_CASE("items are sorted to two sides", "[accel]") {
  Random random(66);
  for (const std::uint32_t count : {0u, 1u, 63u, 64u, 65u, 200u, 5000u, 3 * kPart + 77}) {
    for (const double part : {0.0, 0.01, 0.5, 0.9, 1.0}) {
      std::vector<BuildItem> items(count);
      std::vector<bool> first(count);
      for (std::uint32_t i = 0; i < count; ++i) {
        items[i].id = i;
        first[i] = random(0, 1) < part;
      }
      const auto is_first = [&](const BuildItem& item) -> bool { return first[item.id]; };
      const std::uint32_t middle = PartitionItems(items.data(), count, is_first);
      CAPTURE(count, part, middle);
      CHECK(middle == std::ranges::count(first, true));
      CHECK(std::all_of(items.begin(), items.begin() + middle, is_first));
      std::set<std::uint32_t> ids;
      for (const BuildItem& item : items) ids.insert(item.id);
      CHECK(ids.size() == count);
    }
  }
}

TEST_CASE("leaves hold the corners of their triangles, shared or not", "[accel]") {
  Random random(64);
  Geometry strip = brute::Soup(random, 300, 1, 0.2f);  // nothing shared
  for (int i = 0; i < 500; ++i) {                      // a strip, neighbours share two
    const float x = 0.01f * static_cast<float>(i);
    strip.triangles.push_back(MakeTriangle({x, 0, 0}, {x + 0.01f, 0, 0}, {x, 1, 0}));
    strip.triangles.push_back(
        MakeTriangle({x + 0.01f, 0, 0}, {x + 0.01f, 1, 0}, {x, 1, 0}));
  }
  for (const AccelOptions& options : kBuilds) {
    const CompiledScene scene = MakeScene(strip, options);
    std::set<std::uint32_t> triangles;  // some may be cut
    std::size_t wrong = 0, separate = 0, shared = 0;
    for (const LeafView& leaf : LeavesOf(scene.accel)) {
      triangles.insert(leaf.prim.begin(), leaf.prim.end());
      (leaf.separate ? separate : shared) += 1;
      CHECK(std::is_sorted(leaf.prim.begin(), leaf.prim.end()));
      for (std::size_t lane = 0; lane < leaf.prim.size(); ++lane) {
        const TriangleRecord& record = scene.geometry.triangles[leaf.prim[lane]];
        for (int k = 0; k < 3; ++k) {
          wrong += leaf.corner[lane][k] != brute::Corner(record, k);
        }
      }
    }
    CHECK(separate > 20);
    CHECK(shared > 20);
    CHECK(triangles.size() == 1300);
    CHECK(wrong == 0);
  }
}

TEST_CASE("leaves of separate triangles and of tiles are about full", "[accel]") {
  const auto per_leaf = [](const Geometry& g) {
    const Accel accel = MakeScene(g, {.few_triangles = 0}).accel;
    std::size_t triangles = 0;  // some are cut
    for (const LeafView& leaf : LeavesOf(accel)) triangles += leaf.prim.size();
    return static_cast<double>(triangles) /
           static_cast<double>(accel.triangle_blocks.size());
  };
  Random random(65);
  // They overlap so much that smaller leaves would save nothing.
  CHECK(per_leaf(brute::Soup(random, 5000, 1, 0.4f)) > 7);  // a leaf holds 8
  Geometry tiles;
  for (int i = 0; i < 1600; ++i) {
    const Vec3f c{static_cast<float>(i % 40), static_cast<float>(i / 40), 0};
    const Vec3f u{0.9f, 0, 0}, v{0, 0.9f, 0};
    tiles.triangles.push_back(MakeTriangle(c, c + u, c + u + v));
    tiles.triangles.push_back(MakeTriangle(c, c + u + v, c + v));
  }
  CHECK(per_leaf(tiles) > 6);  // of either kind 8 fit
}

TEST_CASE("small scenes share vertices", "[accel]") {
  Geometry g;
  g.triangles = {MakeTriangle({0, 0, 0}, {1, 0, 0}, {1, 1, 0}),
                 MakeTriangle({0, 0, 0}, {1, 1, 0}, {0, 1, 0})};
  const Accel accel = MakeScene(g).accel;
  CHECK(accel.few.triangles.size() == 2);
  CHECK(accel.few.vertices.size() == 4);
  CHECK(accel.few.reach == 1);
}

}  // namespace lanelight
