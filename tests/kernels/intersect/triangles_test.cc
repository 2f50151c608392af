// Closest and any hits on triangles against brute force in double precision.
#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/kernels/intersect/trace.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;
using brute::ToDouble;

std::vector<KernelHit> Trace(const CompiledScene& scene,
                             const std::vector<TestRay>& rays) {
  return TraceClosest(scene, rays, {IntersectTrianglesStage});
}

std::vector<TestRay> RandomRays(Random& random, int n, float size) {
  std::vector<TestRay> rays;
  for (int i = 0; i < n; ++i) rays.push_back({random.Point(size), random.Direction()});
  return rays;
}

// Rays whose nearest hit is not within `margin` of an edge of any triangle, compared with
// the kernel.
void CompareWithBruteForce(const CompiledScene& scene, const std::vector<TestRay>& rays,
                           double margin, double t_tolerance) {
  const auto hits = Trace(scene, rays);
  int compared = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3d o = ToDouble(rays[i].o), d = ToDouble(rays[i].d);
    bool clear = true;
    for (const TriangleRecord& tri : scene.geometry.triangles) {
      const auto hit = brute::Solve(tri, o, d);
      clear = clear && (!hit || std::abs(hit->inside) > margin);
    }
    if (!clear) continue;
    const brute::Hit truth = brute::Closest(scene.geometry.triangles, o, d);
    CAPTURE(i, truth.prim, truth.t, hits[i].prim, hits[i].t, truth.inside);
    ++compared;
    REQUIRE(std::isinf(truth.t) == std::isinf(hits[i].t));
    if (std::isinf(truth.t)) continue;
    REQUIRE(hits[i].prim == truth.prim);
    REQUIRE(std::abs(hits[i].t - truth.t) <= t_tolerance);
    REQUIRE(std::abs(hits[i].b1 - truth.b1) <= margin);
    REQUIRE(std::abs(hits[i].b2 - truth.b2) <= margin);
  }
  CHECK(compared > static_cast<int>(rays.size()) / 2);
}

}  // namespace

TEST_CASE("closest triangle hits agree with brute force", "[intersect]") {
  const EachTarget target;
  Random random(7);
  for (int n : {1, 2, 36, 64, 65, 700}) {
    CAPTURE(n);
    const CompiledScene scene = MakeScene(brute::Soup(random, n, 1, 0.6f));
    CompareWithBruteForce(scene, RandomRays(random, 500, 2), 1e-5, 1e-5);
  }
  const CompiledScene mixed = MakeScene(brute::Mixed(random, 200, 0.3f));
  CompareWithBruteForce(mixed, RandomRays(random, 500, 1), 1e-5, 1e-5);
}

TEST_CASE("any-hit keeps exactly the rays without a nearer hit", "[intersect]") {
  const EachTarget target;
  Random random(8);
  for (const Geometry& geometry :
       {brute::Soup(random, 36, 1, 0.4f), brute::Soup(random, 300, 1, 0.4f),
        brute::Mixed(random, 200, 0.3f)}) {
    const CompiledScene scene = MakeScene(geometry);
    std::vector<TestRay> rays = RandomRays(random, 1000, 1);
    const auto hits = Trace(scene, rays);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      // Ends before, exactly at, and beyond the nearest hit; the end is exclusive.
      if (!std::isinf(hits[i].t)) {
        rays[i].t_max = i % 3 == 0   ? hits[i].t
                        : i % 3 == 1 ? std::nextafter(hits[i].t, 1e30f)
                                     : 0.5f * hits[i].t;
      }
      if (std::isinf(hits[i].t) || i % 3 != 1) expected.push_back(i);
    }
    CHECK(Unoccluded(scene, rays, {ShadowTrianglesStage}) == expected);
  }
}

TEST_CASE("trees and the plain loop report the same bits", "[intersect]") {
  const EachTarget target;
  Random random(9);
  const auto check = [&](const Geometry& geometry) {
    const auto rays = RandomRays(random, 2000, 1.5f);
    const auto plain = Trace(MakeScene(geometry), rays);
    for (const auto quality : {BuildQuality::kHigh, BuildQuality::kFast}) {
      for (const int leaf : {SmallLeaf::kLanes, TriangleLeaf::kLanes}) {
        const AccelOptions options = {
            .few_triangles = 0, .quality = quality, .leaf_triangles = leaf};
        CHECK(Trace(MakeScene(geometry, options), rays) == plain);
      }
    }
  };
  for (float edge : {0.02f, 0.5f, 2.0f}) {
    check(brute::Soup(random, 64, 1, edge));
  }
  check(brute::SphereMesh(8, 8, {}, 1));  // vertices are shared
}

TEST_CASE("a hit does not depend on other rays", "[intersect]") {
  // Rays share packets and stacks with others in the order of the queue; alone they take
  // every step by themselves. Deep trees and heaps of overlapping triangles fill stacks.
  Random random(10);
  std::vector<Geometry> cases = {brute::Soup(random, 5000, 1, 0.05f),
                                 brute::Soup(random, 1000, 1, 2.0f),
                                 brute::Mixed(random, 2000, 0.05f)};
  Geometry line;  // exponentially spaced
  for (int i = 0; i < 1000; ++i) {
    const float x = std::ldexp(1.0f, -i % 120);
    line.triangles.push_back(MakeTriangle({x, 0, 0}, {x, x, 0}, {x, 0, x}));
  }
  cases.push_back(line);
  std::vector<TestRay> rays = RandomRays(random, 300, 1);
  // From one place, in beams: the narrow one goes through frustums, which give up among
  // overlapping triangles and leave what they have found as a bound.
  for (const float width : {0.1f, 0.01f}) {
    for (int i = 0; i < 300; ++i) {
      rays.push_back(
          {{1.5f, 0.1f, 0.2f}, Normalize(Vec3f{-1, 0, 0} + width * random.Point(1))});
    }
  }
  const EachTarget target;
  for (const Geometry& geometry : cases) {
    const CompiledScene scene = MakeScene(geometry, {.few_triangles = 0});
    const auto together = Trace(scene, rays);
    const auto open = Unoccluded(scene, rays, {ShadowTrianglesStage});
    CAPTURE(geometry.triangles.size());
    CHECK(std::count_if(together.begin(), together.end(),
                        [](const KernelHit& hit) { return !std::isinf(hit.t); }) > 50);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      if (std::isinf(together[i].t)) expected.push_back(i);
    }
    CHECK(open == expected);
    for (const std::size_t company : {1, 5, 37}) {
      std::vector<KernelHit> apart;
      for (std::size_t at = 0; at < rays.size(); at += company) {
        const std::size_t end = std::min(rays.size(), at + company);
        const auto part = Trace(scene, {rays.begin() + at, rays.begin() + end});
        apart.insert(apart.end(), part.begin(), part.end());
      }
      CHECK(apart == together);
    }
  }
}

}  // namespace lanelight
