// Spheres, disks and planes: plain loops, trees and double precision agree.
#include <catch2/catch.hpp>

#include "tests/kernels/intersect/trace.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;
using brute::ToDouble;

struct Truth {
  double t = brute::kInf;
  std::uint32_t prim = 0;
  bool clear = true;  // no shape is nearly touched or its rim nearly crossed
};

void AcceptNearer(Truth& truth, double t, std::uint32_t prim) {
  if (std::abs(t) < 1e-4) truth.clear = false;
  if (t > 0 && std::abs(t - truth.t) < 1e-4) truth.clear = false;
  if (t > 0 && t < truth.t) {
    truth.t = t;
    truth.prim = prim;
  }
}

Truth FindTruth(const Geometry& g, const TestRay& ray) {
  Truth truth;
  const Vec3d o = ToDouble(ray.o), d = ToDouble(ray.d);
  for (std::uint32_t i = 0; i < g.spheres.size(); ++i) {
    const SphereRecord& s = g.spheres[i];
    const auto roots = brute::Roots(s, o, d);
    if (roots.size() == 2 && roots[1] - roots[0] < 1e-2) truth.clear = false;
    SphereRecord wider = s;
    wider.radius *= 1 + 1e-5f;
    if (roots.empty() && !brute::Roots(wider, o, d).empty()) truth.clear = false;
    for (const double t : roots) AcceptNearer(truth, t, g.ranges.spheres + i);
  }
  for (std::uint32_t i = 0; i < g.disks.size(); ++i) {
    const DiskRecord& s = g.disks[i];
    const Vec3d n{s.normal[0], s.normal[1], s.normal[2]};
    const Vec3d c{s.center[0], s.center[1], s.center[2]};
    const double t = Dot(n, c - o) / Dot(n, d), distance = Length(o + t * d - c);
    if (std::abs(Dot(n, d)) < 1e-2) truth.clear = false;
    if (std::abs(distance - s.radius) < 1e-4) truth.clear = false;
    if (std::abs(distance - s.inner_radius) < 1e-4) truth.clear = false;
    if (distance <= s.radius && distance >= s.inner_radius) {
      AcceptNearer(truth, t, g.ranges.disks + i);
    }
  }
  for (std::uint32_t i = 0; i < g.planes.size(); ++i) {
    const PlaneRecord& s = g.planes[i];
    const Vec3d n{s.normal[0], s.normal[1], s.normal[2]};
    const Vec3d c{s.point[0], s.point[1], s.point[2]};
    if (std::abs(Dot(n, d)) < 1e-2) truth.clear = false;
    AcceptNearer(truth, Dot(n, c - o) / Dot(n, d), g.ranges.planes + i);
  }
  return truth;
}

Geometry Mixture(Random& random, int n) {
  Geometry g;
  for (int i = 0; i < n; ++i) {
    g.spheres.push_back(MakeSphere(random.Point(1), random(0.01f, 0.3f)));
    g.disks.push_back(MakeDisk(random.Point(1), random.Direction(), random(0.1f, 0.4f),
                               i % 2 ? 0.05f : 0));
  }
  g.planes = {MakePlane({0, 0, -2}, {0, 0.1f, 1}), MakePlane({0, 3, 0}, {0, -1, 0})};
  return g;
}

const std::vector<StageOn> kClosest = {IntersectSpheresStage, IntersectDisksStage,
                                       IntersectPlanesStage};
const std::vector<StageOn> kShadow = {ShadowSpheresStage, ShadowDisksStage,
                                      ShadowPlanesStage};

}  // namespace

TEST_CASE("round shapes and planes agree with double precision", "[intersect]") {
  const EachTarget target;
  Random random(31);
  for (const int n : {3, 16, 200}) {
    const Geometry g = Mixture(random, n);
    const CompiledScene scene = MakeScene(g);
    std::vector<TestRay> rays;
    for (int i = 0; i < 700; ++i) rays.push_back({random.Point(1), random.Direction()});
    const auto hits = TraceClosest(scene, rays, kClosest);
    CHECK(hits == TraceClosest(MakeScene(g, {.few_round = 0}), rays, kClosest));
    CHECK(hits == TraceClosest(MakeScene(g, {.few_round = 1000}), rays, kClosest));
    int compared = 0;
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      const Truth truth = FindTruth(scene.geometry, rays[i]);
      if (i % 2 == 0) rays[i].t_max = 0.4f;
      if (!(hits[i].t < rays[i].t_max)) open.push_back(i);
      if (!truth.clear) continue;
      ++compared;
      CAPTURE(n, i, truth.prim, truth.t, hits[i].t, hits[i].prim);
      REQUIRE(std::isinf(truth.t) == std::isinf(hits[i].t));
      if (std::isinf(truth.t)) continue;
      REQUIRE(hits[i].prim == truth.prim);
      REQUIRE(std::abs(hits[i].t - truth.t) < 1e-5 * (1 + truth.t));
      REQUIRE(hits[i].inst == kWorldInstance);
    }
    CHECK(compared > (n < 100 ? 300 : 10));
    CHECK(Unoccluded(scene, rays, kShadow) == open);
    CHECK(Unoccluded(MakeScene(g, {.few_round = 0}), rays, kShadow) == open);
  }
}

TEST_CASE("distant and huge spheres have accurate roots", "[intersect]") {
  const EachTarget target;
  Random random(32);
  Geometry g;
  g.spheres = {MakeSphere({0, 0, 3000}, 1), MakeSphere({0, -1e5f, 0}, 1e5f)};
  const CompiledScene scene = MakeScene(std::move(g));
  std::vector<TestRay> rays;
  for (int i = 0; i < 400; ++i) {
    const Vec3f o = {random(-1, 1), random(1, 2), random(-1, 1)};
    const Vec3f goal = i % 2 ? Vec3f{0, 0, 3000} + 0.7f * random.Direction()
                             : Vec3f{random(-5, 5), 0, random(-5, 5)};
    rays.push_back({o, Normalize(goal - o)});
  }
  const auto hits = TraceClosest(scene, rays, {IntersectSpheresStage});
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto roots = brute::Roots(scene.geometry.spheres[i % 2 ? 0 : 1],
                                    ToDouble(rays[i].o), ToDouble(rays[i].d));
    CAPTURE(i, hits[i].t);
    REQUIRE(roots.size() == 2);
    // A relative error of the distance of 1e-5 where the textbook formula loses 1e-1.
    REQUIRE(hits[i].t == Approx(roots[0]).epsilon(i % 2 ? 1e-5 : 3e-2));
  }
}

TEST_CASE("a ray parallel to a plane or disk misses it", "[intersect]") {
  const EachTarget target;
  Geometry g;
  g.disks = {MakeDisk({0, 0, 0}, {0, 0, 1}, 1)};
  g.planes = {MakePlane({0, 0, 0}, {0, 0, 1})};
  g.spheres = {MakeSphere({0, 0, 0}, 0)};  // a point
  const CompiledScene scene = MakeScene(std::move(g));
  const std::vector<TestRay> rays = {
      {{-2, 0, 0}, {1, 0, 0}}, {{-2, 0, 1e-3f}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 1}}};
  for (const KernelHit& hit : TraceClosest(scene, rays, kClosest)) {
    CHECK(std::isinf(hit.t));
  }
  CHECK(Unoccluded(scene, rays, kShadow).size() == rays.size());
}

}  // namespace lanelight
