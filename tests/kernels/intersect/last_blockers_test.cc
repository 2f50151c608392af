// Shadow rays are tested first against what blocked others: no reason for them to be
// blocked if it lies behind their end, or is the triangle that they start on.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/kernels/intersect/trace.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;

// Two walls across the way of all rays, and triangles enough for a tree behind them.
Geometry Walls(Random& random) {
  Geometry geometry;
  for (const float z : {1.0f, 1.5f}) {
    geometry.triangles.push_back(MakeTriangle({-4, -4, z}, {4, -4, z}, {4, 4, z}));
    geometry.triangles.push_back(MakeTriangle({-4, -4, z}, {4, 4, z}, {-4, 4, z}));
  }
  const Geometry soup = brute::Soup(random, 300, 1, 0.1f);
  for (TriangleRecord record : soup.triangles) {
    for (auto& corner : record.p) corner[2] += 3;
    geometry.triangles.push_back(record);
  }
  return geometry;
}

// To the walls, from before them; many stop short of the first, or between the two.
std::vector<TestRay> RaysToWalls(Random& random, int count) {
  std::vector<TestRay> rays;
  for (int i = 0; i < count; ++i) {
    const Vec3f o = 0.5f * random.Point(1), beside = 0.3f * random.Point(1);
    TestRay ray{o, Normalize(Vec3f{beside.x, beside.y, 1})};
    const float first = (1 - o.z) / ray.d.z, second = (1.5f - o.z) / ray.d.z;
    constexpr float kEnds[] = {0.5f, 0.999f, 1.001f, 1.3f};
    ray.t_max = i % 5 < 4 ? kEnds[i % 5] * (i % 3 == 0 ? second : first) : INFINITY;
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace

TEST_CASE("the last blocker is only a candidate for the next shadow ray", "[intersect]") {
  const EachTarget target;
  Random random(21);
  const CompiledScene scene = MakeScene(Walls(random));
  std::vector<TestRay> rays = RaysToWalls(random, 3000);
  // Some start on the wall that they meet: they are blocked by what is behind it only.
  const auto first = TraceClosest(scene, rays, {IntersectTrianglesStage});
  for (std::size_t i = 0; i < rays.size(); i += 7) {
    if (std::isfinite(first[i].t)) rays[i].from = first[i].prim;
  }
  std::vector<std::uint32_t> open;
  std::size_t ends = 0;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    const Vec3d o = brute::ToDouble(rays[i].o), d = brute::ToDouble(rays[i].d);
    bool blocked = false;
    for (std::uint32_t id = 0; id < 4; ++id) {
      const auto hit = brute::Solve(scene.geometry.triangles[id], o, d);
      blocked = blocked || (hit && hit->t > 0 && hit->t < rays[i].t_max &&
                            hit->inside >= 0 && id != rays[i].from);
    }
    ends += !blocked;
    if (!blocked) open.push_back(i);
  }
  REQUIRE(ends > 500);
  REQUIRE(ends < 2000);
  CHECK(Unoccluded(scene, rays, {ShadowTrianglesStage}) == open);
}

}  // namespace lanelight
