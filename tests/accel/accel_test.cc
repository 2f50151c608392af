// Structure of trees whose triangles are not cut (those that are: spatial_split_test.cc):
// every shape in exactly one leaf, boxes that contain what is below them, the same tree
// for any number of threads.
#include "src/accel/accel.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <set>

#include "src/accel/grow.h"
#include "src/core/parallel.h"
#include "tests/intersect/brute_force.h"

namespace lanelight {
namespace {

using brute::Random;

// Ids below `ref`, checking that each vertex lies in the boxes on the way, with room for
// rounding.
void Collect(const Accel& accel, std::uint32_t ref, Vec3f lo, Vec3f hi,
             std::multiset<std::uint32_t>& ids, int& outside) {
  if (ref == kEmptyRef) return;
  if (ref & kLeafBit) {
    const TriangleLeaf& leaf = accel.triangle_leaves[ref & ~kLeafBit];
    CHECK(leaf.used == (1u << leaf.count) - 1);
    for (std::uint32_t lane = 0; lane < leaf.count; ++lane) {
      ids.insert(leaf.prim[lane]);
      for (int k = 0; k < 3; ++k) {
        CHECK(leaf.corner[k][lane] < leaf.vertices);
        for (int a = 0; a < 3; ++a) {
          const float x = leaf.vertex[a][leaf.corner[k][lane]];
          const float room = 0.9f * kShapeSlack * std::abs(x);
          outside += x - room < lo[a] || x + room > hi[a];
        }
      }
    }
    return;
  }
  const WideNode& node = accel.nodes[ref];
  for (int c = 0; c < kBvhWidth; ++c) {
    Vec3f child_lo, child_hi;
    for (int a = 0; a < 3; ++a) {
      child_lo[a] = node.bounds[a][0][c];
      child_hi[a] = node.bounds[a][1][c];
    }
    Collect(accel, node.child[c], child_lo, child_hi, ids, outside);
  }
}

std::multiset<std::uint32_t> IdsOf(const Accel& accel, const Bvh& bvh, int& outside) {
  std::multiset<std::uint32_t> ids;
  const Vec3f all{INFINITY, INFINITY, INFINITY};
  Collect(accel, bvh.root, -all, all, ids, outside);
  return ids;
}

bool SameBytes(const auto& a, const auto& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

}  // namespace

TEST_CASE("every triangle is in exactly one leaf, inside its boxes", "[accel]") {
  Random random(61);
  std::vector<Geometry> cases;
  for (const int n : {0, 1, 2, 7, 8, 9, 65, 5000}) {
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
    const CompiledScene scene = MakeScene(g, {.few_triangles = 0});
    int outside = 0;
    const auto ids = IdsOf(scene.accel, scene.accel.groups[0], outside);
    CHECK(outside == 0);
    CHECK(ids.size() == n);
    CHECK(std::set<std::uint32_t>(ids.begin(), ids.end()).size() == n);
    CHECK(scene.accel.groups[0].depth * (kBvhWidth - 1) + 1 < kTraversalStack);
  }
}

TEST_CASE("triangles with infinite or NaN vertices are left out", "[accel]") {
  Random random(62);
  Geometry g = brute::Soup(random, 100, 1, 0.1f);
  g.triangles[10].p[1][2] = INFINITY;
  g.triangles[20].p[0][0] = NAN;
  const CompiledScene scene = MakeScene(g);
  int outside = 0;
  const auto ids = IdsOf(scene.accel, scene.accel.groups[0], outside);
  CHECK(ids.size() == 98);
  CHECK(ids.count(10) + ids.count(20) == 0);
  CHECK(outside == 0);
}

TEST_CASE("the tree does not depend on the number of threads", "[accel]") {
  Random random(63);
  const Geometry g = brute::Soup(random, 30000, 1, 0.05f);
  const auto build = [&](int threads) {
    const ThreadLimit limit(threads);
    return MakeScene(g).accel;
  };
  const Accel one = build(1), two = build(2);
  CHECK(SameBytes(one.nodes, two.nodes));
  CHECK(SameBytes(one.triangle_leaves, two.triangle_leaves));
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
  const CompiledScene scene = MakeScene(strip, {.few_triangles = 0});
  std::size_t triangles = 0, wrong = 0;
  for (const TriangleLeaf& leaf : scene.accel.triangle_leaves) {
    CHECK(leaf.vertices <= kLeafVertices);
    triangles += leaf.count;
    for (std::uint32_t lane = 0; lane < leaf.count; ++lane) {
      if (lane > 0) CHECK(leaf.prim[lane - 1] < leaf.prim[lane]);
      const TriangleRecord& record = scene.geometry.triangles[leaf.prim[lane]];
      for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) {
          wrong += leaf.vertex[a][leaf.corner[k][lane]] != record.p[k][a];
        }
      }
    }
  }
  CHECK(triangles == 1300);
  CHECK(wrong == 0);
}

TEST_CASE("leaves of separate triangles and of tiles are about full", "[accel]") {
  const auto per_leaf = [](const Geometry& g) {
    const Accel accel = MakeScene(g, {.few_triangles = 0}).accel;
    double triangles = 0;
    for (const TriangleLeaf& leaf : accel.triangle_leaves) triangles += leaf.count;
    return triangles / static_cast<double>(accel.triangle_leaves.size());
  };
  Random random(65);
  // They overlap so much that smaller leaves would save nothing.
  CHECK(per_leaf(brute::Soup(random, 5000, 1, 0.4f)) > 4);  // 16 vertices hold 5
  Geometry tiles;
  for (int i = 0; i < 1600; ++i) {
    const Vec3f c{static_cast<float>(i % 40), static_cast<float>(i / 40), 0};
    const Vec3f u{0.9f, 0, 0}, v{0, 0.9f, 0};
    tiles.triangles.push_back(MakeTriangle(c, c + u, c + u + v));
    tiles.triangles.push_back(MakeTriangle(c, c + u + v, c + v));
  }
  CHECK(per_leaf(tiles) > 6);  // 16 vertices hold 8
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
