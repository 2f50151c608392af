// Rays leave out the triangle that they start on, and it is the right one that they are
// told to.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/kernels/intersect/trace.h"
#include "tests/render/wave/task_fixture.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;
using brute::ToDouble;

// Rays in all directions, and beams narrow enough to be traced as packets.
std::vector<TestRay> Rays(Random& random) {
  std::vector<TestRay> rays;
  for (int i = 0; i < 300; ++i) rays.push_back({random.Point(1.5f), random.Direction()});
  for (const float width : {0.3f, 0.01f}) {
    for (int i = 0; i < 160; ++i) {
      rays.push_back(
          {{1.5f, 0.1f, 0.2f}, Normalize(Vec3f{-1, 0, 0} + width * random.Point(1))});
    }
  }
  return rays;
}

struct StartTruth {
  bool clear = true;  // no triangle is met close to its edge
  brute::Hit hit;
};

// The nearest hit on all triangles but `left_out`.
StartTruth Nearest(const CompiledScene& scene, const TestRay& ray,
                   std::uint32_t left_out) {
  StartTruth truth;
  const auto& triangles = scene.geometry.triangles;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto hit = brute::Solve(triangles[i], ToDouble(ray.o), ToDouble(ray.d));
    if (!hit || i == left_out) continue;
    truth.clear = truth.clear && std::abs(hit->inside) > 1e-5;
    if (hit->inside >= 0 && hit->t > 0 && hit->t < truth.hit.t) {
      truth.hit = *hit;
      truth.hit.prim = i;
    }
  }
  return truth;
}

// Returns whether a point lies in the plane of the triangle that a path names.
bool LiesOn(const Wave& wave, std::uint32_t prim, Vec3f p) {
  const auto& triangles = wave.geometry->triangles;
  if (prim >= triangles.size()) return false;
  const auto at = [&](int k) {
    const float* v = triangles[prim].p[k];
    return Vec3f{v[0], v[1], v[2]};
  };
  const Vec3f n = Normalize(Cross(at(1) - at(0), at(2) - at(0)));
  return std::abs(Dot(n, p - at(0))) < 1e-4f;
}

// What stands before the kernels of a plan, and what it has seen. A plain function, as
// kernels are.
StageFn closest = nullptr, shadow = nullptr;
int num_closest = 0, num_shadow = 0, num_wrong = 0;

void CheckClosest(Wave& wave) {
  const PathColumns& p = wave.path;
  const Queue& queue = wave.queue(QueueId::kActive);
  for (std::uint32_t k = 0; k < queue.size; ++k) {
    const std::uint32_t i = queue.items[k];
    if (p.depth[i] == 0) {
      num_wrong += p.prim[i] != kNoPrimitive;
    } else {
      ++num_closest;
      num_wrong += !LiesOn(wave, p.prim[i], {p.o_x[i], p.o_y[i], p.o_z[i]});
    }
  }
  closest(wave);
}

void CheckShadow(Wave& wave) {
  const PathColumns& p = wave.path;
  const Queue& queue = wave.queue(QueueId::kShadow);
  num_shadow += static_cast<int>(queue.size);
  for (std::uint32_t k = 0; k < queue.size; ++k) {
    const std::uint32_t i = queue.items[k];
    num_wrong += !LiesOn(wave, p.prim[i], {p.p_x[i], p.p_y[i], p.p_z[i]});
  }
  shadow(wave);
}

}  // namespace

TEST_CASE("a ray ignores the triangle that it starts on", "[intersect]") {
  const EachTarget target;
  Random random(21);
  for (int n : {36, 700}) {
    CAPTURE(n);
    const CompiledScene scene = MakeScene(brute::Soup(random, n, 1, 0.6f));
    std::vector<TestRay> rays = Rays(random);
    const auto first = TraceClosest(scene, rays, {IntersectTrianglesStage});
    for (std::size_t i = 0; i < rays.size(); ++i) {
      // Every third ray names a triangle that it may not even meet.
      rays[i].from = i % 3 == 0 ? static_cast<std::uint32_t>(i) % n : first[i].prim;
    }
    const auto second = TraceClosest(scene, rays, {IntersectTrianglesStage});
    const auto open = Unoccluded(scene, rays, {ShadowTrianglesStage});
    int compared = 0;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      const StartTruth truth = Nearest(scene, rays[i], rays[i].from);
      if (!truth.clear) continue;
      ++compared;
      CAPTURE(i);
      REQUIRE(std::isinf(second[i].t) == std::isinf(truth.hit.t));
      if (!std::isinf(truth.hit.t)) REQUIRE(second[i].prim == truth.hit.prim);
      const bool is_open = std::binary_search(open.begin(), open.end(), i);
      REQUIRE(is_open == std::isinf(truth.hit.t));
    }
    CHECK(compared > static_cast<int>(rays.size()) / 2);
  }
}

TEST_CASE("a distance bound from another shape does not exclude a triangle",
          "[intersect]") {
  // A ray with a finite bound has met something; prim is that, and may be nearer or as
  // near as the triangle of the same number.
  Geometry geometry;
  geometry.triangles.push_back(MakeTriangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1}));
  const CompiledScene scene = MakeScene(geometry);
  const TestRay ray{{0.2f, 0.2f, 0}, {0, 0, 1}, 2, 0};
  CHECK(TraceClosest(scene, {ray}, {IntersectTrianglesStage})[0].t == 1);
}

TEST_CASE("paths keep the triangle that they start on when they are moved",
          "[intersect]") {
  for (const std::string strategy :
       {"points=sobol", "roulette=throughput", "roulette=adjoint"}) {
    CAPTURE(strategy);
    const std::string light =
        "LightSource \"point\" \"point3 from\" [ 0 1 0 ] \"rgb I\" [ 9 9 9 ]\n";
    TaskFixture task(MeshScene() + light, strategy, Auxiliary::kNone);
    num_closest = num_shadow = num_wrong = 0;
    for (PlannedStage& planned : task.plan.phases[0].stages) {
      const std::string name = planned.stage.name;
      if (name == "intersect_triangles") {
        closest = planned.kernel;
        planned.kernel = CheckClosest;
      }
      if (name == "shadow_triangles") {
        shadow = planned.kernel;
        planned.kernel = CheckShadow;
      }
    }
    task.Run(nullptr);
    CHECK(num_closest > 1000);
    CHECK(num_shadow > 1000);
    CHECK(num_wrong == 0);
  }
}

}  // namespace lanelight
