// Trees over triangles that were cut: their leaves cover every triangle, in boxes that
// leave nothing out, and rays hit what they hit without a tree.
#include "src/scene/accel/splits.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <vector>

#include "src/base/core/parallel.h"
#include "src/scene/accel/shape_items.h"
#include "src/scene/accel/triangle_cut.h"
#include "tests/kernels/intersect/trace.h"
#include "tests/scene/accel/leaves.h"
#include "tests/scene/accel/sticks.h"

namespace lanelight {
namespace {

using brute::Random;

// For every triangle what the boxes on the way to each of its leaves have in common.
using BoxesOfTriangles = std::map<std::uint32_t, std::vector<AccelBox>>;

BoxesOfTriangles Collect(const Accel& accel) {
  BoxesOfTriangles boxes;
  for (const LeafView& leaf : LeavesOf(accel)) {
    for (std::size_t i = 0; i < leaf.prim.size(); ++i) {
      if (i > 0) REQUIRE(leaf.prim[i - 1] < leaf.prim[i]);  // none twice
      boxes[leaf.prim[i]].push_back(leaf.box);
    }
  }
  return boxes;
}

std::size_t References(const BoxesOfTriangles& boxes) {
  std::size_t count = 0;
  for (const auto& [id, list] : boxes) count += list.size();
  return count;
}

// A box less nearly all of what boxes are grown by.
AccelBox Shrunk(const AccelBox& box, const TriangleRecord& triangle) {
  AccelBox whole;
  for (int k = 0; k < 3; ++k) whole.Extend(brute::Corner(triangle, k));
  return Grown(box, -0.9f * Reach(whole));
}

// How many of some points of triangles are in no box that their triangle has, with room
// for rounding.
std::size_t Outside(const Geometry& g, const BoxesOfTriangles& boxes, Random& random,
                    double scale = 1) {
  std::size_t outside = 0;
  for (const auto& [id, list] : boxes) {
    for (int k = 0; k < 20; ++k) {
      const Vec3d p = brute::PointOn(g.triangles[id], random);
      outside += std::none_of(list.begin(), list.end(), [&](const AccelBox& box) {
        return brute::Holds(Shrunk(box, g.triangles[id]), p, scale);
      });
    }
  }
  return outside;
}

// The nearest hits, by plain loops over a few triangles each.
std::vector<KernelHit> NearestOfLoops(const Geometry& g,
                                      const std::vector<TestRay>& rays) {
  std::vector<KernelHit> nearest(rays.size(), {INFINITY, 0, 0, 0, 0});
  for (std::uint32_t first = 0; first < g.triangles.size(); first += kFewTriangles) {
    Geometry part;
    const auto end = std::min<std::size_t>(first + kFewTriangles, g.triangles.size());
    part.triangles.assign(g.triangles.begin() + first,
                          g.triangles.begin() + static_cast<std::ptrdiff_t>(end));
    const auto hits = TraceClosest(MakeScene(part), rays, {IntersectTrianglesStage});
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!(hits[i].t < nearest[i].t)) continue;
      nearest[i] = hits[i];
      nearest[i].prim += first;
    }
  }
  return nearest;
}

// A fine mesh among some sticks: their boxes are mostly empty, those of most triangles
// not.
Geometry MeshAmongSticks(Random& random) {
  Geometry g = brute::SphereMesh(60, 120, {0, 0, 0}, 0.7f);
  const Geometry sticks = brute::Sticks(random, 60, 1.5f);
  g.triangles.insert(g.triangles.end(), sticks.triangles.begin(), sticks.triangles.end());
  return g;
}

// Rays from anywhere, and rays nearly in the plane of a triangle.
std::vector<TestRay> RaysAt(const Geometry& g, Random& random, int n) {
  std::vector<TestRay> rays;
  for (int i = 0; i < n; ++i) {
    const TriangleRecord& t = g.triangles[random.engine()() % g.triangles.size()];
    const Vec3f a = brute::Corner(t, 0), b = brute::Corner(t, 1), c = brute::Corner(t, 2);
    if (i % 2 == 0) {
      rays.push_back({random.Point(1.5f), random.Direction()});
    } else {
      const Vec3f in_plane = Normalize(b - a + random(-30, 30) * (c - b));
      const Vec3f at = a + random(0, 1) * (b - a);
      rays.push_back({at - random(0, 2) * in_plane,
                      Normalize(in_plane + random(0, 1e-4f) * random.Point(1))});
    }
  }
  return rays;
}

}  // namespace

TEST_CASE("boxes of split triangles cover them", "[accel]") {
  Random random(72);
  for (const float length : {0.8f, 2.0f}) {
    const Geometry g = brute::Sticks(random, 4000, length);
    const Accel accel = MakeScene(g).accel;
    const BoxesOfTriangles boxes = Collect(accel);
    CHECK(boxes.size() == g.triangles.size());
    CHECK(References(boxes) > g.triangles.size() * 5 / 4);  // they are cut
    CHECK(References(boxes) <= g.triangles.size() * 7 / 4);
    CHECK(Outside(g, boxes, random) == 0);
  }
}

TEST_CASE("boxes of split triangles cover them at any scale", "[accel]") {
  // Segments, points, and triangles in the planes of axes among sticks; areas that
  // overflow or underflow.
  for (const float scale : {1.0f, 1e18f, 1e30f, 1e-18f, 1e-30f}) {
    CAPTURE(scale);
    Random random(75);
    Geometry g = brute::Sticks(random, 4000, 1.0f);
    for (std::uint32_t i = 0; i < g.triangles.size(); ++i) {
      auto& p = g.triangles[i].p;
      for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) {
          if (i % 8 == 0) p[k][a] = p[k == 2 ? 1 : k][a];
          if (i % 8 == 1) p[k][a] = p[0][a];
          if (i % 8 == 2 && a == 1) p[k][a] = 0.25f;
          if (i % 8 == 3 && a != 2) p[k][a] = p[0][a];
        }
      }
      for (int k = 0; k < 9; ++k) p[k / 3][k % 3] *= scale;
    }
    const BoxesOfTriangles boxes = Collect(MakeScene(g).accel);
    CHECK(boxes.size() == g.triangles.size());
    CHECK(Outside(g, boxes, random, double{scale}) == 0);
    if (scale == 1) CHECK(References(boxes) > g.triangles.size());
  }
}

TEST_CASE("long triangles among many small ones are split", "[accel]") {
  Random random(76);
  const Geometry g = MeshAmongSticks(random);
  for (const int leaf_triangles : {SmallLeaf::kLanes, TriangleLeaf::kLanes}) {
    const Accel accel = MakeScene(g, {.leaf_triangles = leaf_triangles}).accel;
    const BoxesOfTriangles boxes = Collect(accel);
    CHECK(boxes.size() == g.triangles.size());
    CHECK(References(boxes) > g.triangles.size());
    CHECK(References(boxes) <= g.triangles.size() * 5 / 4);
    CHECK(Outside(g, boxes, random) == 0);
  }
}

TEST_CASE("meshes of small triangles are not split", "[accel]") {
  const Geometry g = brute::SphereMesh(60, 120, {0, 0, 0}, 1);
  CHECK(References(Collect(MakeScene(g).accel)) == g.triangles.size());
}

TEST_CASE("BVHs with spatial splits do not depend on the number of threads", "[accel]") {
  Random random(73);
  const Geometry g = brute::Sticks(random, 20000, 0.4f);
  const auto build = [&](int threads) {
    const ThreadLimit limit(threads);
    return MakeScene(g).accel;
  };
  const Accel one = build(1), two = build(2);
  CHECK(References(Collect(one)) > g.triangles.size() * 5 / 4);
  CHECK(SameBytes(one.nodes, two.nodes));
  CHECK(SameBytes(one.triangle_blocks, two.triangle_blocks));
}

TEST_CASE("hits on split triangles are bit-identical to unsplit ones", "[accel]") {
  Random random(74);
  const Geometry g =
      GENERATE_REF(brute::Sticks(random, 4000, 1.0f), MeshAmongSticks(random));
  const CompiledScene scene = MakeScene(g);
  REQUIRE(References(Collect(scene.accel)) > g.triangles.size());
  const std::vector<TestRay> rays = RaysAt(g, random, 20000);
  const auto hits = TraceClosest(scene, rays, {IntersectTrianglesStage});
  const auto truth = NearestOfLoops(g, rays);
  std::size_t differ = 0, found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    differ += !(hits[i] == truth[i]);
    found += !std::isinf(hits[i].t);
  }
  CHECK(differ == 0);
  CHECK(found > rays.size() / 4);
}

}  // namespace lanelight
