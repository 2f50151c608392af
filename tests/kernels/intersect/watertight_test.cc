// No ray leaks through a closed mesh, whatever its shape, and no ray depends on the order
// or the company in which it is traced.
#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>

#include "tests/kernels/intersect/trace.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;

// A point near an edge or a vertex of the mesh, exactly on it as far as floats can be.
Vec3f OnEdge(const Geometry& g, Random& random) {
  const auto& tri = g.triangles[random.engine()() % g.triangles.size()];
  const Vec3f a{tri.p[0][0], tri.p[0][1], tri.p[0][2]};
  const Vec3f b{tri.p[1][0], tri.p[1][1], tri.p[1][2]};
  const int kind = static_cast<int>(random.engine()() % 3);
  if (kind == 0) return a;
  return kind == 1 ? 0.5f * (a + b) : a + random(0, 1) * (b - a);
}

// Rays from inside the closed mesh to its edges and vertices; all must hit.
int Leaks(const Geometry& g, const CompiledScene& scene, Random& random, Vec3f center,
          float radius, int count) {
  constexpr int kBatch = 4096;
  int leaks = 0;
  for (int done = 0; done < count; done += kBatch) {
    std::vector<TestRay> rays;
    while (rays.size() < kBatch) {
      const Vec3f o = center + (0.4f * radius) * random.Direction();
      Vec3f d = OnEdge(g, random) - o;
      if (rays.size() % 4 == 0) d = random.Direction();
      if (rays.size() % 7 == 0) d[static_cast<int>(rays.size() % 3)] = 0;
      if (Length(d) > 0) rays.push_back({o, Normalize(d)});
    }
    for (const KernelHit& hit : TraceClosest(scene, rays, {IntersectTrianglesStage})) {
      leaks += std::isinf(hit.t);
    }
    leaks += static_cast<int>(Unoccluded(scene, rays, {ShadowTrianglesStage}).size());
  }
  return leaks;
}

int LeaksOfAll(int count_per_mesh) {
  Random random(21);
  int leaks = 0;
  struct Mesh {
    int rings, segments;
    Vec3f center;
    float radius;
  };
  for (const Mesh& m : {Mesh{4, 6, {0, 0, 0}, 1}, Mesh{5, 6, {100, 3, -7}, 1},
                        Mesh{40, 60, {0.3f, 0.1f, 0}, 1}, Mesh{9, 300, {0, 0, 0}, 1e6f},
                        Mesh{60, 9, {0, 1e-3f, 0}, 1e-6f}, Mesh{2, 10000, {0, 0, 0}, 1},
                        Mesh{100, 100, {148, 1, -223}, 1}}) {
    const Geometry g = brute::SphereMesh(m.rings, m.segments, m.center, m.radius);
    const CompiledScene scene = MakeScene(g);
    CAPTURE(m.rings, m.segments, m.radius);
    const int found = Leaks(g, scene, random, m.center, m.radius, count_per_mesh);
    CHECK(found == 0);
    leaks += found;
  }
  return leaks;
}

}  // namespace

TEST_CASE("no ray leaks through the edges of a closed mesh", "[intersect]") {
  const EachTarget target;
  CHECK(LeaksOfAll(12000) == 0);
}

TEST_CASE("no ray leaks in ten million tries", "[intersect][slow]") {
  const EachTarget target;
  CHECK(LeaksOfAll(2000000) == 0);
}

TEST_CASE("a hole in the mesh is seen", "[intersect]") {
  Random random(22);
  const Geometry whole = brute::SphereMesh(40, 60, {0, 0, 0}, 1);
  Geometry g = whole;
  g.triangles.erase(g.triangles.begin() + 777);
  CHECK(Leaks(whole, MakeScene(g), random, {0, 0, 0}, 1, 50000) > 0);
}

TEST_CASE("hits do not depend on ray order, other rays or wavefront size",
          "[intersect]") {
  const EachTarget target;
  Random random(23);
  for (const int n : {50, 2000}) {
    // Coplanar overlapping triangles in a few planes: many ties and near ties.
    Geometry g = brute::Soup(random, n, 1, 0.3f);
    for (auto& tri : g.triangles) {
      const int axis = static_cast<int>(random.engine()() % 3);
      const float plane = 0.25f * static_cast<float>(random.engine()() % 5);
      for (auto& p : tri.p) p[axis] = plane;
    }
    const CompiledScene scene = MakeScene(g);
    std::vector<TestRay> rays;
    for (int i = 0; i < 640; ++i) rays.push_back({random.Point(1), random.Direction()});
    const std::vector<StageOn> stages = {IntersectTrianglesStage};
    const auto together = TraceClosest(scene, rays, stages);
    // In chunks of every size up to 64.
    std::vector<KernelHit> chunked;
    for (std::size_t at = 0, size = 1; at < rays.size();
         at += size, size = size % 64 + 1) {
      const std::size_t end = std::min(rays.size(), at + size);
      const auto part =
          TraceClosest(scene, {rays.begin() + at, rays.begin() + end}, stages);
      chunked.insert(chunked.end(), part.begin(), part.end());
      if (end == rays.size()) break;
    }
    CHECK(chunked == together);
    // Shuffled.
    std::vector<std::size_t> order(rays.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random.engine());
    std::vector<TestRay> shuffled;
    for (const std::size_t i : order) shuffled.push_back(rays[i]);
    const auto mixed = TraceClosest(scene, shuffled, stages);
    bool same = true;
    for (std::size_t k = 0; k < order.size(); ++k) same &= mixed[k] == together[order[k]];
    CHECK(same);
    // Triangles in reverse: the same distances, so no box hides a nearer hit.
    Geometry reversed = g;
    std::reverse(reversed.triangles.begin(), reversed.triangles.end());
    const auto backwards = TraceClosest(MakeScene(reversed), rays, stages);
    bool same_t = true;
    for (std::size_t i = 0; i < rays.size(); ++i)
      same_t &= backwards[i].t == together[i].t;
    CHECK(same_t);
  }
}

TEST_CASE("ties go to the smaller primitive", "[intersect]") {
  const EachTarget target;
  for (const int copies : {3, 200}) {
    Random random(24);
    Geometry g;
    const TriangleRecord tri = MakeTriangle({-1, -1, 2}, {1, -1, 2.5f}, {0, 1, 2});
    for (int i = 0; i < copies; ++i) g.triangles.push_back(tri);
    g.triangles.front() = MakeTriangle({9, 9, 9}, {9, 9, 8}, {9, 8, 9});
    for (const std::uint32_t few : {0u, 64u}) {
      const CompiledScene scene = MakeScene(g, {.few_triangles = few});
      std::vector<TestRay> rays;
      for (int i = 0; i < 100; ++i) {
        rays.push_back({{random(-0.1f, 0.1f), random(-0.3f, 0.1f), 0}, {0, 0, 1}});
      }
      for (const KernelHit& hit : TraceClosest(scene, rays, {IntersectTrianglesStage})) {
        CHECK(hit.prim == 1);
      }
    }
  }
}

}  // namespace lanelight
